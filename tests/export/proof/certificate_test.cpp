#include "claystack/export/proof.hpp"

#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <array>
#include <cstdint>
#include <limits>

namespace clay::solid {
namespace {

const Polygon kSquare{{1, 0}, {2, 0}, {2, 1}, {1, 1}};

::testing::AssertionResult refused(const Profile& profile, const std::string& because) {
  return samples::refused(certify(profile), ErrorKind::unsound, because);
}

TEST(Certify, CountsProvedEdges) {
  const Polygon two_cavities{{9, 0}, {9, 9}, {0, 9}, {0, 8}, {3, 8}, {3, 6}, {0, 6},
                             {0, 5}, {0, 4}, {3, 4}, {3, 2}, {0, 2}, {0, 0}};
  const auto certificate = certify({{two_cavities, {{9, 10}, {9, 11}, {8, 11}, {8, 10}}}});
  ASSERT_TRUE(certificate) << certificate.error().message;
  EXPECT_EQ(certificate->polygons, 2u);
  EXPECT_EQ(certificate->vertices, 17u);
  EXPECT_EQ(certificate->axis_segments, 3u);
}

TEST(Certify, AcceptsTrianglesCollinearPointsAndMinusZero) {
  EXPECT_TRUE(certify({{{{1, 0}, {2, 0}, {1, 1}}}}));
  EXPECT_TRUE(certify({{{{1, 0}, {1.5, 0}, {2, 0}, {2, 1}, {1, 1}}}}));
  EXPECT_TRUE(certify({{{{-0.0, 0}, {2, 0}, {2, 1}, {0, 1}}}}));
}

TEST(Certify, RefusesNoClay) {
  EXPECT_TRUE(refused({}, "found none"));
  EXPECT_TRUE(refused({{{{1, 0}, {2, 0}}}}, "at least 3 vertices"));
}

TEST(Certify, RefusesPointsOffTheHalfPlane) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refused({{{{-1e-300, 0}, {2, 0}, {2, 1}}}}, "vertex 0"));
  EXPECT_TRUE(refused({{{{1, 0}, {nan, 0}, {2, 1}}}}, "vertex 1"));
  EXPECT_TRUE(refused({{{{1, 0}, {2, 0}, {2, infinity}}}}, "vertex 2"));
}

TEST(Certify, RefusesBowTie) {
  EXPECT_TRUE(refused({{{{1, 0}, {2, 1}, {2, 0}, {1, 1}}}}, "meets"));
}

TEST(Certify, RefusesVertexThatTouchesAnEdge) {
  EXPECT_TRUE(refused({{{{1, 0}, {4, 0}, {4, 2}, {3, 2}, {2.5, 0}, {2, 2}, {1, 2}}}}, "meets"));
}

TEST(Certify, RefusesVertexThatTouchesAVertex) {
  EXPECT_TRUE(refused({{{{1, 0}, {3, 0}, {2, 1}, {3, 2}, {1, 2}, {2, 1}}}}, "meets"));
}

TEST(Certify, RefusesRepeatedPointsAndSpikes) {
  EXPECT_TRUE(refused({{{{1, 0}, {2, 0}, {2, 0}, {2, 1}, {1, 1}}}}, "with a length"));
  EXPECT_TRUE(refused({{{{1, 0}, {2, 0}, {2, 1}, {2, 3}, {2, 1}, {1, 1}}}}, "meets"));
  EXPECT_TRUE(refused({{{{1, 0}, {2, 0}, {2, 3}, {2, 1}, {1, 1}}}}, "meets"));
}

TEST(Certify, RefusesTriangleWithoutArea) {
  EXPECT_TRUE(refused({{{{1, 0}, {3, 0}, {2, 0}}}}, "counterclockwise"));
}

TEST(Certify, RefusesPinchAtTheAxis) {
  // For any first vertex of the polygon.
  EXPECT_TRUE(refused({{{{2, 0}, {2, 2}, {0, 1}}}}, "single point"));
  EXPECT_TRUE(refused({{{{0, 1}, {2, 0}, {2, 2}}}}, "single point"));
  EXPECT_TRUE(refused({{{{2, 2}, {0, 1}, {2, 0}}}}, "single point"));
  // An hourglass on the axis: both halves have an axis segment, the waist has none.
  EXPECT_TRUE(refused({{{{2, 0}, {1, 2}, {2, 4}, {1, 4}, {0, 2}, {1, 0}}}}, "single point"));
}

