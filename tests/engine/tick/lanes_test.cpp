// Processing rings four at a time, if the machine can, or two at a time gives the same bits.

#include "engine/clay/packs.hpp"

#include "app/bench/hands/dice.hpp"
#include "claystack/engine/wheel.hpp"
#include "core/fnv1a.hpp"
#include "tests/engine/wheel/rule_samples.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace clay {
namespace {

struct Thrown {
  std::vector<Ring> rings;
  std::vector<glm::dvec3> forces_n;
  friend bool operator==(const Thrown&, const Thrown&) = default;
};

/// A tool that moves up and down along a wall, into it, and back to the start. `four`: with four
/// lanes, if the machine has them.
Thrown throw_with(const ToolShapeSpec& shape, bool four, std::optional<ClaySpec> clay = {}) {
  const TwoLanesScope lanes(!four);
  SceneSpec scene;
  scene.lump.ring_height_mm = 0.3;
  scene.lump.inner_radius_mm = 15.0;
  scene.tool.shape = shape;
  scene.force->friction = 0.2;
  scene.clay = clay;
  Wheel wheel = Wheel::build(scene).value();
  Thrown thrown;
  const double reach = Tool::build(shape).value().radius(0.0) + scene.lump.outer_radius_mm;
  for (int k = 0; k < 2000; ++k) {
    const double part = k / 2000.0;
    const glm::dvec3 hip(reach - 6.0 * std::sin(3.0 * part), 30.0 + 15.0 * std::sin(9.0 * part),
                         2.0 * part);
    thrown.forces_n.push_back(wheel.step({1000 * (k + 1), hip, false}).force_n());
  }
  thrown.rings.assign(wheel.stack().rings().begin(), wheel.stack().rings().end());
  return thrown;
}

constexpr std::size_t kRows = kWidestPack;

struct Rows {
  Quanta quanta[kRows];
  double numbers[kRows], doubles[kRows], roots[kRows];
  Quanta whole[kRows];
};

/// With packs of four, if the machine has them, or of two.
void convert(Rows& rows, bool four) noexcept {
  const TwoLanesScope lanes(!four);
  in_packs([to = &rows](auto n) CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < kRows; k += n) {
      store(to->doubles + k, doubles_of(load<Quantas<n>>(to->quanta + k)));
      store(to->whole + k, quanta_below(load_doubles<n>(to->numbers + k)));
      store(to->roots + k, rough_roots<n>(load_doubles<n>(to->doubles + k)));
    }
  });
}

TEST(Packs, ConvertLikeSingleNumbers) {
  bench::Dice dice(7);
  for (int round = 0; round < 20'000; ++round) {
    Rows rows{};
    for (std::size_t k = 0; k < kRows; ++k) {
      const double size = std::ldexp(dice.between(1.0, 2.0), static_cast<int>(dice.unit() * 60.0));
      rows.quanta[k] = static_cast<Quanta>(size);
      const double number = std::ldexp(dice.between(-1.0, 1.0), static_cast<int>(50 * dice.unit()));
      rows.numbers[k] = dice.unit() < 0.2 ? std::round(number) : number;
    }
    convert(rows, round % 2 == 0);
    for (std::size_t k = 0; k < kRows; ++k) {
      EXPECT_EQ(rows.doubles[k], static_cast<double>(rows.quanta[k]));
      EXPECT_EQ(rows.whole[k], static_cast<Quanta>(rows.numbers[k])) << rows.numbers[k];
      EXPECT_EQ(rows.roots[k], static_cast<double>(std::sqrt(static_cast<float>(rows.doubles[k]))));
    }
  }
}

class Lanes : public testing::TestWithParam<ToolShapeSpec> {};

/// Of every ring and every force.
std::uint64_t hash_of(const Thrown& thrown) {
  Fnv1a hash;
  for (const Ring& ring : thrown.rings) hash.add(ring.outer2), hash.add(ring.inner2);
  for (const glm::dvec3& force : thrown.forces_n)
    for (int axis = 0; axis < 3; ++axis) hash.add(std::bit_cast<std::int64_t>(force[axis]));
  return hash.value();
}

/// Recorded with four lanes, so that a machine without AVX2 compares its two lanes with these.
TEST(LanesRecorded, GiveTheBitsOfAnotherMachine) {
  EXPECT_EQ(hash_of(throw_with(SphereSpec{12}, true)), 192666849042331055u);
  EXPECT_EQ(hash_of(throw_with(RibSpec{11, 5}, true)), 16919175248206992200u);
}

TEST_P(Lanes, TwoAndFourLanesGiveTheSameBits) {
  EXPECT_TRUE(throw_with(GetParam(), true) == throw_with(GetParam(), false));
}
TEST_P(Lanes, TwoAndFourLanesGiveTheSameBitsWithClayRules) {
  EXPECT_TRUE(throw_with(GetParam(), true, ClaySpec{}) ==
              throw_with(GetParam(), false, ClaySpec{}));
}
/// Both sides, pinches, cuts, jumps past both ends, a floor, very low and very high rings.
TEST(LanesOfRules, GiveTheSameBitsForAnyMotion) {
  const auto thrown_with = [](const SceneSpec& scene, bool four) {
    const TwoLanesScope lanes(!four);
    Wheel wheel = Wheel::build(scene).value();
    Thrown thrown;
    for (const Pose& pose : random_poses(5, 1500))
      thrown.forces_n.push_back(wheel.step(pose).force_n());
    thrown.rings.assign(wheel.stack().rings().begin(), wheel.stack().rings().end());
    return thrown;
  };
  for (const double h : {0.07, 0.5, 3.0})
    for (const bool sponge : {false, true}) {
      SceneSpec scene = small_scene();
      scene.lump.ring_height_mm = h;
      scene.lump.rings = static_cast<std::size_t>(75.0 / h);
      scene.lump.max_rings = 2 * scene.lump.rings;
      scene.clay = ClaySpec{};
      scene.clay->floor_mm = 5.0;
      scene.clay->finger_mm = 90.0;
      scene.clay->finger_behind = 0.5;
      scene.clay->heave_slope = 0.2;
      scene.clay->pushed_wall_bends = true;
      scene.clay->sponge_follows = scene.clay->pressed_lump_stretches = true;
      scene.clay->thin_rim_rises = true;
      scene.clay->thin_wall_yields = scene.clay->rim_sinks = true;
      scene.clay->narrow_rim_closes = scene.clay->lifted_wall_stretches = true;
      if (sponge) scene.tool.mode = ToolMode::smooth;
      EXPECT_TRUE(thrown_with(scene, true) == thrown_with(scene, false)) << h << sponge;
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Lanes,
                         testing::Values(ToolShapeSpec{SphereSpec{12}},
                                         ToolShapeSpec{EllipseSpec{14, 6}},
                                         ToolShapeSpec{RibSpec{11, 5}},
                                         ToolShapeSpec{SampledSpec{{-9, -3, 4, 9}, {1, 6, 7, 2}}}));

}  // namespace
}  // namespace clay
