#include "export/formats/draco_grid.hpp"

#include "core/text.hpp"
#include "export/formats/draco_bits.hpp"
#include "export/formats/mesh_limits.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <string>

namespace clay::solid::inline formats {
namespace {

constexpr float kLeastSideMm = 1e-6F;  // inverses of smaller ones overflow in Draco
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kUnitRoundoff = 0x1p-24;
constexpr double kSideRoundings = 10.0;
constexpr double kReachRoundings = 2.0;

/// The volume that the grid must cover.
struct Extent {
  glm::vec3 low{0.0F};
  float side = 1.0F;      ///< of the smallest cube, rounded up so that it contains every point
  float farthest = 0.0F;  ///< largest |coordinate|
};

Extent extent_of(const std::vector<glm::vec3>& points) noexcept {
  glm::vec3 low = points.front();
  glm::vec3 high = points.front();
  for (const glm::vec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const glm::vec3 size = high - low;
  const glm::vec3 reach = glm::max(glm::abs(low), glm::abs(high));
  const float longest = std::nextafter(std::max({size.x, size.y, size.z}), kInfinity);
  return {low, std::max(kLeastSideMm, longest), std::max({reach.x, reach.y, reach.z})};
}

double steps_of(int bits) noexcept { return std::exp2(bits) - 1.0; }

/// Upper bound of a vertex displacement [mm]: half a step along each axis, and the rounding errors
/// of float32. Draco computes in float32: the difference to the origin, the scale and its product,
/// the added half, then step, product and sum of the decoding are at most 9 roundings relative to
/// the side (10 covers the products of roundings), and the sum one relative to the coordinate
/// itself, which was rounded once before.
double error_bound_mm(double side, double farthest, int bits) noexcept {
  return std::numbers::sqrt3 *
         (0.5 * side / steps_of(bits) +
          kUnitRoundoff * (kSideRoundings * side + kReachRoundings * farthest));
}

/// The largest side for that error: the bound above solved for it, rounded down; negative if the
/// roundings alone exceed it.
float widest_side_mm(double error_mm, double farthest, int bits) noexcept {
  const double left = error_mm / std::numbers::sqrt3 - kUnitRoundoff * kReachRoundings * farthest;
  const double side = left / (0.5 / steps_of(bits) + kUnitRoundoff * kSideRoundings);
  // Beyond the needs of any mesh, and within the range of float32.
  return std::nextafter(static_cast<float>(std::min(side, 8.0 * double{kMaxCoordinateMm})),
                        -kInfinity);
}

/// Puts a grid point on the origin of coordinates if the cube has room for it: then the cells on
/// both sides of a pot's axis are symmetric.
glm::vec3 origin_for(const Extent& extent, float side, int bits) noexcept {
  const double step = double{side} / steps_of(bits);
  const double room = double{side} - double{extent.side};
  glm::vec3 origin = extent.low;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = double{extent.low[axis]};
    const auto whole = static_cast<float>(step * std::floor(low / step));
    if (double{whole} <= low && low - double{whole} <= room) origin[axis] = whole;
  }
  return origin;
}

}  // namespace

Result<DracoGrid> choose_grid(const std::vector<glm::vec3>& points, const DracoSettings& settings,
                              const GridFile& file) {
  const Extent extent = extent_of(points);
  for (int bits = settings.min_bits; bits <= kMaxDracoBits; ++bits) {
    const float widest = widest_side_mm(settings.max_error_mm, double{extent.farthest}, bits);
    if (widest < extent.side) continue;
    const float side = bits == settings.min_bits ? extent.side : widest;
    return DracoGrid{origin_for(extent, side, bits), side, bits};
  }
  const double smallest =
      error_bound_mm(double{extent.side}, double{extent.farthest}, kMaxDracoBits);
  return failure(ErrorKind::bad_input,
                 "cannot write " + std::string(file.ending) + ": a vertex error of " +
                     nine_digit_text(settings.max_error_mm * file.unit_mm + file.other_mm) +
                     " mm needs more than 30 bits; the smallest possible is " +
                     sufficient_text(smallest * file.unit_mm + file.other_mm) + " mm");
}

}  // namespace clay::solid::inline formats
