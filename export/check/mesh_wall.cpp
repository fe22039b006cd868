#include "claystack/export/check.hpp"

#include "core/parallel_parts.hpp"
#include "export/solid/box_tree.hpp"
#include "export/solid/cgal_versions.hpp"
#include "export/solid/mesh_topology.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <new>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace clay::solid::inline check {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

/// Twice the area, as a vector along the outward normal.
glm::dvec3 doubled_area(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return glm::cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
}

/// The n-th van der Corput number: its digits mirrored at the point.
double radical_inverse(std::size_t n, std::size_t base) {
  double value = 0.0, digit = 1.0;
  for (; n > 0; n /= base) {
    digit /= static_cast<double>(base);
    value += digit * static_cast<double>(n % base);
  }
  return value;
}

/// Points on the surface, evenly distributed by area.
class SurfaceSampling {
 public:
  SurfaceSampling(const TriangleMesh& mesh, std::size_t samples) : mesh_(mesh), samples_(samples) {
    double area = 0.0;
    area_up_to_.reserve(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      area_up_to_.push_back(area += glm::length(doubled_area(mesh, t)));
  }

  [[nodiscard]] double area() const { return area_up_to_.empty() ? 0.0 : area_up_to_.back(); }

  /// The triangle at the middle of the sample's share of the area.
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

struct Shortest {
  double mm = std::numeric_limits<double>::infinity();
  glm::dvec3 place{0.0};
  std::uint32_t triangle = 0;
  std::size_t sample = std::numeric_limits<std::size_t>::max();

  void add(const Shortest& other) {
    if (other.mm < mm || (other.mm == mm && other.sample < sample)) *this = other;
  }
};

/// The result of some of the rays.
struct Found {
  SampledWall wall;  ///< only its counts
  Shortest least;
  Shortest at_an_end;  ///< with the end of the clay close on one side

  void add(const Found& other) {
    const SampledWall& found = other.wall;
    least.add(other.least);
    at_an_end.add(other.at_an_end);
    wall.rays += found.rays;
    wall.oblique += found.oblique;
    wall.escaped += found.escaped;
  }

  /// A compact body ends close to every ray. It is as thick as they are long.
  [[nodiscard]] SampledWall result() const {
    const Shortest& shortest = std::isinf(least.mm) ? at_an_end : least;
    SampledWall result = wall;
    result.least_mm = shortest.mm;
    result.place = shortest.place;
    result.triangle = shortest.triangle;
    return result;
  }
};

class WallRay {
 public:
  WallRay(const TriangleMesh& mesh, const glm::dvec3& begin, const glm::dvec3& inward)
      : mesh_(mesh),
        begin_(begin),
        inward_(inward),
        ray_(point(begin), point(begin + inward)),
        along_(begin + inward - begin) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(along_[axis]) > std::abs(along_[longest_])) longest_ = axis;
      // Not infinite, because infinity times 0 is NaN.
      per_mm_[axis] = along_[axis] == 0.0 ? std::numeric_limits<double>::max() : 1.0 / along_[axis];
    }
  }

  struct Hit {
    std::uint32_t triangle = 0;
    double facing = 0.0;       ///< cosine between its normal and the ray
    std::optional<double> mm;  ///< empty if the ray lies in the triangle's plane
  };

  /// Finds the first back face. Decrements `steps` for each visited box and triangle; stops at 0.
  std::optional<Hit> first_hit(const BoxTree& tree, std::size_t& steps) {
    const auto step = [&] { steps -= steps > 0 ? 1 : 0; };
    tree.for_each_near(
        [&](const BoxTree::Box& box) {
          step();
          return entry(box);
        },
        [&] { return steps > 0 ? nearest_ : -1.0; },
        [&](std::span<const std::uint32_t> triangles) {
          for (const std::uint32_t t : triangles) {
            step();
            look_at(t);
          }
        });
    return hit_;
  }

 private:
  static Point point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

  [[nodiscard]] double entry(const BoxTree::Box& box) const {
    const glm::dvec3 a = (box.low - begin_) * per_mm_, b = (box.high - begin_) * per_mm_;
    const glm::dvec3 in = glm::min(a, b), out = glm::max(a, b);
    double first = std::max({0.0, in.x, in.y, in.z});
    double last = std::min({out.x, out.y, out.z});
    if (!(first <= last)) return BoxTree::kNever;
    const glm::dvec3 across(box.across);
    const double rise = glm::dot(across, along_), begin = glm::dot(across, begin_);
    // Nearly parallel to the planes, rounding decides on which side the ray meets them.
    if (std::abs(rise) > 1e-6) {
      const double from = (box.from - begin) / rise, to = (box.to - begin) / rise;
      first = std::max(first, std::min(from, to));
      last = std::min(last, std::max(from, to));
    } else if (begin < box.from - 2e-6 * last || begin > box.to + 2e-6 * last) {
      return BoxTree::kNever;
    }
    return first <= last ? first : BoxTree::kNever;
  }

  /// True if the line passes the triangle on one side by more than the rounding error.
  [[nodiscard]] bool passes(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const {
    const double farthest2 = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    const double margin = 1e-14 * farthest2;  // 90 roundings
    const auto differ = [&](double x, double y) {
      return std::max(x, y) > margin && std::min(x, y) < -margin;
    };
    const double ab = glm::dot(along_, glm::cross(a, b)), bc = glm::dot(along_, glm::cross(b, c));
    if (differ(ab, bc)) return true;
    const double ca = glm::dot(along_, glm::cross(c, a));
    return differ(ab, ca) || differ(bc, ca);
  }

  void look_at(std::uint32_t triangle) {
    const auto& [i, j, k] = mesh_.triangles[triangle];
    const glm::dvec3 &a = mesh_.points[i], &b = mesh_.points[j], &c = mesh_.points[k];
    // Both tests exclude most triangles from the exact tests, and decide no close case.
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    if (glm::dot(inward_, normal) < -1e-12 * size) return;
    if (passes(a - begin_, b - begin_, c - begin_)) return;
    const double facing = glm::dot(inward_, glm::normalize(normal));
    if (!(facing > 0.0)) return;  // a front face
    const Kernel::Triangle_3 whole(point(a), point(b), point(c));
    if (whole.is_degenerate()) return;
    const auto met = CGAL::intersection(ray_, whole);
    if (!met) return;
    // A ray that is not in the plane of a triangle meets it in a point.
    if (const auto* at = cgal::get_if<Point>(*met)) {
      const glm::dvec3 place(at->x(), at->y(), at->z());
      keep({triangle, facing, glm::length(place - begin_)}, share_of_ray(*at));
    } else {
      const auto& in_plane = *cgal::get_if<Kernel::Segment_3>(*met);
      keep({triangle, facing, {}},
           std::min(share_of_ray(in_plane.source()), share_of_ray(in_plane.target())));
    }
  }

  [[nodiscard]] double share_of_ray(const Point& p) const {
    return (p[longest_] - begin_[longest_]) / along_[longest_];
  }

  void keep(const Hit& hit, double share) {
    if (share > nearest_ || (share == nearest_ && hit_ && hit_->triangle < hit.triangle)) return;
    nearest_ = share;
    hit_ = hit;
  }

  const TriangleMesh& mesh_;
  glm::dvec3 begin_, inward_;
  Kernel::Ray_3 ray_;
  glm::dvec3 along_, per_mm_;
  int longest_ = 0;
  double nearest_ = std::numeric_limits<double>::max();
  std::optional<Hit> hit_;
};

