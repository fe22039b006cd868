// Weight, capacity and balance against closed forms of cylinder, cone and sphere.

#include "claystack/export/maker.hpp"
#include "tests/export/section/cup_section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace clay::solid {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kPerRadian = 180.0 / kHalfTurn;

/// A cone or cylinder part with its closed forms, between the heights `from` and `to`.
struct Frustum {
  double low = 0.0, high = 0.0;  ///< radii
  double from = 0.0, to = 0.0;
  [[nodiscard]] double volume() const {
    return kHalfTurn / 3.0 * (to - from) * (low * low + low * high + high * high);
  }
  [[nodiscard]] double centre() const {
    const double sum = low * low + low * high + high * high;
    return from + 0.25 * (to - from) * (low * low + 2.0 * low * high + 3.0 * high * high) / sum;
  }
};

/// A part of a ball about the origin between two heights.
struct BallZone {
  double radius = 0.0, from = 0.0, to = 0.0;
  [[nodiscard]] double volume() const { return at(to) - at(from); }
  [[nodiscard]] double moment() const { return moment_at(to) - moment_at(from); }

 private:
  [[nodiscard]] double at(double z) const {
    return kHalfTurn * (radius * radius * z - z * z * z / 3.0);
  }
  [[nodiscard]] double moment_at(double z) const {
    return kHalfTurn * (radius * radius * z * z / 2.0 - z * z * z * z / 4.0);
  }
};

void add_arc(Polygon& line, double radius, double from, double to) {
  constexpr int kParts = 4000;
  const double begin = std::asin(from / radius), end = std::asin(to / radius);
  for (int i = 0; i <= kParts; ++i) {
    const double angle = begin + (end - begin) * i / kParts;
    line.push_back({std::abs(radius * std::cos(angle)), radius * std::sin(angle)});
  }
}

TEST(MakerNumbers, OfACylinder) {
  const Profile cup{{shapes::cup(4.0, 6.0)}};
  ClayFigures clay;
  clay.density_g_cm3 = 2.0;
  const MakerNumbers numbers = maker_numbers(cup, clay, 10.0);
  const double whole = kHalfTurn * 40.0 * 40.0 * 60.0, room = kHalfTurn * 36.0 * 36.0 * 54.0;
  EXPECT_NEAR(numbers.thrown.weight_g, 2e-3 * (whole - room), 1e-9);
  EXPECT_NEAR(numbers.thrown.capacity_ml, 1e-3 * room, 1e-9);
  EXPECT_NEAR(numbers.thrown.to_line_ml, 1e-3 * kHalfTurn * 36.0 * 36.0 * 44.0, 1e-9);
  const double bore = 2.0 * kHalfTurn * 36.0 * 54.0, floor = kHalfTurn * 36.0 * 36.0;
  const double wall = 2.0 * kHalfTurn * 40.0 * 60.0;
  const double rim = kHalfTurn * (40.0 * 40.0 - 36.0 * 36.0);
  EXPECT_NEAR(numbers.thrown.inside_cm2, 1e-2 * (bore + floor), 1e-9);
  EXPECT_NEAR(numbers.thrown.outside_cm2, 1e-2 * (wall + rim), 1e-9);
  EXPECT_EQ(numbers.thrown.size.diameter_mm, 80.0);
  EXPECT_EQ(numbers.thrown.size.height_mm, 60.0);
  EXPECT_EQ(numbers.thrown.size.foot_diameter_mm, 80.0);
  const double centre = (whole * 30.0 - room * 33.0) / (whole - room);
  EXPECT_NEAR(numbers.empty.centre_mm, centre, 1e-9);
  EXPECT_NEAR(numbers.empty.tipping_deg, std::atan(40.0 / centre) * kPerRadian, 1e-9);
  ASSERT_TRUE(numbers.full);
  const double clay_g = 2.0 * (whole - room);
  const double full = (clay_g * centre + room * 33.0) / (clay_g + room);
  EXPECT_NEAR(numbers.full->centre_mm, full, 1e-9);
  EXPECT_NEAR(numbers.full->tipping_deg, std::atan(40.0 / full) * kPerRadian, 1e-9);
}

