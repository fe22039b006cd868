#include "app/cli/pot_input.hpp"

#include "app/cli/memory_room.hpp"
#include "claystack/core/atomic_file.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/export/formats.hpp"
#endif

#include <algorithm>

namespace clay::cli {
namespace {

constexpr unsigned kCborText = 3, kCborMap = 5;

/// Upper bound for the values in a pot file: its commas, or the items of CBOR.
std::size_t count_values(std::string_view bytes) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  if (bytes.empty() || byte(0) >> 5 != kCborMap)
    return static_cast<std::size_t>(std::ranges::count(bytes, ','));
  std::size_t count = 0;
  for (std::size_t at = 0; at < bytes.size(); ++count) {
    const unsigned head = byte(at), size = head & 31U;
    at += 1 + (size >= 24 && size <= 27 ? std::size_t{1} << (size - 24) : 0);
    if (head >> 5 == kCborText && size < 24) at += size;
  }
  return count;
}

/// Refuses a pot whose file and values do not fit into memory. Measured: 16 bytes of document and
/// 16 of arrays for each value, and half as much while they grow.
Result<void> expect_room_for_pot(std::string_view bytes, std::string_view name) {
  constexpr std::uint64_t kBytesPerValue = 48;
  return expect_room(std::string(name) + ": reading the pot", kBytesPerValue * count_values(bytes));
}

}  // namespace

bool is_3mf(std::string_view path) {
  static constexpr std::string_view kEnding = ".3mf";
  return path.size() >= kEnding.size() &&
         std::ranges::equal(path.substr(path.size() - kEnding.size()), kEnding, [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b;
         });
}

Result<Pot> pot_from(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with("PK"))
    return expect_room_for_pot(bytes, name).and_then([&] { return parse_pot(bytes, name); });
#ifdef CLAYSTACK_EXPORT
  return solid::parts_in_3mf(bytes, name).and_then([&](const solid::PackedParts& parts) {
    if (!parts.pot.empty())
      return expect_room_for_pot(parts.pot, name).and_then([&] {
        return parse_pot(parts.pot, name);
      });
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
