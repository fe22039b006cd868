#include "app/cli/pot_input.hpp"

#include "app/cli/memory_room.hpp"
#include "app/cli/next_command.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/engine/clay.hpp"
#include "claystack/export/formats.hpp"

#include <fmt/format.h>

#include <cmath>
#endif

#include <algorithm>
#include <array>
#include <utility>

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

/// Names the command that makes a pot from a file of another kind.
Error with_maker(Error error, std::string_view bytes, std::string_view name) {
  static constexpr std::array kMakers = {
      NextCommand{"a scene", "claystack throw makes a pot from a scene and its session"},
      NextCommand{"a session", "claystack throw makes a pot from a session and its scene"},
      NextCommand{"a stroke script", "claystack strokes SCENE SCRIPT makes a session from it"},
      NextCommand{"a work", "claystack throw makes a pot from a work"}};
  constexpr std::string_view kImported[] = {".stl", ".obj", ".off", ".ply", ".glb",
                                            ".drc", ".svg", ".dxf", ".csv"};
  if (std::ranges::any_of(kImported, [&](auto ending) { return ends_ignoring_case(name, ending); }))
    error.message += "; claystack import makes a pot from a mesh or a drawing";
  return with_command(std::move(error), bytes, kMakers);
}

}  // namespace

bool is_3mf(std::string_view path) { return ends_ignoring_case(path, ".3mf"); }

Result<Pot> pot_from(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with("PK"))
    return expect_room_for_pot(bytes, name)
        .and_then([&] { return parse_pot(bytes, name); })
        .map_error([&](Error error) { return with_maker(std::move(error), bytes, name); });
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

#ifdef CLAYSTACK_EXPORT
bool carries_pot(const std::string& path) {
  if (!is_3mf(path)) return false;
  const auto parts = read_file(path).and_then(
      [&](const std::string& bytes) { return solid::parts_in_3mf(bytes, path); });
  return parts && !parts->pot.empty();
}

namespace {

/// Sizes of the mesh beside a pot, and of the pot.
struct Sizes {
  double mesh_width_mm = 0.0, mesh_height_mm = 0.0, pot_width_mm = 0.0, pot_height_mm = 0.0;

  Sizes(const solid::TriangleMesh& mesh, const Pot& pot)
      : pot_width_mm(2.0 * largest_radius_mm(pot.stack)), pot_height_mm(pot.stack.height_mm()) {
    const glm::dvec3 size = solid::extent_of(mesh).size();
    mesh_width_mm = std::max(size.x, size.y);
    mesh_height_mm = size.z;
  }
  [[nodiscard]] double across() const { return mesh_width_mm / pot_width_mm; }
  [[nodiscard]] double up() const { return mesh_height_mm / pot_height_mm; }
};

}  // namespace

std::optional<std::string> mesh_differs(const solid::TriangleMesh& mesh, const Pot& pot) {
  // Smoothing, facets and finishing change the size by less; a shrinkage of 20 % enlarges it by a
  // quarter.
  constexpr double kTolerance = 0.03, kMostEnlarged = 1.25;
  const Sizes sizes(mesh, pot);
  const double across = sizes.across(), up = sizes.up();
  const bool alike = std::abs(across - up) <= kTolerance * up;
  if (pot.collapse || (alike && up >= 1.0 - kTolerance && up <= kMostEnlarged + kTolerance))
    return std::nullopt;
  const bool enlarged = alike && up > 1.0;
  return fmt::format(
      "the mesh is {} mm wide and {} mm high, the pot inside {} mm and {} mm: {}",
      size_text(sizes.mesh_width_mm, 1), size_text(sizes.mesh_height_mm, 1),
      size_text(sizes.pot_width_mm, 1), size_text(sizes.pot_height_mm, 1),
      enlarged ? fmt::format("{:.2f} times the size is more than the shrinkage of a clay needs, so "
                             "another program may have scaled the mesh",
                             up)
               : "another program changed the mesh");
}

std::optional<std::string> other_size(const solid::TriangleMesh& mesh, const Pot& pot) {
  const Sizes sizes(mesh, pot);
  if (std::abs(sizes.across() - 1.0) < 0.01 && std::abs(sizes.up() - 1.0) < 0.01)
    return std::nullopt;
  return fmt::format(
      "{} mm wide and {} mm high; the mesh is {} mm wide and {} mm high, {:.2f} and {:.2f} times "
      "as much",
      size_text(sizes.pot_width_mm, 1), size_text(sizes.pot_height_mm, 1),
      size_text(sizes.mesh_width_mm, 1), size_text(sizes.mesh_height_mm, 1), sizes.across(),
      sizes.up());
}
#endif

Result<Pot> read_pot(const std::string& path, [[maybe_unused]] const Console& console) {
#ifdef CLAYSTACK_EXPORT
  if (is_3mf(path))
    return read_file(path).and_then([&](const std::string& bytes) {
      return pot_from(bytes, path).map([&](Pot pot) {
        const auto mesh = solid::decode_3mf(bytes, path);
        if (!mesh || pot.collapse) return pot;
        if (const auto sizes = other_size(*mesh, pot))
          console.print(
              fmt::format("note: {}: the pot inside is used; it has no shrinkage and no finish: {}",
                          path, *sizes));
        // Slicers drop the certificate when they write a package again.
        const auto parts = solid::parts_in_3mf(bytes, path);
        const bool foreign = parts && parts->certificate.empty();
        if (const auto difference = foreign ? mesh_differs(*mesh, pot) : std::nullopt)
          console.warn(path + ": " + *difference + "; the pot is used");
        return pot;
      });
    });
#endif
  return read_pot(path);
}

}  // namespace clay::cli
