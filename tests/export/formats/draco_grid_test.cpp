#include "export/formats/draco_grid.hpp"

#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clay::solid {
namespace {

using Points = std::vector<glm::vec3>;

struct Case {
  Points points;
  DracoSettings settings;
};

/// A point cloud at any scale, near the origin or around it, and an error that float32 permits.
Case any_case() {
  const auto unit = [] { return static_cast<float>(*rc::gen::inRange(-1000, 1001)) / 1000.0F; };
  const float scale = std::exp2(static_cast<float>(*rc::gen::inRange(-8, 9)));
  const float away = *rc::gen::arbitrary<bool>() ? 0.0F : 20.0F;
  Case found;
  for (int i = *rc::gen::inRange(2, 20); i > 0; --i)
    found.points.push_back(scale * (glm::vec3(unit(), unit(), unit()) + away));
  found.points.push_back(scale * (glm::vec3(1.0F) + away));
  found.points.push_back(scale * (glm::vec3(-1.0F) + away));
  const double fraction = std::pow(10.0, -*rc::gen::inRange(0, 40) / 10.0);
  found.settings = {.max_error_mm = double{scale} * fraction, .min_bits = *rc::gen::inRange(1, 10)};
  return found;
}

double step_of(const DracoGrid& grid) {
  return double{grid.side_mm} / (std::exp2(grid.bits) - 1.0);
}

double extent_of(const Points& points) {
  glm::dvec3 low(points.front()), high(points.front());
  for (const glm::vec3& point : points) {
    low = glm::min(low, glm::dvec3(point));
    high = glm::max(high, glm::dvec3(point));
  }
  const glm::dvec3 size = high - low;
  return std::max({size.x, size.y, size.z});
}

RC_GTEST_PROP(DracoGrid, CoversEveryPoint, ()) {
  const Case given = any_case();
  const DracoGrid grid = choose_grid(given.points, given.settings).value();
  for (const glm::vec3& point : given.points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double from_corner = double{point[axis]} - double{grid.origin[axis]};
      RC_ASSERT(from_corner >= 0.0);
      RC_ASSERT(from_corner <= double{grid.side_mm});
    }
  }
}

/// The largest distance of a point from the grid is half the diagonal of a cell.
RC_GTEST_PROP(DracoGrid, IsAsCoarseAsTheErrorAllows, ()) {
  const Case given = any_case();
  const DracoGrid grid = choose_grid(given.points, given.settings).value();
  const double half_diagonal = 0.5 * std::numbers::sqrt3 * step_of(grid);
  const double error = given.settings.max_error_mm;
  RC_ASSERT(half_diagonal < error);
  RC_ASSERT(grid.bits >= given.settings.min_bits);
  if (grid.bits > given.settings.min_bits) {
    // float32 rounding: about 20 roundings of numbers up to 21 times the extent.
    const double rounding = 20.0 * 21.0 * 0x1p-24 * extent_of(given.points);
    RC_ASSERT(half_diagonal > error - rounding);
    const double steps_of_a_bit_less = std::exp2(grid.bits - 1) - 1.0;
    const double widest = (error - rounding) * 2.0 / std::numbers::sqrt3 * steps_of_a_bit_less;
    RC_ASSERT(widest < extent_of(given.points));
  }
}

/// Requested bits mean a fine grid: enlarging the cube would undo them.
RC_GTEST_PROP(DracoGrid, RequestedBitsDivideTheExtent, ()) {
  const Case given = any_case();
  const DracoGrid grid = choose_grid(given.points, given.settings).value();
  const double coarsest = extent_of(given.points) / (std::exp2(given.settings.min_bits) - 1.0);
  RC_ASSERT(step_of(grid) <= coarsest * (1.0 + 0x1p-20));
}

TEST(DracoGrid, HasAPointOnTheAxis) {
  Points points;
  for (const glm::dvec3& point : samples::torus(40, 20).points) points.emplace_back(point);
  for (const double error_mm : {0.3, 0.1, 0.0123}) {
    const DracoGrid grid = choose_grid(points, {.max_error_mm = error_mm}).value();
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(std::remainder(double{grid.origin[axis]}, step_of(grid)), 0.0, 1e-5) << error_mm;
  }
}

}  // namespace
}  // namespace clay::solid
