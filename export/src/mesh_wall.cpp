#include "claystack/export/mesh_wall.hpp"

#include "mesh_topology.hpp"
#include "parallel_parts.hpp"
#include "triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

using Point = TriangleTree::Kernel::Point_3;
using Ray = TriangleTree::Kernel::Ray_3;

/// Twice the area, along the outward normal.
glm::dvec3 doubled_area(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
}

/// The n-th number of van der Corput's sequence: its digits mirrored at the point.
double radical_inverse(std::size_t n, std::size_t base) {
  double value = 0.0, digit = 1.0;
  for (; n > 0; n /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(n % base);
  }
  return value;
}

/// Places on the surface, evenly by area.
class SurfaceSampling {
 public:
  SurfaceSampling(const TriangleMesh& mesh, std::size_t samples) : mesh_(mesh), samples_(samples) {
    double area = 0.0;
    area_up_to_.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      area_up_to_.push_back(area += glm::length(doubled_area(mesh, t)));
  }

  [[nodiscard]] double area() const { return area_up_to_.empty() ? 0.0 : area_up_to_.back(); }

  /// The triangle in the middle of the sample's share of the area.
  [[nodiscard]] std::uint32_t triangle(std::size_t sample) const {
    const double share = (static_cast<double>(sample) + 0.5) / static_cast<double>(samples_);
    const auto found = std::upper_bound(area_up_to_.begin(), area_up_to_.end(), share * area());
    const auto number = std::min<std::ptrdiff_t>(
        found - area_up_to_.begin(), static_cast<std::ptrdiff_t>(area_up_to_.size()) - 1);
    return static_cast<std::uint32_t>(number);
  }

  [[nodiscard]] glm::dvec3 place(std::size_t sample) const {
    const auto& [a, b, c] = mesh_.triangles[triangle(sample)];
    double u = radical_inverse(sample + 1, 2), v = radical_inverse(sample + 1, 3);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const glm::dvec3 &p = mesh_.points[a], &q = mesh_.points[b], &r = mesh_.points[c];
    return p + u * (q - p) + v * (r - p);
  }

 private:
  const TriangleMesh& mesh_;
  std::size_t samples_;
  std::vector<double> area_up_to_;
};

class WallProbe {
 public:
  WallProbe(const TriangleMesh& mesh, const TriangleTree& tree, const SurfaceSampling& sampling)
      : mesh_(mesh), tree_(tree), sampling_(sampling) {}

  void probe(std::size_t sample, SampledWall& wall) const {
    const std::uint32_t triangle = sampling_.triangle(sample);
    const glm::dvec3 inward = -glm::normalize(doubled_area(mesh_, triangle));
    const glm::dvec3 begin = sampling_.place(sample);
    ++wall.rays;
    const auto facing = [&](const auto id) {
      return glm::dot(inward, glm::normalize(doubled_area(mesh_, tree_.number(id))));
    };
    const auto seen_from_front = [&](const auto id) { return !(facing(id) > 0.0); };
    const auto hit = tree_.boxes().first_intersection(
        Ray(TriangleTree::point(begin), TriangleTree::point(begin + inward)), seen_from_front);
    // A tree of one triangle does not ask what to pass.
    if (!hit || seen_from_front(hit->second)) {
      ++wall.escaped;
      return;
    }
    if (facing(hit->second) < std::numbers::sqrt2 / 2.0) {
      ++wall.oblique;
      return;
    }
    // A ray that is not in the plane of a triangle meets it in a point.
    const auto* met = boost::get<Point>(&hit->first);
    if (met == nullptr) return;
    const double mm = glm::length(glm::dvec3(met->x(), met->y(), met->z()) - begin);
    if (mm < wall.least_mm) {
      wall.least_mm = mm;
      wall.place = begin;
      wall.triangle = triangle;
    }
  }

 private:
  const TriangleMesh& mesh_;
  const TriangleTree& tree_;
  const SurfaceSampling& sampling_;
};

SampledWall merged(const std::vector<SampledWall>& parts) {
  SampledWall all;
  for (const SampledWall& part : parts) {
    if (part.least_mm < all.least_mm) {
      all.least_mm = part.least_mm;
      all.place = part.place;
      all.triangle = part.triangle;
    }
    all.rays += part.rays;
    all.oblique += part.oblique;
    all.escaped += part.escaped;
  }
  return all;
}

Result<void> check_input(const TriangleMesh& mesh, std::size_t samples) {
  if (samples < 1 || samples > kMostWallSamples)
    return failure(ErrorKind::bad_input, "expected 1 to " + std::to_string(kMostWallSamples) +
                                             " wall samples, found " + std::to_string(samples));
  if (mesh.triangles.empty() || mesh.triangles.size() > kMaxTriangles)
    return failure(ErrorKind::bad_input, "expected 1 to " + std::to_string(kMaxTriangles) +
                                             " triangles to measure the wall of, found " +
                                             std::to_string(mesh.triangles.size()));
  if (indices_out_of_range(mesh.points.size(), mesh.triangles).found())
    return failure(ErrorKind::bad_input,
                   "expected indices within the points to measure the wall, found one beyond");
  return {};
}

}  // namespace

Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples) try {
  if (const auto good = check_input(mesh, samples); !good) return tl::make_unexpected(good.error());
  const SurfaceSampling sampling(mesh, samples);
  // Not finite where a point is not.
  if (!(sampling.area() > 0.0) || !std::isfinite(sampling.area()))
    return failure(ErrorKind::bad_input,
                   "expected a surface of finite area to measure the wall of, found none");
  const TriangleTree tree(mesh);
  const WallProbe prober(mesh, tree, sampling);
  constexpr std::size_t kPartRays = 1024;
  std::vector<SampledWall> parts((samples + kPartRays - 1) / kPartRays);
  for_each_part(parts.size(), [&](std::size_t part) {
    const std::size_t end = std::min(samples, (part + 1) * kPartRays);
    for (std::size_t i = part * kPartRays; i < end; ++i) prober.probe(i, parts[part]);
  });
  return merged(parts);
} catch (const std::exception& e) {
  return failure(ErrorKind::unsound, std::string("wall not measured: ") + e.what());
}

}  // namespace clay::solid
