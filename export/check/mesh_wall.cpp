#include "claystack/export/check.hpp"

#include "core/parallel_parts.hpp"
#include "export/check/surface_sampling.hpp"
#include "export/check/wall_ray.hpp"
#include "export/solid/box_tree.hpp"
#include "export/solid/mesh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
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

struct Shortest {
  double mm = std::numeric_limits<double>::infinity();
  glm::dvec3 place{0.0};
  std::uint32_t triangle = 0;
  std::size_t sample = std::numeric_limits<std::size_t>::max();

  void add(const Shortest& other) {
    if (other.mm < mm || (other.mm == mm && other.sample < sample)) *this = other;
  }
};

/// The thickest place of a body in which every ray is close to an end.
struct Thickest {
  double room_mm = 0.0;  ///< twice the distance from the middle of the ray to the nearest face seen
  glm::dvec3 place{0.0};
  std::uint32_t triangle = 0;
  std::size_t sample = std::numeric_limits<std::size_t>::max();

  void add(const Thickest& other) {
    if (other.room_mm > room_mm || (other.room_mm == room_mm && other.sample < sample))
      *this = other;
  }
};

/// The result of some of the rays.
struct Found {
  SampledWall wall;  ///< only its counts
  Shortest least;
  Thickest at_an_end;  ///< of the rays near which the clay ends

  void add(const Found& other) {
    const SampledWall& found = other.wall;
    least.add(other.least);
    at_an_end.add(other.at_an_end);
    wall.rays += found.rays;
    wall.oblique += found.oblique;
    wall.escaped += found.escaped;
  }

  /// A compact body ends close to every ray. Its thickness is that of its thickest place.
  [[nodiscard]] SampledWall result() const {
    SampledWall result = wall;
    const bool compact = std::isinf(least.mm) && at_an_end.room_mm > 0.0;
    result.least_mm = compact ? at_an_end.room_mm : least.mm;
    result.place = compact ? at_an_end.place : least.place;
    result.triangle = compact ? at_an_end.triangle : least.triangle;
    return result;
  }
};

/// A ray that meets a face at less than 45 degrees grazes it: the sine of the angle.
constexpr double kGrazing = std::numbers::sqrt2 / 2.0;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// The cosine between faces that do not noticeably approach each other.
constexpr double kParallel = 0.985;

/// As for `min_wall`, a wall has three thicknesses of boundary, either way round; 2 % more, because
/// the plane of a ray does not quite pass through the axis. Closer to the end than `kLeastEnd`, in
/// thicknesses, it has less; farther than `kMostEnd`, even in a wedge it has more: 1.5, seen
/// at 22.5 degrees.
constexpr double kSpan = 3.06, kLeastEnd = 0.6, kMostEnd = 1.63;

