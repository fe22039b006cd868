#include "app/cli/check.hpp"

#include "claystack/engine/files.hpp"
#include "claystack/engine/tick.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::cli {
namespace {

// A pot is checked on a mesh of its walls: enough facets to resemble the pot, few enough to be
// fast. Soundness does not depend on their number.
constexpr std::size_t kMostSegments = 64;
constexpr std::size_t kFewestSegments = 8;
constexpr std::size_t kQuickTriangles = 1'000'000;

std::size_t check_segments(const solid::Profile& profile) {
  const std::size_t each = std::max<std::size_t>(solid::triangle_count(profile, 1), 1);
  return std::clamp(kQuickTriangles / each, kFewestSegments, kMostSegments);
}

/// Checks a section that proves a solid, and its mesh.
Verdict check_section(const solid::StackProfile& section,
                      const std::optional<solid::WallLimit>& limit) {
  Verdict verdict;
  if (solid::triangle_count(section.profile, kFewestSegments) <= solid::kMaxTriangles)
    verdict.mesh =
        solid::check_mesh(solid::revolve(section.profile, check_segments(section.profile)));
  else
    verdict.examined = false;
  verdict.wall_mm = solid::min_wall_mm(section.profile);
  for (const solid::PieceShape& shape : section.shapes)
    for (const solid::Cavity& cavity : shape.cavities)
      verdict.notes.push_back(fmt::format(
          "closed cavity from {:.2f} to {:.2f} mm, {:.1f} mm3 trapped: it needs a drain hole",
          cavity.bottom_mm, cavity.top_mm, cavity.volume_mm3));
  if (section.shapes.size() > 1)
    verdict.mesh.problems.push_back(
        {"pieces that do not touch",
         fmt::format("{} pieces; ring {} is the first of the second", section.shapes.size(),
                     section.shapes[1].first_ring),
         section.shapes.size()});
  if (limit && *verdict.wall_mm < limit->min_wall_mm)
    verdict.mesh.problems.push_back(
        {"thin wall", solid::thin_wall_text(section.profile, *verdict.wall_mm, *limit), 1});
  else if (limit)
    verdict.notes.push_back("walls: " + solid::wall_text(*verdict.wall_mm, *limit));
  return verdict;
}

}  // namespace

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command) {
  if (command.changes_mesh())
    return failure(
        ErrorKind::bad_input,
        command.file + ": --repair and --max-triangles are for meshes; export the pot again");
  if (!command.certificate.empty())
    return failure(ErrorKind::bad_input,
                   command.file + ": expected a mesh for --certificate, found a pot");
  const auto pot = parse_pot(bytes, command.file);
  if (!pot) return tl::make_unexpected(pot.error());
  if (pot->collapse)
    return unsound("collapsed", fmt::format("ring {} yielded at {:g} kPa",
                                            pot->collapse->failed_ring, pot->collapse->stress_kpa));
  // The default of `export`.
  const auto limit =
      command.walls.demand().for_size(4.0 * largest_radius_mm(pot->stack) + pot->stack.height_mm());
  solid::SmoothingOptions how;
  if (limit) how.min_wall_mm = limit->min_wall_mm;
  const auto smoothed = solid::smooth_profile_of(pot->stack, how);
  if (!smoothed) return unsound("no solid", smoothed.error().message);
  if (const auto certificate = solid::certify(smoothed->section.profile); !certificate)
    return unsound("no certificate", certificate.error().message);
  Verdict verdict = check_section(smoothed->section, limit);
  if (pot->rounding)
    verdict.notes.push_back(fmt::format("radii rounded to {} mm", pot->rounding->to_mm));
  return verdict;
}

}  // namespace clay::cli
