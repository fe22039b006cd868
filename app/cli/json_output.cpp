#include "app/cli/json_output.hpp"

#include "app/cli/console.hpp"
#include "core/text.hpp"

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

bool printed = false;

}  // namespace

std::string pretty(const Json& data) {
  return data.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_json(const Json& data) {
  printed = true;
  put_out(pretty(data));
}

bool json_printed() noexcept { return printed; }

double number_in(const Json& object, const char* field) { return object[field].get<double>(); }

Json json_count(WideQuanta count) {
  using Limits = std::numeric_limits<std::int64_t>;
  if (count < Limits::min() || count > Limits::max()) return to_string(count);
  return static_cast<std::int64_t>(count);
}

}  // namespace clay::cli
