#include "claystack/export/job.hpp"

#include "tests/export/fallen/collapsed_pots.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>

namespace clay::solid {
namespace {

using shapes::pot_of;

Result<ExportReport> report_of(const Pot& pot, double shrinkage) {
  MemoryStore store;
  ExportOptions options;
  options.shrinkage = shrinkage;
  return run_export(pot, {{MeshFormat::stl_binary, &store}}, options);
}

TEST(Shrinkage, ClayGrowsByTheCube) {
  const Pot pot = pot_of(shapes::vase(200));
  for (const double shrinkage : {0.01, 0.08, 0.12, 0.5}) {
    const auto larger = enlarged(pot, shrinkage);
    ASSERT_TRUE(larger) << larger.error().message;
    const double factor = 1.0 / (1.0 - shrinkage);
    EXPECT_NEAR(larger->stack.volume_mm3() / pot.stack.volume_mm3(), std::pow(factor, 3), 1e-12);
    EXPECT_NEAR(larger->stack.height_mm() / pot.stack.height_mm(), factor, 1e-12);
    EXPECT_EQ(larger->ledger.volume_error(larger->stack.volume()), 0);
  }
}

RC_GTEST_PROP(Shrinkage, OfAnyStackEveryRadiusGrowsAlike, ()) {
  const Pot pot = pot_of(*shapes::any_stack());
  const double shrinkage = 1e-3 * *rc::gen::inRange(1, 300);
  const auto larger = enlarged(pot, shrinkage);
  RC_ASSERT(larger.has_value());
  for (std::size_t i = 0; i < pot.stack.size(); ++i) {
    const Ring &before = pot.stack.rings()[i], &after = larger->stack.rings()[i];
    RC_ASSERT(std::abs(after.outer_mm() * (1.0 - shrinkage) - before.outer_mm()) <
              1e-9 * before.outer_mm() + 1e-5);
    RC_ASSERT((before.inner2 == 0) == (after.inner2 == 0));
  }
}

/// Where the stack has no room for more rings, the crown is as high as many of them.
TEST(Shrinkage, AHighCrownGrowsByTheCube) {
  Pot pot = pot_of(shapes::vase(20));
  const ClayStack& stack = pot.stack;
  for (const double rings : {0.4, 1.0, 7.3}) {
    const auto crown =
        static_cast<WideQuanta>(rings * static_cast<double>(stack.rings().back().volume()));
    Pot crowned = pot_of(ClayStack::from_rings(stack.ring_height_mm(),
                                               {stack.rings().begin(), stack.rings().end()}, crown,
                                               stack.size())
                             .value());
    for (const double shrinkage : {0.001, 0.1, 0.5}) {
      const auto larger = enlarged(crowned, shrinkage);
      ASSERT_TRUE(larger) << larger.error().message;
      const double factor = 1.0 / (1.0 - shrinkage);
      EXPECT_NEAR(larger->stack.height_mm() / crowned.stack.height_mm(), factor, 1e-9) << rings;
      EXPECT_NEAR(larger->stack.volume_mm3() / crowned.stack.volume_mm3(), std::pow(factor, 3),
                  1e-9)
          << rings;
    }
  }
}

TEST(Shrinkage, ZeroKeepsThePot) {
  const Pot pot = pot_of(shapes::vase(50));
  EXPECT_EQ(enlarged(pot, 0.0).value(), pot);
}

TEST(Shrinkage, TheFilesAreLarger) {
  const Pot pot = pot_of(shapes::vase(200));
  const auto plain = report_of(pot, 0.0), larger = report_of(pot, 0.12);
  ASSERT_TRUE(plain && larger);
  EXPECT_NEAR(larger->volume.solid_mm3 / plain->volume.solid_mm3, std::pow(1.0 / 0.88, 3), 1e-8);
  EXPECT_NEAR(larger->size.height_mm / plain->size.height_mm, 1.0 / 0.88, 1e-12);
  EXPECT_EQ(larger->prepared.shrinkage, 0.12);
  EXPECT_LT(larger->volume.error_relative, 1e-9);
}

TEST(Shrinkage, FallenPartIsScaledWithThePot) {
  const Pot pot = shapes::fallen(shapes::vase(60), 30, {40.0, 20.0, 0.0}, 0.7);
  const auto larger = enlarged(pot, 0.2);
  ASSERT_TRUE(larger) << larger.error().message;
  for (const glm::dvec3 place : {glm::dvec3(0.0, 90.0, 0.0), glm::dvec3(-30.0, 60.0, 10.0)}) {
    const glm::dvec3 there = shapes::fallen_point(*pot.collapse, place) / 0.8;
    EXPECT_LT(glm::distance(shapes::fallen_point(*larger->collapse, place / 0.8), there), 1e-9);
  }
}

TEST(Shrinkage, RefusesResultsBeyondTheLimits) {
  const Pot pot = pot_of(shapes::vase(20));
  for (const double bad : {-0.01, 0.51, 1.0, std::nan("")}) {
    const auto refused = report_of(pot, bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().kind, ErrorKind::bad_input);
  }
  const auto wide = ClayStack::cylinder(3, 1.0, 4000.0, 0.0, 10);
  const auto refused = enlarged(pot_of(*wide), 0.5);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("enlarged"), std::string::npos);
}

}  // namespace
}  // namespace clay::solid