/// No glaze reaches a closed cavity: here one in a double floor.
TEST(MakerNumbers, LeaveOutTheSurfaceOfAClosedCavity) {
  const Polygon vessel{{0, 0},  {50, 0}, {50, 100}, {46, 100}, {46, 40},
                       {0, 40}, {0, 34}, {44, 34},  {44, 6},   {0, 6}};
  const double wall = 2.0 * kHalfTurn * 50.0 * 100.0;
  const double rim = kHalfTurn * (50.0 * 50.0 - 46.0 * 46.0);
  const double inside = 2.0 * kHalfTurn * 46.0 * 60.0 + kHalfTurn * 46.0 * 46.0;
  // A polygon may begin anywhere.
  for (std::size_t begin = 0; begin < vessel.size(); ++begin) {
    Polygon piece = vessel;
    std::rotate(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(begin), piece.end());
    const MakerNumbers numbers = maker_numbers({{piece}}, {});
    EXPECT_NEAR(numbers.thrown.inside_cm2, 1e-2 * inside, 1e-9) << begin;
    EXPECT_NEAR(numbers.thrown.outside_cm2, 1e-2 * (wall + rim), 1e-9) << begin;
  }
  // A hollow disc, closed on all sides.
  const Polygon disc{{0, 0}, {30, 0}, {30, 20}, {0, 20}, {0, 15}, {25, 15}, {25, 5}, {0, 5}};
  EXPECT_NEAR(maker_numbers({{disc}}, {}).thrown.outside_cm2,
              1e-2 * (2.0 * kHalfTurn * 30.0 * 20.0 + kHalfTurn * 30.0 * 30.0), 1e-9);
}

TEST(MakerNumbers, OfAConeBelowItsFillLine) {
  // A cone 50 mm deep in a frustum of 80 mm, standing 7 mm above the wheel head.
  const double up = 7.0;
  const Profile cone{{{{0, up}, {20, up}, {45, up + 80}, {40, up + 80}, {0, up + 30}}}};
  const MakerNumbers numbers = maker_numbers(cone, {}, 20.0);
  const Frustum outer{20, 45, 0, 80}, room{0, 40, 30, 80}, filled{0, 24, 30, 60};
  EXPECT_NEAR(numbers.thrown.capacity_ml, 1e-3 * room.volume(), 1e-9);
  EXPECT_NEAR(numbers.thrown.to_line_ml, 1e-3 * filled.volume(), 1e-9);
  EXPECT_NEAR(numbers.thrown.inside_cm2, 1e-2 * kHalfTurn * 40.0 * std::hypot(40.0, 50.0), 1e-9);
  EXPECT_NEAR(numbers.thrown.outside_cm2,
              1e-2 * kHalfTurn * (65.0 * std::hypot(25.0, 80.0) + 45.0 * 45.0 - 40.0 * 40.0), 1e-9);
  const double clay = outer.volume() - room.volume();
  const double centre = (outer.volume() * outer.centre() - room.volume() * room.centre()) / clay;
  EXPECT_NEAR(revolved_body(cone).centre_mm, centre + up, 1e-9);
  EXPECT_NEAR(numbers.empty.centre_mm, centre, 1e-9);
  EXPECT_NEAR(numbers.empty.tipping_deg, std::atan(20.0 / centre) * kPerRadian, 1e-9);
}

TEST(MakerNumbers, OfASphere) {
  // A bottle between two spheres, cut flat at the foot and open at the top.
  Polygon line{{0, -40}};
  add_arc(line, 50.0, -40.0, 30.0);  // foot radius 30
  Polygon bore;
  add_arc(bore, 45.0, -35.0, 30.0);
  line.insert(line.end(), bore.rbegin(), bore.rend());
  line.push_back({0, -35});
  const MakerNumbers numbers = maker_numbers({{line}}, {});
  const BallZone outer{50, -40, 30}, room{45, -35, 30}, filled{45, -35, 20};
  const double clay = outer.volume() - room.volume();
  const double tolerance = 1e-6 * outer.volume();
  EXPECT_NEAR(1e3 * numbers.thrown.capacity_ml, room.volume(), tolerance);
  EXPECT_NEAR(1e3 * numbers.thrown.to_line_ml, filled.volume(), tolerance);
  EXPECT_NEAR(numbers.thrown.weight_g, 1.9e-3 * clay, 1e-5 * clay);
  const double centre = 40.0 + (outer.moment() - room.moment()) / clay;
  EXPECT_NEAR(numbers.empty.centre_mm, centre, 1e-4);
  EXPECT_NEAR(numbers.empty.tipping_deg, std::atan(30.0 / centre) * kPerRadian, 1e-4);
}

