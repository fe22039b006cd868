#include "export/section/line_tree.hpp"

#include "tests/export/smoothing/smoothing_oracles.hpp"
#include "tests/export/smoothing/smoothing_stacks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace clay::solid {
namespace {

constexpr double kFar = 1e6;

Polygon any_line(std::mt19937_64& random, std::size_t points, double from, double to) {
  Polygon line;
  for (std::size_t i = 0; i < points; ++i)
    line.push_back({from + (to - from) * samples::uniform(random),
                    50.0 * static_cast<double>(i) / static_cast<double>(points)});
  return line;
}

oracles::Edge real(const ProfilePoint& a, const ProfilePoint& b) {
  return {{a.rho, a.y}, {b.rho, b.y}};
}

RC_GTEST_PROP(LineTree, FindsTheNearestEdges, ()) {
  auto random = *samples::random_engine();
  const Polygon line = any_line(random, *rc::gen::inRange<std::size_t>(2, 60), 10.0, 20.0);
  const double nearest_radius = *rc::gen::element(5.0, 19.0, 25.0);
  const Polygon other =
      any_line(random, *rc::gen::inRange<std::size_t>(2, 60), nearest_radius, 30.0);
  oracles::Real least = std::numeric_limits<oracles::Real>::max();
  const LineTree tree(line);
  for (std::size_t k = 0; k + 1 < other.size(); ++k) {
    oracles::Real nearest = std::numeric_limits<oracles::Real>::max();
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      nearest = std::min(
          nearest, oracles::distance(real(line[i], line[i + 1]), real(other[k], other[k + 1])));
    const double found = std::sqrt(tree.nearest2({other[k], other[k + 1]}, kFar));
    RC_ASSERT(std::abs(found - nearest) < 1e-9L);
    const auto near2 = static_cast<double>(nearest * nearest);
    RC_ASSERT(tree.any_nearer2({other[k], other[k + 1]}, near2 + 1e-6));
    RC_ASSERT(!tree.any_nearer2({other[k], other[k + 1]}, near2 - 1e-6));
    least = std::min(least, nearest);
  }
  RC_ASSERT(std::abs(std::sqrt(tree.nearest2(LineTree(other), kFar)) - least) < 1e-9L);
  RC_ASSERT(std::abs(std::sqrt(LineTree(other).nearest2(tree, kFar)) - least) < 1e-9L);
  const auto least2 = static_cast<double>(least * least);
  RC_ASSERT(tree.any_nearer2(LineTree(other), least2 + 1e-6));
  RC_ASSERT(!tree.any_nearer2(LineTree(other), least2 - 1e-6));
}

TEST(LineTree, IgnoresTheAxisAndRespectsItsBound) {
  const LineTree axis({{0, 0}, {0, 10}});
  EXPECT_EQ(axis.nearest2({{1, 0}, {1, 10}}, 7.0), 7.0);
  const LineTree wall({{3, 0}, {3, 10}});
  EXPECT_EQ(wall.nearest2(axis, 7.0), 7.0);
  EXPECT_EQ(wall.nearest2({{1, 2}, {1, 3}}, 3.0), 3.0);
  EXPECT_EQ(wall.nearest2({{1, 2}, {1, 3}}, 5.0), 4.0);
}

}  // namespace
}  // namespace clay::solid
