#include "app/render/pot_view.hpp"

#include "tests/app/render/drawn.hpp"

namespace clay::test {
namespace {

ClayStack stack_of(std::size_t count, double height, double (*outer)(double), double bore,
                   WideQuanta crown = 0) {
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    rings.push_back(
        {quanta_from_radius(outer(part)), bore > 0.0 && part > 0.1 ? quanta_from_radius(bore) : 0});
  }
  return ClayStack::from_rings(height / static_cast<double>(count), rings, crown).value();
}

double cone(double part) { return 30.0 + 20.0 * part; }

TEST(PotView, HasARowForEachRing) {
  const ClayStack stack = stack_of(100, 80.0, cone, 12.0);
  const auto view = render::view_of(stack);
  ASSERT_EQ(view.rows.size(), 100u);
  EXPECT_DOUBLE_EQ(view.height_mm, 80.0);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_FLOAT_EQ(view.rows[i].outer_mm, static_cast<float>(stack.rings()[i].outer_mm()));
    EXPECT_FLOAT_EQ(view.rows[i].inner_mm, static_cast<float>(stack.rings()[i].inner_mm()));
  }
}

TEST(PotView, KeepsTheWallsOfManyRings) {
  const auto view = render::view_of(stack_of(50'000, 80.0, cone, 12.0));
  ASSERT_EQ(view.rows.size(), render::kMaxRows);
  for (std::size_t i = 0; i < view.rows.size(); ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(render::kMaxRows);
    EXPECT_NEAR(view.rows[i].outer_mm, cone(part), 1e-4);
    EXPECT_FLOAT_EQ(view.rows[i].inner_mm, part > 0.1 ? 12.0f : 0.0f) << part;
  }
}

TEST(PotView, IncludesTheCrownInTheHeight) {
  const ClayStack bare = stack_of(100, 80.0, cone, 0.0);
  const WideQuanta half = bare.rings().back().volume() / 2;
  const auto view = render::view_of(stack_of(100, 80.0, cone, 0.0, half));
  EXPECT_NEAR(view.height_mm, 80.4, 1e-9);
  for (std::size_t i = 0; i < view.rows.size(); ++i) {
    const double y = 80.4 * (static_cast<double>(i) + 0.5) / static_cast<double>(view.rows.size());
    EXPECT_NEAR(view.rows[i].outer_mm, cone(std::min(y, 79.6) / 80.0), 1e-3);
  }
}

TEST(PotView, FallenPartMatchesTheEngine) {
  Pot pot;
  pot.stack = stack_of(100, 80.0, cone, 12.0);
  pot.collapse = Collapse{};
  pot.collapse->failed_ring = 39;
  pot.collapse->pivot_mm = {0.0, 35.0, 40.0};
  pot.collapse->axis = {1.0, 0.0, 0.0};
  pot.collapse->angle_rad = 0.8;
  pot.collapse->shift_mm = {0.0, -3.0, 2.0};
  const auto view = render::view_of(pot);
  ASSERT_TRUE(view.fallen);
  EXPECT_EQ(view.fallen->first_row, 40u);
  const FallenPlace place(*pot.collapse);
  for (const glm::dvec3 at : {glm::dvec3{0, 0, 0}, {30, 40, -10}, {-5, 80, 12}})
    EXPECT_LT(glm::distance(place(at), glm::dvec3(view.fallen->place * glm::dvec4(at, 1.0))), 1e-9);
  const FallFrame frame{0.2, {0.0, -1.0, 0.0}};
  Collapse moment = *pot.collapse;
  moment.angle_rad = 0.2;
  moment.shift_mm = {0.0, -1.0, 0.0};
  EXPECT_EQ(render::fallen_view(*pot.collapse, frame, view, pot.stack),
            render::fallen_view(moment, view, pot.stack));
}

TEST(PotView, HalfProfilesFollowTheTool) {
  const std::vector<ToolShapeSpec> shapes{SphereSpec{12.0}, EllipseSpec{20.0, 6.0},
                                          RibSpec{30.0, 5.0},
                                          SampledSpec{{-5.0, 0.0, 8.0}, {1.0, 6.0, 2.0}}};
  for (const ToolShapeSpec& shape : shapes) {
    const auto tool = Tool::build(shape);
    ASSERT_TRUE(tool);
    const auto profile = render::half_profile_of(*tool);
    ASSERT_GE(profile.size(), 2u);
    EXPECT_NEAR(profile.front().y, tool->low(), 1e-5);
    EXPECT_NEAR(profile.back().y, tool->high(), 1e-5);
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const double radius = tool->radius(static_cast<double>(profile[i].y));
      EXPECT_NEAR(profile[i].x, radius, 0.02 * tool->widest());
      if (i > 0) {
        EXPECT_GT(profile[i].y, profile[i - 1].y);
      }
    }
  }
}

}  // namespace
}  // namespace clay::test
