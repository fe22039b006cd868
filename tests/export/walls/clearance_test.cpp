#include "export/walls/clearance.hpp"

#include "claystack/export/smoothing.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::solid {
namespace {

constexpr double kRounding = 1e-11;  // far above ulps of a pot, far below any print resolution

TEST(Clearance, EqualsTheSideOfASquare) {
  const Clearance found = clearance({{{{10, 0}, {14, 0}, {14, 4}, {10, 4}}}});
  EXPECT_LE(found.distance_mm, 4.0);
  EXPECT_NEAR(found.distance_mm, 4.0, kRounding);
  EXPECT_EQ(found.least_radius_mm, 10.0);
}

TEST(Clearance, EqualsTheAltitudeOfATriangle) {
  EXPECT_NEAR(clearance_mm({{{{10, 0}, {20, 0}, {15, 1}}}}), 1.0, kRounding);
}

TEST(Clearance, FindsAVertexCloseToAnEdge) {
  // A notch whose tip ends 0.01 mm above the foot.
  const Clearance found =
      clearance({{{{10, 0}, {40, 0}, {40, 20}, {26, 20}, {25, 0.01}, {24, 20}, {10, 20}}}});
  EXPECT_NEAR(found.distance_mm, 0.01, kRounding);
  EXPECT_EQ(found.at, (ProfilePoint{25, 0.01}));
}

TEST(Clearance, IncludesDistancesBetweenPieces) {
  EXPECT_NEAR(clearance_mm({{{{10, 0}, {20, 0}, {20, 10}, {10, 10}},
                             {{12, 10.5}, {18, 10.5}, {18, 20}, {12, 20}}}}),
              0.5, kRounding);
}

TEST(Clearance, ShrinksWithTheFacets) {
  const Profile tube{{{{10, 0}, {12, 0}, {12, 40}, {10, 40}}}};
  const double scale = std::cos(M_PI / 8);
  const Clearance found = clearance(tube, scale);
  EXPECT_NEAR(found.distance_mm, 2.0 * scale, kRounding);
  EXPECT_NEAR(found.least_radius_mm, 10.0 * scale, kRounding);
}

TEST(Clearance, CountsEdgesOnTheAxis) {
  const Clearance found =
      clearance({{{{0, 0}, {30, 0}, {30, 20}, {0.25, 10}, {0.5, 20}, {0, 20}}}});
  EXPECT_LE(found.distance_mm, 0.25);
  EXPECT_NEAR(found.distance_mm, 0.25, 1e-2);
  EXPECT_EQ(found.least_radius_mm, 0.25);
}

/// Every vertex against every edge, in long double.
long double least_distance(const Profile& profile, long double scale) {
  using Exact = long double;
  Exact least = std::numeric_limits<Exact>::infinity();
  for (const Polygon& of_vertex : profile.pieces)
    for (std::size_t v = 0; v < of_vertex.size(); ++v)
      for (const Polygon& polygon : profile.pieces)
        for (std::size_t e = 0; e < polygon.size(); ++e) {
          const std::size_t next = (e + 1) % polygon.size();
          if (&polygon == &of_vertex && (v == e || v == next)) continue;
          const ProfilePoint &p = of_vertex[v], &a = polygon[e], &b = polygon[next];
          const Exact x = scale * (Exact(b.rho) - a.rho), y = Exact(b.y) - a.y;
          const Exact px = scale * (Exact(p.rho) - a.rho), py = Exact(p.y) - a.y;
          const Exact t = std::clamp((px * x + py * y) / (x * x + y * y), Exact(0), Exact(1));
          least = std::min(least, std::hypot(px - t * x, py - t * y));
        }
  return least;
}

void is_a_close_lower_bound(const Profile& profile) {
  for (const double scale : {1.0, std::cos(M_PI / 7)}) {
    const double found = clearance_mm(profile, scale);
    const long double expected = least_distance(profile, scale);
    RC_ASSERT(static_cast<long double>(found) <= expected);
    RC_ASSERT(found > static_cast<double>(expected) - kRounding);
  }
}

RC_GTEST_PROP(Clearance, IsALowerBoundForSteps, (const ClayStack& stack)) {
  const auto section = profile_of(stack);
  RC_PRE(section.has_value());
  is_a_close_lower_bound(section->profile);
}

RC_GTEST_PROP(Clearance, IsALowerBoundForFairWalls, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, 60);
  const auto section = shapes::fair_section(samples::stack(random, count, 0.7), 0.02);
  RC_PRE(section.has_value() && certify(section->profile).has_value());
  is_a_close_lower_bound(section->profile);
}

}  // namespace
}  // namespace clay::solid
