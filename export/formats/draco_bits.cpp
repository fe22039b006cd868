#include "export/formats/draco_bits.hpp"

#include "claystack/export/formats.hpp"

#include <string>
#include <utility>

namespace clay::solid::inline formats {

Result<std::string> encode_on_finer_grids(
    int first_bits, const std::function<Result<std::string>(int bits)>& encode,
    const std::function<Result<void>(const std::string& bytes)>& judge) {
  std::string last;
  Result<void> judged =
      failure(ErrorKind::unsound, "expected at most 30 bits for each coordinate, found more");
  for (int bits = first_bits; bits <= kMaxDracoBits; bits += kDracoBitsStep) {
    auto bytes = encode(bits);
    if (!bytes) return bytes;
    if (*bytes == last) continue;
    judged = judge(*bytes);
    if (judged) return bytes;
    if (judged.error().kind == ErrorKind::io) break;
    last = std::move(*bytes);
  }
  return tl::make_unexpected(judged.error());
}

}  // namespace clay::solid::inline formats
