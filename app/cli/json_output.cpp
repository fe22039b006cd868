#include "app/cli/json_output.hpp"

#include "app/cli/console.hpp"
#include "core/json/json_text.hpp"
#include "core/text.hpp"

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

bool printed = false;

}  // namespace

void print_json(const Json& data) {
  printed = true;
  put_out(json_document(data));
}

bool json_printed() noexcept { return printed; }

double number_field(const Json& object, const char* field) { return object[field].get<double>(); }

Json json_count(WideQuanta count) {
  using Limits = std::numeric_limits<std::int64_t>;
  if (count < Limits::min() || count > Limits::max()) return to_string(count);
  return static_cast<std::int64_t>(count);
}

}  // namespace clay::cli