/// A ray that meets a face at less than 45 degrees grazes it: the sine of the angle.
constexpr double kGrazing = std::numbers::sqrt2 / 2.0;

/// Farther from the end of the clay than this, in thicknesses, the boundary around it is three
/// thicknesses long, as `min_wall` requires, even if the clay ends in a wedge: 1.5, seen at 22.5
/// degrees.
constexpr double kEndThicknesses = 1.63;

class WallProbe {
 public:
  WallProbe(const TriangleMesh& mesh, const SurfaceSampling& sampling)
      : mesh_(mesh), tree_(mesh), sampling_(sampling) {}

  /// A ray is not counted if the steps run out.
  void probe(std::size_t sample, std::size_t& steps, Found& found) const {
    const std::uint32_t triangle = sampling_.triangle(sample);
    const glm::dvec3 inward = -glm::normalize(doubled_area(mesh_, triangle));
    const glm::dvec3 begin = sampling_.place(sample);
    const auto hit = WallRay(mesh_, begin, inward).first_hit(tree_, steps);
    if (steps == 0) return;
    Found one;
    one.wall.rays = 1;
    one.wall.escaped = hit ? 0 : 1;
    one.wall.oblique = hit && hit->facing < kGrazing ? 1 : 0;
    if (hit && one.wall.oblique == 0 && hit->mm) {
      const Shortest ray{*hit->mm, begin, triangle, sample};
      // The sides are worth looking at only where the wall would be the thinnest.
      if (ray.mm < found.least.mm && ends_beside(begin, inward, ray.mm, steps)) {
        one.wall.oblique = 1;
        one.at_an_end = ray;
      } else {
        one.least = ray;
      }
    }
    found.add(one);
  }

