#include "app/import/mesh_pot.hpp"

#include "app/import/mesh_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay::importing {
namespace {

constexpr double kSameScale = 1e-9;

/// A mesh about its axis, with what its cuts have in common.
struct Revolved {
  std::vector<std::vector<Segment>> cuts;  ///< heights from the foot
  HalfSection section;
  double foot_mm = 0.0;  ///< along the axis
};

Result<Revolved> revolved(const solid::TriangleMesh& mesh, const MeshAxis& axis,
                          const std::string& name) {
  const auto points = about_axis(mesh, axis);
  Revolved result{mesh_cuts(mesh, points), {}, 0.0};
  std::size_t segments = 0;
  for (const std::vector<Segment>& cut : result.cuts) segments += cut.size();
  if (segments >= kMostCutSegments)
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}: expected fewer than {} edges in {} cuts through the axis, found "
                    "more",
                    name, kMostCutSegments, kMeshCuts));
  auto common = revolved_section(points, result.cuts, name);
  if (!common) return tl::make_unexpected(common.error());
  result.section = std::move(common->section);
  result.foot_mm = common->foot_mm;
  for (std::vector<Segment>& cut : result.cuts)
    for (Segment& s : cut) {
      s.from.y -= result.foot_mm;
      s.to.y -= result.foot_mm;
    }
  return result;
}

/// The largest distance of each cut from the section, and its heights beyond `limit_mm`.
struct CutOff {
  double mm = 0.0, low_mm = 1e300, high_mm = -1e300;
};

std::vector<CutOff> offsets(const Revolved& pot, double limit_mm) {
  const std::vector<Segment> outline = outline_of(pot.section.slabs);
  std::vector<CutOff> result;
  for (const std::vector<Segment>& cut : pot.cuts) {
    std::vector<glm::dvec2> points;
    for (const Segment& s : cut)
      for (const glm::dvec2& p : {s.from, 0.5 * (s.from + s.to), s.to}) points.push_back(p);
    const std::vector<double> distances = distances_from(outline, points);
    CutOff& off = result.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i) {
      off.mm = std::max(off.mm, distances[i]);
      if (distances[i] <= limit_mm) continue;
      off.low_mm = std::min(off.low_mm, points[i].y);
      off.high_mm = std::max(off.high_mm, points[i].y);
    }
  }
  return result;
}

/// Neighbouring cuts beyond the limit, around the axis.
std::vector<MeshPart> parts_of(const std::vector<CutOff>& cuts, double limit_mm) {
  const auto beyond = [&](std::size_t i) { return cuts[i % cuts.size()].mm > limit_mm; };
  constexpr double kStepDeg = 360.0 / static_cast<double>(kMeshCuts);
  std::vector<MeshPart> parts;
  for (std::size_t first = 0; first < cuts.size(); ++first) {
    if (!beyond(first) || beyond(first + cuts.size() - 1)) continue;
    MeshPart part;
    part.low_mm = 1e300, part.high_mm = -1e300;
    std::size_t end = first;
    for (; beyond(end); ++end) {
      const CutOff& cut = cuts[end % cuts.size()];
      part.off_mm = std::max(part.off_mm, cut.mm);
      part.low_mm = std::min(part.low_mm, cut.low_mm);
      part.high_mm = std::max(part.high_mm, cut.high_mm);
    }
    part.from_deg = azimuth_of_cut(first) * 180.0 / std::numbers::pi - 0.5 * kStepDeg;
    part.to_deg = part.from_deg + static_cast<double>(end - first) * kStepDeg;
    parts.push_back(part);
  }
  return parts;
}

bool opens_below(const HalfSection& section) {
  return section.slabs.front().inner_from_mm > 0.0 && !(section.slabs.back().inner_to_mm > 0.0);
}

/// Scales the mesh, and what `result` states of it.
Result<Revolved> scaled_to(double height_mm, Revolved pot, solid::TriangleMesh& mesh,
                           MeshPot& result, const std::string& name) {
  // Twice, because the height of a mesh in metres is known to a thousandth only.
  for (int k = 0; k < 2; ++k) {
    const double scale = height_mm / pot.section.height_mm;
    if (std::abs(scale - 1.0) < kSameScale) break;
    for (glm::dvec3& p : mesh.points) p *= scale;
    result.axis.through *= scale;
    result.scale *= scale;
    auto again = revolved(mesh, result.axis, name);
    if (!again) return again;
    pot = std::move(*again);
  }
  return pot;
}

double largest_radius(const HalfSection& section) {
  double largest = 0.0;
  for (const Slab& slab : section.slabs)
    largest = std::max({largest, slab.outer_from_mm, slab.outer_to_mm});
  return largest;
}

double part_limit_mm(double largest_radius_mm) {
  return std::min(std::max(kPartMm, 0.01 * largest_radius_mm), 0.1 * largest_radius_mm);
}

Result<void> check_size(const solid::TriangleMesh& mesh, const std::string& name) {
  if (mesh.triangles.size() >= 4) return {};
  return failure(
      ErrorKind::bad_input,
      fmt::format("{}: expected a mesh of a pot, found {} triangles", name, mesh.triangles.size()));
}

}  // namespace

Result<MeshPot> mesh_pot(solid::TriangleMesh mesh, const MeshPotSettings& settings,
                         const std::string& name) {
  if (auto sized = check_size(mesh, name); !sized) return tl::make_unexpected(sized.error());
  MeshPot result;
  result.axis = refined_axis(mesh, fitted_axis(mesh));
  auto pot = revolved(mesh, result.axis, name);
  if (pot && opens_below(pot->section)) {
    result.axis.direction = -result.axis.direction;
    pot = revolved(mesh, result.axis, name);
  }
  if (pot && settings.height_mm)
    pot = scaled_to(*settings.height_mm, std::move(*pot), mesh, result, name);
  if (!pot) return tl::make_unexpected(pot.error());
  const double limit = part_limit_mm(largest_radius(pot->section));
  const std::vector<CutOff> cuts = offsets(*pot, limit);
  const auto off =
      std::count_if(cuts.begin(), cuts.end(), [&](const CutOff& cut) { return cut.mm > limit; });
  if (2 * static_cast<std::size_t>(off) > kMeshCuts)
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected a pot that is nearly of revolution, found a mesh that "
                               "is more than {:.3g} mm from it at {} of {} azimuths",
                               name, limit, off, kMeshCuts));
  auto drawn = drawn_pot(pot->section, settings.rings, name);
  if (!drawn) return tl::make_unexpected(drawn.error());
  result.pot = std::move(drawn->pot);
  result.axis.through += pot->foot_mm * result.axis.direction;
  result.section_mm3 = pot->section.volume_mm3();
  result.parts = parts_of(cuts, limit);
  const std::vector<Segment> rings = outline_of(slabs_of(result.pot.stack));
  for (std::size_t i = 0; i < kMeshCuts; ++i) {
    if (cuts[i].mm > limit) continue;
    const Deviation deviation = deviation_between(pot->cuts[i], rings);
    if (deviation.mm > result.deviation.mm) result.deviation = deviation;
  }
  return result;
}

}  // namespace clay::importing
