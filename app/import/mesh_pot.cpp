#include "app/import/mesh_pot.hpp"

#include "app/import/mesh_section.hpp"
#include "app/import/separate_bodies.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace clay::importing {
namespace {

constexpr double kSameScale = 1e-9;

/// A mesh about its axis, with the common section of its cuts.
struct Revolved {
  std::vector<std::vector<Segment>> cuts;  ///< heights from the foot
  HalfSection section;
  double foot_mm = 0.0;  ///< along the axis
};

/// `noise_mm`: see revolved_section.
Result<Revolved> revolved(const solid::TriangleMesh& mesh, const MeshAxis& axis, double noise_mm,
                          const std::string& name, Edges edges = Edges::straight) {
  const auto points = about_axis(mesh, axis);
  Revolved result{mesh_cuts(mesh, points, edges), {}, 0.0};
  std::size_t segments = 0;
  for (const std::vector<Segment>& cut : result.cuts) segments += cut.size();
  if (segments >= kMostCutSegments)
    return failure(
        ErrorKind::bad_input,
        fmt::format("{}: expected fewer than {} edges in {} cuts through the axis, found "
                    "more",
                    name, kMostCutSegments, kMeshCuts));
  auto common = revolved_section(points, result.cuts, noise_mm, name);
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

/// Scales the mesh, and the figures in `result`.
Result<Revolved> scaled_to(double height_mm, Revolved pot, solid::TriangleMesh& mesh,
                           MeshPot& result, const std::string& name) {
  // Twice, because the height of a mesh in metres is known to a thousandth only.
  for (int k = 0; k < 2; ++k) {
    const double scale = height_mm / pot.section.height_mm;
    if (std::abs(scale - 1.0) < kSameScale) break;
    for (glm::dvec3& p : mesh.points) p *= scale;
    result.axis.through *= scale;
    result.scale *= scale;
    auto again = revolved(mesh, result.axis, 0.0, name);
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
  return failure(ErrorKind::bad_input, fmt::format("{}: expected a mesh of a pot, found {}", name,
                                                   counted(mesh.triangles.size(), "triangle")));
}

/// Along the axis that fits the mesh, with the opening up.
Result<Revolved> placed(solid::TriangleMesh& mesh, std::optional<double> height_mm, MeshPot& result,
                        const std::string& name) {
  result.axis = refined_axis(mesh, fitted_axis(mesh));
  auto pot = revolved(mesh, result.axis, 0.0, name);
  if (pot && opens_below(pot->section)) {
    result.axis.direction = -result.axis.direction;
    pot = revolved(mesh, result.axis, 0.0, name);
  }
  if (pot && height_mm) pot = scaled_to(*height_mm, std::move(*pot), mesh, result, name);
  return pot;
}

/// A revolved section as rings.
struct Made {
  Revolved pot;
  std::vector<CutOff> cuts;
  double limit_mm = 0.0;  ///< cuts beyond it have a part that is not of revolution
  DrawnPot drawn;
  Deviation deviation;       ///< of the rings from the other cuts that are complete
  std::size_t measured = 0;  ///< their number
};

/// `complete`: see complete_cuts.
Result<Made> rings_of(Revolved pot, const std::vector<bool>& complete,
                      const DrawnPotSettings& settings, const std::string& name) {
  Made made;
  made.limit_mm = part_limit_mm(largest_radius(pot.section));
  made.cuts = offsets(pot, made.limit_mm);
  const auto off = std::count_if(made.cuts.begin(), made.cuts.end(),
                                 [&](const CutOff& cut) { return cut.mm > made.limit_mm; });
  if (2 * static_cast<std::size_t>(off) > kMeshCuts)
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected a pot that is nearly of revolution, found a mesh that "
                               "is more than {:.3g} mm from it at {} of {} azimuths; few triangles "
                               "around the axis, or the noise of a scan, have the same effect",
                               name, made.limit_mm, off, kMeshCuts));
  auto drawn = drawn_pot(pot.section, settings, name);
  if (!drawn) return tl::make_unexpected(drawn.error());
  made.drawn = std::move(*drawn);
  const std::vector<Segment> rings = outline_of(slabs_of(made.drawn.pot.stack));
  for (std::size_t i = 0; i < kMeshCuts; ++i) {
    if (made.cuts[i].mm > made.limit_mm || !complete[i] || pot.cuts[i].empty()) continue;
    ++made.measured;
    const Deviation deviation = deviation_between(pot.cuts[i], rings);
    if (deviation.mm > made.deviation.mm) made.deviation = deviation;
  }
  made.pot = std::move(pot);
  return made;
}

/// The standard deviation of the mesh about its section, estimated from the median distance: half
/// of the length of all cuts is nearer than that.
double noise_of(const Revolved& pot) {
  constexpr double kOfMedian = 1.4826;  // of a normal distribution
  std::vector<glm::dvec2> middles;
  std::vector<std::pair<double, double>> off;  // with the length
  double length = 0.0;
  for (const std::vector<Segment>& cut : pot.cuts)
    for (const Segment& s : cut) {
      middles.push_back(0.5 * (s.from + s.to));
      off.emplace_back(0.0, glm::length(s.to - s.from));
      length += off.back().second;
    }
  const std::vector<double> distances = distances_from(outline_of(pot.section.slabs), middles);
  for (std::size_t i = 0; i < off.size(); ++i) off[i].first = distances[i];
  std::sort(off.begin(), off.end());
  double nearer = 0.0;
  for (const auto& [distance, own] : off)
    if ((nearer += own) >= 0.5 * length) return kOfMedian * distance;
  return 0.0;
}

/// Whether no rings fit the section well, because its lines go back and forth within less than the
/// height of a fine ring.
bool rough(const DrawnPot& drawn) {
  return drawn.deviation.mm > kDrawnDeviationMm || drawn.pot.stack.ring_height_mm() < kFineRingMm;
}

constexpr double kLeastNoiseMm = 1e-3;

/// Standard deviation of the noise [mm]. Less than kLeastNoiseMm: none, or not known.
double noise_of(const solid::TriangleMesh& mesh, const MeshAxis& axis, const std::string& name) {
  const auto noise_in = [&](double level_mm) {
    const auto pot = revolved(mesh, axis, level_mm, name, Edges::revolved);
    return pot ? noise_of(*pot) : 0.0;
  };
  const double first_mm = noise_in(0.0);
  if (first_mm < kLeastNoiseMm) return 0.0;
  // The first section follows the noise of level faces, so the estimate from it is too low.
  return std::max(noise_in(first_mm), kLeastNoiseMm);
}

/// The pot with level faces, where that is better; `result` gets the noise.
Result<Made> leveled(Made made, const solid::TriangleMesh& mesh, const std::vector<bool>& complete,
                     DrawnPotSettings settings, MeshPot& result, const std::string& name) {
  constexpr double kAim = 2.0;
  const double noise_mm = noise_of(mesh, result.axis, name);
  if (noise_mm < kLeastNoiseMm) return made;
  auto pot = revolved(mesh, result.axis, noise_mm, name);
  if (!pot) return made;
  settings.deviation_mm = std::max(settings.deviation_mm, kAim * noise_mm);
  auto level = rings_of(std::move(*pot), complete, settings, name);
  if (!level) return made;
  const double gained_mm = made.deviation.mm - level->deviation.mm;
  const bool fewer = level->drawn.pot.stack.size() < made.drawn.pot.stack.size();
  if (gained_mm < noise_mm && !(fewer && gained_mm > -noise_mm)) return made;
  result.noise_mm = noise_mm;
  result.aimed_mm = settings.deviation_mm;
  return std::move(*level);
}

Result<MeshPot> pot_of_body(solid::TriangleMesh mesh, const MeshPotSettings& settings,
                            const std::string& name) {
  MeshPot result;
  auto pot = placed(mesh, settings.height_mm, result, name);
  if (!pot) return tl::make_unexpected(pot.error());
  DrawnPotSettings by_itself = settings.rings;
  by_itself.ring_height_mm.reset();
  result.aimed_mm = by_itself.deviation_mm;
  const std::vector<bool> complete = complete_cuts(mesh, about_axis(mesh, result.axis));
  auto made = rings_of(std::move(*pot), complete, by_itself, name);
  if (made && rough(made->drawn))
    made = leveled(std::move(*made), mesh, complete, by_itself, result, name);
  if (made && settings.rings.ring_height_mm)
    made = rings_of(std::move(made->pot), complete, settings.rings, name);
  if (!made) return tl::make_unexpected(made.error());
  result.pot = std::move(made->drawn.pot);
  result.off_mm = made->drawn.deviation.mm;
  result.deviation = made->deviation;
  result.measured = made->measured;
  result.axis.through += made->pot.foot_mm * result.axis.direction;
  result.section_mm3 = made->pot.section.volume_mm3();
  result.parts = parts_of(made->cuts, made->limit_mm);
  return result;
}

}  // namespace

Result<MeshPot> mesh_pot(solid::TriangleMesh mesh, const MeshPotSettings& settings,
                         const std::string& name) {
  if (auto sized = check_size(mesh, name); !sized) return tl::make_unexpected(sized.error());
  // The axis of two bodies lies between them or runs through both, so that the reason alone would
  // mislead.
  const std::size_t bodies = separate_bodies(mesh);
  return pot_of_body(std::move(mesh), settings, name).map_error([&](Error error) {
    const std::string begin = name + ": ";
    if (error.kind == ErrorKind::bad_input && bodies > 1 && error.message.starts_with(begin))
      error.message.insert(begin.size(), "the mesh has " + std::to_string(bodies) +
                                             " separate bodies: keep one; all of them together: ");
    return error;
  });
}

}  // namespace clay::importing
