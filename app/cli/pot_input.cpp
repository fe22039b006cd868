#include "app/cli/pot_input.hpp"

#include "claystack/core/atomic_file.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/export/formats.hpp"
#endif

#include <algorithm>

namespace clay::cli {

bool is_3mf(std::string_view path) {
  static constexpr std::string_view kEnding = ".3mf";
  return path.size() >= kEnding.size() &&
         std::ranges::equal(path.substr(path.size() - kEnding.size()), kEnding, [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
         });
}

Result<Pot> pot_from(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with("PK")) return parse_pot(bytes, name);
#ifdef CLAYSTACK_EXPORT
  return solid::parts_in_3mf(bytes, name).and_then([&](const solid::PackedParts& parts) {
    if (!parts.pot.empty()) return parse_pot(parts.pot, name);
    return Result<Pot>(failure(ErrorKind::bad_input,
                               std::string(name) + ": expected a 3MF that carries a pot, as "
                                                   "claystack export writes it, found none in it"));
  });
#else
  return failure(ErrorKind::bad_input, std::string(name) + ": this build reads no 3MF");
#endif
}

Result<Pot> read_pot(const std::string& path) {
  return read_file(path).and_then([&](const std::string& bytes) { return pot_from(bytes, path); });
}

}  // namespace clay::cli
