#include "app/cli/pot_copy.hpp"

#include "app/cli/memory_room.hpp"

#include "claystack/engine/clay.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

namespace clay::cli {

std::optional<PotEncoding> pot_encoding_of(std::string_view path) {
  if (ends_ignoring_case(path, ".pot.json")) return PotEncoding::json;
  if (ends_ignoring_case(path, ".pot.cbor")) return PotEncoding::cbor;
  return std::nullopt;
}

Result<void> check_pot_name(const std::string& path) {
  if (path.empty() || path == "-" || pot_encoding_of(path)) return {};
  return failure(ErrorKind::bad_input,
                 path +
                     ": expected a name that ends in .pot.json or .pot.cbor; claystack export "
                     "makes meshes of a pot");
}

Result<void> expect_room_to_write(std::size_t rings, PotEncoding encoding,
                                  const std::string& path) {
  // Measured: a copy of the rings, the document and the text.
  const std::uint64_t per_ring = encoding == PotEncoding::json ? 180 : 110;
  return expect_room(path + ": writing the pot", per_ring * rings);
}

PotCopy describe_copy(const Pot& pot, PotEncoding encoding, std::size_t bytes) {
  PotCopy copy{encoding, bytes, std::nullopt};
  if (!pot.rounding) return copy;
  const double exact_mm3 =
      static_cast<double>(pot.rounding->exact_volume) * pot.stack.mm3_per_quantum();
  copy.rounded_to_mm = pot.rounding->to_mm;
  copy.change_mm3 = volume_change_mm3(pot);
  copy.change_relative = exact_mm3 > 0.0 ? copy.change_mm3 / exact_mm3 : 0.0;
  return copy;
}

std::string copy_text(const PotCopy& copy, const std::string& path) {
  const std::string what =
      copy.rounded_to_mm
          ? fmt::format("rounded to {} mm; counted clay changed by {:.3g} mm3 ({:.1e} relative)",
                        *copy.rounded_to_mm, copy.change_mm3, copy.change_relative)
          : "exact";
  return fmt::format("{}: pot, {} bytes, {}", path, copy.bytes, what);
}

}  // namespace clay::cli
