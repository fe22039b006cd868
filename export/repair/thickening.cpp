#include "export/repair/thickening.hpp"

#include "claystack/export/check.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/repair/hole_filling.hpp"
#include "export/repair/offset_wall.hpp"
#include "export/repair/soup_repair.hpp"
#include "export/repair/surface_making.hpp"
#include "export/repair/wall_gaps.hpp"
#include "export/repair/wall_samples.hpp"
#include "export/repair/wrapping.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace clay::solid::inline repair {
namespace {

struct Wall {
  TriangleMesh mesh;
  WallSamples samples;
  double half_mm = 0.0;
};

/// Half the thickness, and a little more than the rounding to float32 takes from it.
double half_of(const TriangleMesh& soup, double asked_mm) {
  double reach = 0.0;
  for (const glm::dvec3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(p[axis]));
  return 0.5 * asked_mm + 0x1p-22 * reach;
}

/// The wall of moved vertices, if it is sound and as thick as requested.
std::optional<Wall> moved(const TriangleMesh& soup, const Surface& surface, double asked_mm) {
  constexpr double kMostMedian = 1.1;
  const double half_mm = half_of(soup, asked_mm);
  auto mesh = offset_wall(surface, half_mm);
  if (!mesh) return std::nullopt;
  drop_unused_points(*mesh);
  if (mesh->triangles.empty() || !inspect_mesh(*mesh).sound()) return std::nullopt;
  const WallSamples samples = sample_wall(soup, *mesh);
  if (samples.low_mm < asked_mm || samples.median_mm > kMostMedian * asked_mm) return std::nullopt;
  return Wall{std::move(*mesh), samples, half_mm};
}

/// On curved surfaces the triangles of a wrap lie too low, so that the wall would be thinner there:
/// the wrap is repeated farther out, by the missing thickness. How far is bounded, because the wall
/// becomes thicker elsewhere, and because rims and sharp edges stay thin at any distance.
Result<Wall> wrapped_wall(const TriangleMesh& soup, double asked_mm, const Error& reason) {
  constexpr int kMostWraps = 4;
  constexpr double kMostOffset = 1.15, kFarther = 1.25, kLeastStep = 0.005;
  const double first_mm = 0.5 * asked_mm;
  double offset_mm = first_mm;
  std::optional<Wall> best;
  for (int wraps = 1; wraps <= kMostWraps; ++wraps) {
    auto mesh = wrapped_or_error(soup, offset_mm, kThickenAlpha * first_mm, reason);
    if (!mesh) return tl::make_unexpected(mesh.error());
    const WallSamples samples = sample_wall(soup, *mesh);
    if (!best || samples.low_mm > best->samples.low_mm)
      best = Wall{std::move(*mesh), samples, offset_mm};
    if (samples.low_mm >= asked_mm || offset_mm >= kMostOffset * first_mm) break;
    const double missing_mm =
        std::max(kFarther * 0.5 * (asked_mm - samples.low_mm), kLeastStep * first_mm);
    offset_mm = std::min(offset_mm + missing_mm, kMostOffset * first_mm);
  }
  return std::move(*best);
}

/// The surface with its small holes filled.
Result<Surface> without_small_holes(Surface surface, RepairedMesh& report) {
  return fill_holes(surface, Openings::kept).map([&](FilledHoles holes) {
    report.holes = std::move(holes.filled);
    note_repair(report.repaired, "hole filled", report.holes.size());
    return std::move(surface);
  });
}

}  // namespace

Result<TriangleMesh> wrapped_or_error(const TriangleMesh& soup, double offset_mm, double alpha_mm,
                                      const Error& reason) {
  TriangleMesh mesh = wrapped(soup, offset_mm, alpha_mm);
  const MeshReport report = inspect_mesh(mesh);
  if (report.sound()) return mesh;
  return failure(ErrorKind::unsound, reason.message + "; wrapped: expected a sound mesh, found " +
                                         report.problems.front().what);
}

Result<TriangleMesh> thickened(const TriangleMesh& soup, Surface surface, double asked_mm,
                               const Error& reason, RepairedMesh& report, StageReport& stage) {
  constexpr std::size_t kRays = 50'000;
  stage.begin("making a wall");
  RepairedMesh filled;
  std::optional<Wall> wall;
  if (const auto open = without_small_holes(std::move(surface), filled))
    wall = moved(soup, *open, asked_mm);
  const bool is_wrap = !wall;
  if (is_wrap) {
    auto wrap = wrapped_wall(soup, asked_mm, reason);
    if (!wrap) return tl::make_unexpected(wrap.error());
    wall = std::move(*wrap);
  } else {
    report.holes = std::move(filled.holes);
    note_repair(report.repaired, "hole filled", report.holes.size());
  }
  note_repair(report.repaired, "wall made around an open surface", 1);
  const auto sampled = sampled_wall(wall->mesh, kRays);
  if (!sampled) return tl::make_unexpected(sampled.error());
  report.thickened = {.asked_mm = asked_mm,
                      .least_mm = sampled->least_mm,
                      .median_mm = wall->samples.median_mm,
                      .wrapped = is_wrap,
                      .filled_share = share_filled(soup, wall->mesh, wall->half_mm)};
  return std::move(wall->mesh);
}

}  // namespace clay::solid::inline repair
