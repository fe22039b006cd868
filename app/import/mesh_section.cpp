#include "app/import/mesh_section.hpp"

#include "app/import/level_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

namespace clay::importing {
namespace {

constexpr double kSameLevelMm = 5e-4;      // float32 coordinates of one level differ by less
constexpr std::size_t kMostLevels = 4000;  // of a mesh made of rings; a scan has one for each point
constexpr double kAgreeMm = 0.05;          // radii of facets of one circle
constexpr double kTreadMm = 0.05, kScannedTreadMm = 0.5;  // narrower steps are rounding or noise

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The radii of most azimuths: a middle value, the distance from it of a middle one, and the
/// distance that is still accepted.
struct Agreement {
  double middle = 0.0, scatter = 0.0, within = 0.0;

  explicit Agreement(const std::vector<double>& radii) : middle(median(radii)) {
    std::vector<double> off;
    for (const double r : radii) off.push_back(std::abs(r - middle));
    scatter = median(std::move(off));
    within = std::max(kAgreeMm, 4.0 * scatter);
  }
  [[nodiscard]] bool accepts(double radius) const { return std::abs(radius - middle) <= within; }
};

double mean_radius(const std::vector<double>& radii, const Agreement& agreement) {
  if (agreement.middle == 0.0) return 0.0;
  double sum = 0.0, count = 0.0;
  for (const double r : radii) {
    if (!agreement.accepts(r)) continue;
    sum += r * r;
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

struct CommonWall {
  Wall wall;
  double scatter_mm = 0.0;  ///< of the radii
};

/// The wall that most cuts have at one height; empty if most have none.
std::optional<CommonWall> common_wall(const std::vector<std::vector<Wall>>& walls,
                                      std::size_t height) {
  std::vector<double> inner, outer, all;
  for (const std::vector<Wall>& cut : walls) {
    all.push_back(cut[height].all_mm2);
    if (!(cut[height].outer_mm > 0.0)) continue;
    inner.push_back(cut[height].inner_mm);
    outer.push_back(cut[height].outer_mm);
  }
  if (2 * outer.size() < walls.size()) return std::nullopt;
  const Agreement within(inner), without(outer);
  return CommonWall{{mean_radius(inner, within), mean_radius(outer, without), median(all)},
                    std::max(within.scatter, without.scatter)};
}

std::vector<std::vector<Wall>> walls_at(const std::vector<std::vector<Segment>>& cuts,
                                        std::span<const double> heights) {
  std::vector<std::vector<Wall>> walls;
  for (const std::vector<Segment>& cut : cuts) walls.push_back(walls_of(cut, heights));
  return walls;
}

struct Levels {
  std::vector<double> heights;
  bool scanned = false;
};

/// `scan`: it is known to be one.
Levels levels_of(std::span<const glm::dvec3> points, bool scan) {
  std::vector<double> all;
  for (const glm::dvec3& p : points) all.push_back(p.z);
  std::sort(all.begin(), all.end());
  Levels levels;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end] - all[i] <= kSameLevelMm) ++end;
    levels.heights.push_back(0.5 * (all[i] + all[end - 1]));
    i = end;
  }
  levels.scanned = scan || levels.heights.size() > kMostLevels;
  if (!levels.scanned) return levels;
  levels.heights.clear();
  for (std::size_t i = 0; i <= kMostLevels; ++i)
    levels.heights.push_back(all.front() + (all.back() - all.front()) * static_cast<double>(i) /
                                               static_cast<double>(kMostLevels));
  return levels;
}

/// The slab between two levels, straight through its walls at a quarter and three quarters. Those
/// of a scan are too noisy to be continued.
Slab slab_through(double from, double to, const Wall& low, const Wall& high, bool scanned) {
  const auto ends = [&](double a, double b) {
    const bool bored = a > 0.0 && b > 0.0;
    return bored && !scanned
               ? std::pair{std::max(0.0, a - 0.5 * (b - a)), std::max(0.0, b + 0.5 * (b - a))}
               : std::pair{a, b};
  };
  const auto [outer_from, outer_to] = ends(low.outer_mm, high.outer_mm);
  const auto [inner_from, inner_to] = ends(low.inner_mm, high.inner_mm);
  return {from,
          to,
          outer_from,
          outer_to,
          std::min(inner_from, outer_from),
          std::min(inner_to, outer_to)};
}

void join(double& below, double& above, double tread_mm) {
  if (std::abs(below - above) <= tread_mm) below = above = 0.5 * (below + above);
}

/// The centre of the outside at one height, by the first harmonic of the radii that agree; empty if
/// they are too few.
std::optional<glm::dvec2> centre_of(const std::vector<std::vector<Wall>>& walls, std::size_t height,
                                    const Agreement& agreed) {
  glm::dmat3 normal(0.0);
  glm::dvec3 sums(0.0);
  for (std::size_t cut = 0; cut < walls.size(); ++cut) {
    const double radius = walls[cut][height].outer_mm;
    if (!(radius > 0.0) || !agreed.accepts(radius)) continue;
    const glm::dvec3 waves{1.0, std::cos(azimuth_of_cut(cut)), std::sin(azimuth_of_cut(cut))};
    normal += glm::outerProduct(waves, waves);
    sums += (radius - agreed.middle) * waves;
  }
  if (!(std::abs(glm::determinant(normal)) > 1.0)) return std::nullopt;
  const glm::dvec3 wave = glm::inverse(normal) * sums;
  return glm::dvec2{wave.y, wave.z};
}

/// Offset of the outside from the axis [mm]: along x and y at height 0, and its change per mm of
/// height.
struct Decentring {
  glm::dvec2 at_zero{0.0}, per_mm{0.0};
};

Decentring decentring(const std::vector<std::vector<Segment>>& cuts, double low, double high) {
  constexpr std::size_t kHeights = 120;
  std::vector<double> heights;
  for (std::size_t i = 0; i < kHeights; ++i)
    heights.push_back(low + (high - low) * (static_cast<double>(i) + 0.5) / kHeights);
  const auto walls = walls_at(cuts, heights);
  std::vector<std::optional<Agreement>> agreed(kHeights);
  for (std::size_t h = 0; h < kHeights; ++h) {
    std::vector<double> outer;
    for (const auto& cut : walls)
      if (cut[h].outer_mm > 0.0) outer.push_back(cut[h].outer_mm);
    if (2 * outer.size() >= cuts.size()) agreed[h].emplace(outer);
  }
  // A tilt also shifts each point in height, along the slope of the wall.
  glm::dmat2 normal(0.0);
  glm::dvec2 along_x(0.0), along_y(0.0);
  for (std::size_t h = 1; h + 1 < kHeights; ++h) {
    if (!agreed[h - 1] || !agreed[h] || !agreed[h + 1]) continue;
    const double slope =
        (agreed[h + 1]->middle - agreed[h - 1]->middle) / (heights[h + 1] - heights[h - 1]);
    if (std::abs(slope) > 3.0) continue;
    const glm::dvec2 known{1.0, heights[h] + agreed[h]->middle * slope};
    const auto centre = centre_of(walls, h, *agreed[h]);
    if (!centre) continue;
    normal += glm::outerProduct(known, known);
    along_x += centre->x * known;
    along_y += centre->y * known;
  }
  if (!(std::abs(glm::determinant(normal)) > 1e-9)) return {};
  const glm::dmat2 solve = glm::inverse(normal);
  const glm::dvec2 x = solve * along_x, y = solve * along_y;
  return {{x.x, y.x}, {x.y, y.y}};
}

/// The slabs that most cuts have in common, without gaps.
Result<std::vector<ScannedSlab>> common_slabs(const Levels& levels,
                                              const std::vector<std::vector<Segment>>& cuts,
                                              const std::string& name) {
  std::vector<double> heights;
  for (std::size_t i = 0; i + 1 < levels.heights.size(); ++i)
    for (const double part : {0.25, 0.75})
      heights.push_back(levels.heights[i] + part * (levels.heights[i + 1] - levels.heights[i]));
  const auto walls = walls_at(cuts, heights);
  std::vector<ScannedSlab> slabs;
  for (std::size_t i = 0; i + 1 < levels.heights.size(); ++i) {
    const auto low = common_wall(walls, 2 * i), high = common_wall(walls, 2 * i + 1);
    if (!low || !high) continue;
    const double from = levels.heights[i], to = levels.heights[i + 1];
    if (!slabs.empty() && slabs.back().slab.to_mm != from)
      return failure(
          ErrorKind::bad_input,
          fmt::format("{}: expected clay around the axis at every height, found none from "
                      "{:.3f} to {:.3f} mm above the lowest clay; remove the part below or above "
                      "this gap",
                      name, slabs.back().slab.to_mm - slabs.front().slab.from_mm,
                      from - slabs.front().slab.from_mm));
    slabs.push_back({slab_through(from, to, low->wall, high->wall, levels.scanned),
                     std::max(low->scatter_mm, high->scatter_mm),
                     0.5 * (low->wall.all_mm2 + high->wall.all_mm2)});
  }
  if (slabs.empty())
    return failure(ErrorKind::bad_input,
                   fmt::format("{}: expected a closed mesh around an axis, found clay around none; "
                               "claystack check {} reports the faults of the mesh",
                               name, name));
  return slabs;
}

}  // namespace

