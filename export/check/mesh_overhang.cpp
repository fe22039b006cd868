#include "claystack/export/check.hpp"

#include "claystack/export/walls.hpp"
#include "export/solid/area_shares.hpp"
#include "export/solid/box_tree.hpp"
#include "export/solid/surface_samples.hpp"
#include "export/walls/steepest_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline check {
namespace {

constexpr std::size_t kPlaces = 100'000;
constexpr double kUnheld = std::numeric_limits<double>::infinity();
/// Faces this close in height are level with each other: more than float32 rounds.
constexpr double kLevelMm = 1e-4;

bool readable(const TriangleMesh& mesh) {
  return std::ranges::all_of(mesh.triangles, [&](const auto& triangle) {
    return std::ranges::all_of(triangle, [&](std::uint32_t v) {
      if (v >= mesh.points.size()) return false;
      const glm::dvec3& p = mesh.points[v];
      return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
  });
}

/// The part of a triangle between two heights below a place, relative to the place.
class Slice {
 public:
  Slice(const std::array<glm::dvec3, 3>& corners, double low, double high) {
    for (const glm::dvec3& p : corners) points_[size_++] = p;
    keep([&](const glm::dvec3& p) { return high - p.z; });
    keep([&](const glm::dvec3& p) { return p.z - low; });
  }

  /// The least slope of a line from the place down to it: 0 above it, else at its border.
  [[nodiscard]] double slope() const {
    if (size_ == 0) return kUnheld;
    double least = kUnheld;
    bool left = false, right = false;
    for (std::size_t i = 0; i < size_; ++i) {
      const glm::dvec3 &a = points_[i], &b = points_[(i + 1) % size_];
      const double side = a.x * b.y - a.y * b.x;
      left |= side >= 0.0;
      right |= side <= 0.0;
      least = std::min(least, slope_along(a, b));
    }
    return size_ > 2 && left != right ? 0.0 : least;
  }

 private:
  /// Cuts off the points where `inside` is negative.
  template <class Inside>
  void keep(const Inside& inside) {
    std::array<glm::dvec3, 5> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const glm::dvec3 &a = points_[i], &b = points_[(i + 1) % size_];
      const double at_a = inside(a), at_b = inside(b);
      if (at_a >= 0.0) kept[count++] = a;
      if ((at_a >= 0.0) != (at_b >= 0.0)) kept[count++] = glm::mix(a, b, at_a / (at_a - at_b));
    }
    points_ = kept;
    size_ = count;
  }

  /// The square of the slope has one minimum on the line through both points.
  static double slope_along(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec2 from(a), along = glm::dvec2(b) - from;
    const double deep = -a.z, deeper = a.z - b.z;
    const auto slope = [&](double t) {
      return glm::length(from + t * along) / (deep + t * deeper);
    };
    const double below = glm::dot(along, along) * deep - deeper * glm::dot(from, along);
    const double t = (deeper * glm::dot(from, from) - glm::dot(from, along) * deep) / below;
    const double ends = std::min(slope(0.0), slope(1.0));
    return t > 0.0 && t < 1.0 ? std::min(ends, slope(t)) : ends;
  }

  std::array<glm::dvec3, 5> points_;
  std::size_t size_ = 0;
};

class ClayBelowMesh {
 public:
  explicit ClayBelowMesh(const TriangleMesh& mesh)
      : mesh_(mesh), tree_(mesh), bed_(extent_of(mesh).low.z) {}

  [[nodiscard]] double height(const glm::dvec3& place) const { return place.z - bed_; }

  /// The least slope of a line from the place down to clay or to the bed, if it is below `most`.
  [[nodiscard]] double slope(const glm::dvec3& place, double most) const {
    if (height(place) <= kOverhangDepthMm) return 0.0;
    double least = most;
    tree_.for_each_near([&](const BoxTree::Box& box) { return entry(place, box); },
                        [&] { return least; },
                        [&](std::span<const std::uint32_t> triangles) {
                          for (const std::uint32_t t : triangles)
                            least = std::min(least, slope(place, t));
                        });
    return least;
  }

 private:
  static double entry(const glm::dvec3& place, const BoxTree::Box& box) {
    const double depth = std::min(place.z + kLevelMm - box.low.z, kOverhangDepthMm + kLevelMm);
    if (depth <= 0.0 || box.high.z < place.z - kOverhangDepthMm) return BoxTree::kNever;
    const glm::dvec2 p(place);
    const glm::dvec2 aside = glm::max(glm::dvec2(box.low) - p, p - glm::dvec2(box.high));
    return glm::length(glm::max(aside, glm::dvec2(0.0))) / depth;
  }

  [[nodiscard]] double slope(const glm::dvec3& place, std::uint32_t triangle) const {
    // Clay that faces up supports the clay that lies on it.
    constexpr double kFacesUp = 0.1;
    const glm::dvec3 normal = doubled_area(mesh_, triangle);
    const double lift = normal.z > kFacesUp * glm::length(normal) ? kLevelMm : 0.0;
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = mesh_.points[mesh_.triangles[triangle][i]] - place;
      corners[i].z -= lift;
    }
    const double low = -kOverhangDepthMm - lift, high = lift > 0.0 ? -1e-3 * kLevelMm : -kLevelMm;
    return Slice(corners, low, high).slope();
  }

  const TriangleMesh& mesh_;
  BoxTree tree_;
  double bed_;
};

std::vector<UndersidePart<glm::dvec3>> undersides(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> down;
  double area_mm2 = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (const glm::dvec3 doubled = doubled_area(mesh, t); doubled.z < 0.0) {
      down.push_back(t);
      area_mm2 += 0.5 * glm::length(doubled);
    }
  std::vector<UndersidePart<glm::dvec3>> parts;
  if (down.empty()) return parts;
  parts.reserve(kPlaces);
  const SurfaceSamples samples(mesh, std::move(down), kPlaces);
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const glm::dvec3 normal = doubled_area(mesh, samples.triangle(i));
    const double level = glm::length(glm::dvec2(normal));
    parts.push_back({level > 0.0 ? -normal.z / level : kUnheld,
                     area_mm2 / static_cast<double>(kPlaces), samples.place(i)});
  }
  return parts;
}

}  // namespace

std::optional<MeshOverhang> steepest_overhang(const TriangleMesh& mesh) {
  if (mesh.triangles.empty() || !readable(mesh)) return std::nullopt;
  const ClayBelowMesh clay(mesh);
  using Part = UndersidePart<glm::dvec3>;
  const auto steepest = steepest_part(undersides(mesh), [&](const Part& part, const auto& found) {
    const double most = std::min(part.slope, kSteepestHeld);
    const double held = clay.slope(part.place, most);
    found({held < most ? held : part.slope, part.area_mm2, part.place});
  });
  if (!steepest) return MeshOverhang{};
  return MeshOverhang{std::atan(steepest->slope) * 180.0 / std::numbers::pi, steepest->place,
                      clay.height(steepest->place)};
}

}  // namespace clay::solid::inline check