TEST(Certify, RefusesClockwise) {
  EXPECT_TRUE(refused({{{kSquare.rbegin(), kSquare.rend()}}}, "counterclockwise"));
}

TEST(Certify, RefusesPiecesThatTouchCrossOrNest) {
  EXPECT_TRUE(refused({{kSquare, {{2, 1}, {3, 1}, {3, 2}, {2, 2}}}}, "meets"));
  EXPECT_TRUE(refused({{kSquare, {{1.5, 0.5}, {3, 0.5}, {3, 2}, {1.5, 2}}}}, "meets"));
  const Polygon around{{0.5, -1}, {3, -1}, {3, 3}, {0.5, 3}};
  EXPECT_TRUE(refused({{kSquare, around}}, "piece 0: expected pieces beside each other"));
  EXPECT_TRUE(refused({{around, kSquare}}, "piece 1: expected pieces beside each other"));
  // Nested twice: the parity of the innermost polygon is even again.
  const Polygon inmost{{1.4, 0.4}, {1.6, 0.4}, {1.6, 0.6}, {1.4, 0.6}};
  EXPECT_TRUE(refused({{inmost, kSquare, around}}, "expected pieces beside each other"));
}

TEST(Certify, AcceptsPiecesSideBySideOnOneLevel) {
  EXPECT_TRUE(certify({{kSquare, {{3, 1}, {4, 1}, {4, 2}, {3, 2}}}}));
  // The ray from the second to the axis passes through vertices of the first.
  EXPECT_TRUE(certify({{{{1, 0}, {3, 1}, {1, 2}}, {{4, 1}, {5, 1}, {5, 2}}}}));
}

TEST(Certify, DistinguishesOneUlpFromATouch) {
  const double just_above = std::nextafter(1.0, 2.0);
  const auto notched = [](double tip) {
    return Profile{
        {{{1, 0}, {4, 0}, {4, 3}, {3, 3}, {2, tip}, {1.5, 3}, {1, 3}, {1, 2}, {2, 1}, {1, 0.5}}}};
  };
  EXPECT_TRUE(certify(notched(just_above)));
  EXPECT_TRUE(refused(notched(1.0), "meets"));
}

TEST(Certify, RefusesAWallLostInRounding) {
  const Quanta r2 = quanta_from_radius(5000.0);
  const auto stack = ClayStack::from_rings(1.0, {{r2, r2 - 1}}, 0).value();
  const auto found = profile_of(stack);
  ASSERT_TRUE(found);
  EXPECT_TRUE(refused(found->profile, "found none at (rho, y) = (5000, 1) mm"));
}

/// On a small integer grid, every predicate can be decided by integer arithmetic.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPoint&, const GridPoint&) = default;
};
using GridPolygon = std::vector<GridPoint>;

int turn(GridPoint a, GridPoint b, GridPoint c) {
  const std::int64_t area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}
bool on_segment(GridPoint a, GridPoint b, GridPoint p) {
  return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}
bool segments_meet(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  return (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) ||
         on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}
bool strictly_simple(const GridPolygon& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const GridPoint a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
    if (a == b || on_segment(a, b, c) || on_segment(b, c, a)) return false;
    for (std::size_t j = i + 2; j < n; ++j)
      if (j + 1 < n + i && segments_meet(a, b, p[j], p[(j + 1) % n])) return false;
  }
  return true;
}
std::int64_t doubled_area(const GridPolygon& p) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const GridPoint a = p[i], b = p[(i + 1) % p.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

RC_GTEST_PROP(Certify, AgreesWithIntegersOnRandomPolygons, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(3, 8);
  GridPolygon grid;
  Polygon polygon;
  for (std::size_t i = 0; i < count; ++i) {
    grid.push_back({*rc::gen::inRange(1, 7), *rc::gen::inRange(0, 6)});
    polygon.push_back({static_cast<double>(grid.back().x), static_cast<double>(grid.back().y)});
  }
  const bool sound = strictly_simple(grid) && doubled_area(grid) > 0;
  RC_CLASSIFY(sound);
  RC_ASSERT(certify({{polygon}}).has_value() == sound);
}

RC_GTEST_PROP(Certify, ProvesEveryStackWithDistinctDoubles, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found) RC_DISCARD("touching rings");
  RC_ASSERT(certify(found->profile).has_value());
}

}  // namespace
}  // namespace clay::solid