TEST(MakerNumbers, ShrinkFromThrownToFired) {
  ClayFigures clay;
  clay.shrinkage = 0.12;
  clay.water = 0.25;
  clay.ignition_loss = 0.1;
  const MakerNumbers numbers = maker_numbers({{shapes::cup(4.0, 6.0)}}, clay, 8.8);
  ASSERT_TRUE(numbers.fired && numbers.dry);
  EXPECT_NEAR(numbers.fired->size.height_mm, 52.8, 1e-12);
  EXPECT_NEAR(numbers.dry->size.height_mm, 56.4, 1e-12);  // half of the shrinkage is in drying
  EXPECT_NEAR(numbers.dry->weight_g, 0.75 * numbers.thrown.weight_g, 1e-9);
  EXPECT_NEAR(numbers.fired->weight_g, 0.675 * numbers.thrown.weight_g, 1e-9);
  EXPECT_NEAR(numbers.fired->capacity_ml, 0.681472 * numbers.thrown.capacity_ml, 1e-9);
  EXPECT_NEAR(numbers.fired->inside_cm2, 0.7744 * numbers.thrown.inside_cm2, 1e-9);
  EXPECT_NEAR(numbers.fired->outside_cm2, 0.7744 * numbers.thrown.outside_cm2, 1e-9);
  // 8.8 mm of the fired pot are 10 mm wet.
  EXPECT_NEAR(numbers.thrown.to_line_ml, 1e-3 * kHalfTurn * 36.0 * 36.0 * 44.0, 1e-9);
  // The empty pot keeps its shape, so it tips at the same angle.
  const MakerNumbers thrown = maker_numbers({{shapes::cup(4.0, 6.0)}}, {});
  EXPECT_NEAR(numbers.empty.tipping_deg, thrown.empty.tipping_deg, 1e-9);
  EXPECT_EQ(&numbers.in_use(), &*numbers.fired);
}

TEST(MakerNumbers, NothingHoldsWaterWithoutAFloor) {
  const Profile tube{{{{30, 0}, {40, 0}, {40, 60}, {30, 60}}}};
  const MakerNumbers numbers = maker_numbers(tube, {});
  EXPECT_EQ(numbers.thrown.capacity_ml, 0.0);
  EXPECT_EQ(numbers.no_capacity, "no floor under an open bore");
  const Profile apart{{{{0, 0}, {40, 0}, {40, 6}, {0, 6}}, {{30, 7}, {40, 7}, {40, 60}, {30, 60}}}};
  EXPECT_EQ(maker_numbers(apart, {}).no_capacity, "the pot is in 2 pieces");
  EXPECT_FALSE(numbers.full);
  EXPECT_EQ(numbers.thrown.inside_cm2, 0.0);
  EXPECT_NEAR(numbers.thrown.outside_cm2, 1e-2 * kHalfTurn * (2.0 * 70.0 * 60.0 + 700.0), 1e-9);
  EXPECT_NEAR(revolved_body(tube).volume_mm3, kHalfTurn * 700.0 * 60.0, 1e-6);
  // A cup upside down, and a block.
  EXPECT_EQ(room_of({{{{30, 0}, {40, 0}, {40, 60}, {0, 60}, {0, 50}, {30, 50}}}}).volume_mm3, 0.0);
  EXPECT_EQ(room_of({{{{0, 0}, {40, 0}, {40, 60}, {0, 60}}}}).volume_mm3, 0.0);
}

TEST(MakerNumbers, TheRoomBeginsAtTheInnerEdgeOfTheRim) {
  // For any first vertex of the polygon.
  Polygon cup = shapes::cup(4.0, 6.0);
  for (std::size_t turn = 0; turn < cup.size(); ++turn) {
    EXPECT_NEAR(room_of({{cup}}).volume_mm3, kHalfTurn * 36.0 * 36.0 * 54.0, 1e-6) << turn;
    std::rotate(cup.begin(), cup.begin() + 1, cup.end());
  }
}

TEST(MakerNumbers, RefuseFiguresOutOfRange) {
  ClayFigures clay;
  clay.shrinkage = 0.1;
  EXPECT_TRUE(clay.check());
  clay.drying_shrinkage = 0.2;
  ASSERT_FALSE(clay.check());
  EXPECT_NE(
      clay.check().error().message.find("expected 0 % to the shrinkage in total, 10 %, found 20 %"),
      std::string::npos);
  clay = {};
  clay.water = 1.0;
  EXPECT_FALSE(clay.check());
  clay = {};
  clay.density_g_cm3 = 0.0;
  EXPECT_FALSE(clay.check());
}

}  // namespace
}  // namespace clay::solid