/// A line across the ray ends on one side only if its other side is at least this many times as
/// long. In the middle third of the width of a bar it ends on both sides.
constexpr double kOneSided = 2.0;
constexpr double kLeansMore = 0.1;  ///< of the sines of two faces

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
      const Middle middle{begin + 0.5 * ray.mm * inward, inward, ray.mm, hit->facing,
                          glm::normalize(doubled_area(mesh_, hit->triangle))};
      // The sides are examined only where the wall would be the thinnest.
      const bool thinnest = ray.mm < found.least.mm;
      const Beside beside = thinnest ? look_beside(middle, steps) : Beside{};
      if (thinnest && is_end(middle, beside, steps)) {
        one.wall.oblique = 1;
        one.at_an_end = {std::min(ray.mm, 2.0 * beside.nearest_mm), begin, triangle, sample};
      } else {
        one.least = ray;
      }
    }
    found.add(one);
  }

 private:
  /// The middle of a ray through a wall.
  struct Middle {
    glm::dvec3 place, inward;
    double thickness_mm = 0.0, facing = 0.0;
    glm::dvec3 normal;  ///< of the face that it hits
  };

  /// The sides of a wall.
  struct Beside {
    double end = kFar;         ///< distance of the nearest end [thicknesses]
    glm::dvec3 towards{0.0};   ///< the way to it, a unit vector
    double nearest_mm = kFar;  ///< of any face
  };

  [[nodiscard]] std::optional<WallRay::Hit> hit_from(const glm::dvec3& from, const glm::dvec3& way,
                                                     std::size_t& steps) const {
    const auto hit = WallRay(mesh_, from, way).first_hit(tree_, steps);
    return hit && hit->mm ? hit : std::nullopt;
  }
  [[nodiscard]] double mm_from(const glm::dvec3& from, const glm::dvec3& way,
                               std::size_t& steps) const {
    const auto hit = hit_from(from, way, steps);
    return hit ? *hit->mm : kFar;
  }

  /// Looks for an end of the clay along some lines across the ray: the clay ends on one side of a
  /// line only, as at the end of a lip or of a flange. A rod ends on both sides.
  [[nodiscard]] Beside look_beside(const Middle& middle, std::size_t& steps) const {
    const glm::dvec3& inward = middle.inward;
    const glm::dvec3 aside = std::abs(inward.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(inward, aside)), v = glm::cross(inward, u);
    struct Way {
      glm::dvec3 direction;
      double mm = kFar;
      double facing = 1.0;  // as of a Middle
    };
    const auto way = [&](const glm::dvec3& direction) {
      const auto hit = hit_from(middle.place, direction, steps);
      return hit ? Way{direction, *hit->mm, hit->facing} : Way{direction};
    };
    constexpr int kLines = 4;
    Beside beside;
    for (int k = 0; k < kLines; ++k) {
      const double angle = std::numbers::pi * k / kLines;
      const glm::dvec3 direction = std::cos(angle) * u + std::sin(angle) * v;
      Way nearer = way(direction), farther = way(-direction);
      if (nearer.mm > farther.mm) std::swap(nearer, farther);
      beside.nearest_mm = std::min(beside.nearest_mm, nearer.mm);
      const bool longer = farther.mm >= middle.thickness_mm && farther.mm > kOneSided * nearer.mm;
      // Beside a leaning face the clay continues; the sides of a bar lean alike.
      const bool leans = farther.facing < kGrazing && farther.facing < nearer.facing - kLeansMore;
      const double end = nearer.mm / middle.thickness_mm;
      if (end < beside.end && (longer || leans))
        beside.end = end, beside.towards = nearer.direction;
    }
    return beside;
  }

  [[nodiscard]] bool is_end(const Middle& middle, const Beside& beside, std::size_t& steps) const {
    if (beside.end < kLeastEnd) return true;
    if (beside.end < kMostEnd &&
        ends_towards(nearest_way(middle, beside.towards, steps), middle, steps))
      return true;
    // The lines may miss the edge of a wedge. It lies where the faces approach each other.
    if (middle.facing > kParallel) return false;
    const glm::dvec3 closing = middle.normal - middle.facing * middle.inward;
    return ends_towards(glm::normalize(closing), middle, steps);
  }

  /// The shortest way to the end, near one of the lines.
  [[nodiscard]] glm::dvec3 nearest_way(const Middle& middle, glm::dvec3 way,
                                       std::size_t& steps) const {
    double least = mm_from(middle.place, way, steps);
    for (double turn = std::numbers::pi / 16.0; turn > 0.02; turn *= 0.5) {
      const glm::dvec3 across = glm::cross(middle.inward, way);
      for (const double side : {-turn, turn}) {
        const glm::dvec3 turned = std::cos(side) * way + std::sin(side) * across;
        const double mm = mm_from(middle.place, turned, steps);
        if (mm < least) least = mm, way = turned;
      }
    }
    return way;
  }

  /// A point of the boundary as seen from the middle; the angle is 0 towards the end.
  struct Seen {
    double angle = 0.0;
    glm::dvec3 at{0.0};
  };

  /// Whether the boundary around the end is too short for a wall, in the plane of the ray and the
  /// way to the end. Its length is that of a line through points of it, as seen from the middle,
  /// and so a lower bound. The search stops once that is enough.
  [[nodiscard]] bool ends_towards(const glm::dvec3& towards, const Middle& middle,
                                  std::size_t& steps) const {
    constexpr int kParts = 8;
    const auto seen = [&](double angle) {
      const glm::dvec3 way = std::cos(angle) * towards + std::sin(angle) * middle.inward;
      return Seen{angle, mm_from(middle.place, way, steps) * way};
    };
    const glm::dvec3 half = 0.5 * middle.thickness_mm * middle.inward;
    Seen last{-0.5 * std::numbers::pi, -half};
    double missing_mm = kSpan * middle.thickness_mm;
    for (int k = 1; k <= kParts && missing_mm > 0.0; ++k) {
      Seen next{0.5 * std::numbers::pi, half};
      if (k < kParts) next = seen(std::numbers::pi * (static_cast<double>(k) / kParts - 0.5));
      if (!std::isfinite(next.at.x)) continue;  // along a triangle
      missing_mm -= length_between(last, next, seen, {middle.thickness_mm / 24.0, missing_mm});
      last = next;
    }
    return missing_mm > 0.0;
  }

  struct Lengths {
    double fine_mm = 0.0, enough_mm = 0.0;
  };

  /// Through more points where two are farther apart than `fine_mm`, and no more than `enough_mm`.
  template <class See>
  [[nodiscard]] static double length_between(const Seen& a, const Seen& b, const See& seen,
                                             const Lengths& lengths, int halvings = 6) {
    const double straight = glm::length(b.at - a.at);
    if (straight <= lengths.fine_mm || straight >= lengths.enough_mm || halvings == 0)
      return straight;
    const Seen middle = seen(0.5 * (a.angle + b.angle));
    if (!std::isfinite(middle.at.x)) return straight;
    return length_between(a, middle, seen, lengths, halvings - 1) +
           length_between(middle, b, seen, lengths, halvings - 1);
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
  return failure(ErrorKind::io, std::string("wall not measured: ") + e.what());
}

}  // namespace clay::solid::inline check