 private:
  /// Whether the clay ends close to the middle of a wall, on one side of it only, as it does at the
  /// end of a lip or of a flange. A rod ends on both sides alike.
  [[nodiscard]] bool ends_beside(const glm::dvec3& begin, const glm::dvec3& inward,
                                 double thickness_mm, std::size_t& steps) const {
    const glm::dvec3 middle = begin + 0.5 * thickness_mm * inward;
    const glm::dvec3 aside = std::abs(inward.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(inward, aside)), v = glm::cross(inward, u);
    struct Way {
      double mm = std::numeric_limits<double>::infinity();
      bool grazes = false;  // a leaning face, beside which the clay goes on
    };
    const auto way = [&](const glm::dvec3& direction) {
      const auto hit = WallRay(mesh_, middle, direction).first_hit(tree_, steps);
      return hit && hit->mm ? Way{*hit->mm, hit->facing < kGrazing} : Way{};
    };
    constexpr int kLines = 4;
    for (int k = 0; k < kLines; ++k) {
      const double angle = std::numbers::pi * k / kLines;
      const glm::dvec3 direction = std::cos(angle) * u + std::sin(angle) * v;
      Way nearer = way(direction), farther = way(-direction);
      if (nearer.mm > farther.mm) std::swap(nearer, farther);
      if (nearer.mm < kEndThicknesses * thickness_mm &&
          (farther.mm >= thickness_mm || farther.grazes))
        return true;
    }
    return false;
  }

  const TriangleMesh& mesh_;
  BoxTree tree_;
  const SurfaceSampling& sampling_;
};

/// The numbers below `count`, each once, ordered so that the first few are evenly spread.
class EvenOrder {
 public:
  explicit EvenOrder(std::size_t count)
      : count_(count), stride_(static_cast<std::size_t>(static_cast<double>(count) * 0.618)) {
    while (std::gcd(stride_, count_) != 1) ++stride_;
  }
  [[nodiscard]] std::size_t operator[](std::size_t i) const { return i * stride_ % count_; }

 private:
  std::size_t count_, stride_;
};

/// All rays, in parts, each with its share of the steps.
class WallSearch {
 public:
  WallSearch(const WallProbe& probe, std::size_t samples, std::size_t most_steps,
             const std::function<void(std::size_t)>& progress)
      : probe_(probe), samples_(samples), most_steps_(most_steps), progress_(progress) {}

  SampledWall run() {
    std::vector<Found> parts((samples_ + kPartRays - 1) / kPartRays);
    for_each_part(parts.size(), [&](std::size_t part) { run_part(part, parts[part]); });
    Found all;
    for (const Found& part : parts) all.add(part);
    return all.result();
  }

 private:
  static constexpr std::size_t kPartRays = 1024;
  static constexpr std::size_t kFewRays = 64;  ///< rays per progress report

  void run_part(std::size_t part, Found& found) {
    const std::size_t begin = part * kPartRays, rays = std::min(samples_ - begin, kPartRays);
    const EvenOrder order(rays);
    std::size_t steps = most_steps_ / samples_ * rays;
    std::size_t reported = 0;
    for (std::size_t i = 0; i < rays && steps > 0; ++i) {
      step_of_loop();
      probe_.probe(begin + order[i], steps, found);
      if (i % kFewRays == 0) {
        report_cast(i + 1 - reported);
        reported = i + 1;
      }
    }
    report_cast(rays - reported);
  }

  void report_cast(std::size_t more) {
    if (!progress_ || more == 0) return;
    const std::lock_guard lock(progress_mutex_);
    progress_(done_ += more);
  }

  const WallProbe& probe_;
  std::size_t samples_, most_steps_;
  const std::function<void(std::size_t)>& progress_;
  std::mutex progress_mutex_;
  std::size_t done_ = 0;
};

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

Result<SampledWall> sampled_wall(const TriangleMesh& mesh, std::size_t samples,
                                 std::size_t most_steps,
                                 const std::function<void(std::size_t)>& progress) try {
  if (const auto good = check_input(mesh, samples); !good) return tl::make_unexpected(good.error());
  const SurfaceSampling sampling(mesh, samples);
  // Not finite if a point is not.
  if (!(sampling.area() > 0.0) || !std::isfinite(sampling.area()))
    return failure(ErrorKind::bad_input,
                   "expected a surface of finite area to measure the wall of, found none");
  const WallProbe probe(mesh, sampling);
  return WallSearch(probe, samples, most_steps, progress).run();
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, "wall not measured: not enough memory");
} catch (const std::exception& e) {
  return failure(ErrorKind::unsound, std::string("wall not measured: ") + e.what());
}

}  // namespace clay::solid::inline check