MeshAxis refined_axis(const solid::TriangleMesh& mesh, MeshAxis axis) {
  for (int round = 0; round < 6; ++round) {
    const auto points = about_axis(mesh, axis);
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(),
                            [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; });
    const Decentring off = decentring(mesh_cuts(mesh, points), low->z, high->z);
    const glm::dmat3 frame = frame_of(axis);
    axis.through += frame * glm::dvec3(off.at_zero, 0.0);
    axis.direction = glm::normalize(frame * glm::dvec3(off.per_mm, 1.0));
    if (glm::length(off.at_zero) < 1e-7 && glm::length(off.per_mm) < 1e-10) break;
  }
  return axis;
}

Result<RevolvedSection> revolved_section(std::span<const glm::dvec3> points,
                                         const std::vector<std::vector<Segment>>& cuts,
                                         double noise_mm, const std::string& name) {
  const Levels levels = levels_of(points, noise_mm > 0.0);
  const auto common = common_slabs(levels, cuts, name);
  if (!common) return tl::make_unexpected(common.error());
  RevolvedSection result;
  std::vector<Slab>& slabs = result.section.slabs;
  slabs = with_level_faces(*common, noise_mm);
  result.foot_mm = slabs.front().from_mm;
  const double tread = levels.scanned ? kScannedTreadMm : kTreadMm;
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    slabs[i].from_mm -= result.foot_mm;
    slabs[i].to_mm -= result.foot_mm;
    if (i == 0) continue;
    join(slabs[i - 1].outer_to_mm, slabs[i].outer_from_mm, tread);
    join(slabs[i - 1].inner_to_mm, slabs[i].inner_from_mm, tread);
  }
  result.section.height_mm = slabs.back().to_mm;
  result.section.axis = AxisRule::at;
  return result;
}

}  // namespace clay::importing
