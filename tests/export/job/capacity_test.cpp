// The capacity against water in the exported mesh, which is cut into slices from the brim down.

#include "tests/export/job/exported.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::pot_of;

using Triangle = std::array<glm::dvec3, 3>;

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<Triangle> all;
  for (const auto& t : mesh.triangles)
    all.push_back({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]});
  return all;
}

/// Area of the holes of the cut at height `z`: segments on which the clay lies outside.
double hole_area(const std::vector<Triangle>& mesh, double z) {
  double doubled = 0.0;
  for (const Triangle& t : mesh) {
    std::vector<glm::dvec3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
      if ((a.z > z) != (b.z > z)) ends.push_back(a + (z - a.z) / (b.z - a.z) * (b - a));
    }
    if (ends.size() != 2) continue;
    const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0];
    const double nx = u.y * v.z - u.z * v.y, ny = u.z * v.x - u.x * v.z;
    if (nx * (ends[0].x + ends[1].x) + ny * (ends[0].y + ends[1].y) >= 0.0) continue;
    doubled += std::abs(ends[0].x * ends[1].y - ends[1].x * ends[0].y);
  }
  return 0.5 * doubled;
}

/// From the highest point down to the floor, where the hole ends.
double water_ml(const TriangleMesh& mesh, double below_brim_mm) {
  double top = -1e9, bottom = 1e9;
  for (const glm::dvec3& p : mesh.points) {
    top = std::max(top, p.z);
    bottom = std::min(bottom, p.z);
  }
  const auto triangles = triangles_of(mesh);
  constexpr int kSlices = 2000;
  const double slice = (top - bottom) / kSlices;
  double water = 0.0;
  for (int i = 0; i < kSlices; ++i) {
    const double depth = (i + 0.5) * slice;
    const double area = hole_area(triangles, top - depth);
    if (area == 0.0) break;
    if (depth > below_brim_mm) water += area * slice;
  }
  return 1e-3 * water;
}

TEST(Capacity, EqualsWaterInTheWrittenMesh) {
  // A bellied vase, and a bottle on a hollow foot.
  const ClayStack bottle = shapes::stack_of(5.0, {{30, 25},
                                                  {32, 24},
                                                  {36, 0},
                                                  {40, 33},
                                                  {42, 36},
                                                  {40, 33},
                                                  {35, 27},
                                                  {29, 21},
                                                  {23, 16},
                                                  {22, 15}});
  for (const ClayStack& stack : {shapes::vase(150), bottle}) {
    ExportOptions options;
    options.tolerance_mm = 0.1;
    const auto exported = samples::exported(pot_of(stack), {MeshFormat::stl_binary}, options);
    ASSERT_TRUE(exported) << exported.error().message;
    ASSERT_TRUE(exported->report.maker);
    const PotState& pot = exported->report.maker->thrown;
    const auto mesh = decode_mesh(exported->files[0], MeshFormat::stl_binary, "pot").value();
    ASSERT_GT(pot.capacity_ml, 20.0);
    EXPECT_NEAR(pot.capacity_ml, water_ml(mesh, 0.0), 1e-3 * pot.capacity_ml);
    EXPECT_NEAR(pot.to_line_ml, water_ml(mesh, kFillLineMm), 1e-3 * pot.capacity_ml);
    EXPECT_LT(pot.to_line_ml, pot.capacity_ml);
  }
}

TEST(Capacity, IsOfThePotThatIsWrittenAndFired) {
  ExportOptions options;
  options.smoothing = Smoothing::none;  // a tolerance would not scale with the pot
  const auto plain = run_export(pot_of(shapes::vase(100)), {}, options);
  options.shrinkage = 0.1;
  const auto larger = run_export(pot_of(shapes::vase(100)), {}, options);
  ASSERT_TRUE(plain && larger);
  ASSERT_TRUE(larger->maker->fired);
  const double capacity = plain->maker->thrown.capacity_ml;
  EXPECT_NEAR(larger->maker->fired->capacity_ml, capacity, 1e-9 * capacity);
  EXPECT_NEAR(larger->maker->thrown.capacity_ml, capacity / (0.9 * 0.9 * 0.9), 1e-9 * capacity);
}

// ---- goals ----

TEST(Goal, IsMetByTheWaterInTheWrittenMesh) {
  ExportOptions options;
  options.tolerance_mm = 0.1;
  for (const bool to_line : {false, true}) {
    Goal goal;
    goal.holds_ml = 350.0;
    goal.to_fill_line = to_line;
    const auto reached = scaled_to(pot_of(shapes::vase(150)), goal, options);
    ASSERT_TRUE(reached) << reached.error().message;
    EXPECT_EQ(reached->met.radius_factor, reached->met.height_factor);
    const auto exported = samples::exported(reached->pot, {MeshFormat::stl_binary}, options);
    ASSERT_TRUE(exported) << exported.error().message;
    const auto mesh = decode_mesh(exported->files[0], MeshFormat::stl_binary, "pot").value();
    EXPECT_NEAR(water_ml(mesh, to_line ? kFillLineMm : 0.0), 350.0, 0.35);
  }
}

TEST(Goal, ThatTheCapacityJumpsOverIsMetAsNearlyAsPossible) {
  // At the size that holds 211 ml, smoothing simplifies the walls differently than just above it.
  ExportOptions options;
  options.tolerance_mm = 0.3;
  Goal goal;
  goal.holds_ml = 211.0;
  const auto reached = scaled_to(pot_of(shapes::vase(150)), goal, options);
  ASSERT_TRUE(reached) << reached.error().message;
  const auto report = run_export(reached->pot, {}, options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_NEAR(report->maker->thrown.capacity_ml, 211.0, 211e-3);
}

TEST(Goal, OfACylinderAgreesWithClosedForms) {
  // A cup of 40 mm radius outside, 35 mm inside, 100 mm high, with a floor of 10 mm.
  std::vector<shapes::Radii> rings(10, {40, 35});
  rings[0] = {40, 0};
  const Pot cup = pot_of(shapes::stack_of(10.0, rings));
  const double holds = 1e-3 * std::numbers::pi * 35 * 35 * 90;
  const auto factors = [&](const Goal& goal, double shrinkage = 0.0) {
    ExportOptions options;
    options.shrinkage = shrinkage;
    const auto reached = scaled_to(cup, goal, options);
    EXPECT_TRUE(reached) << (reached ? "" : reached.error().message);
    return reached ? std::pair(reached->met.radius_factor, reached->met.height_factor)
                   : std::pair(0.0, 0.0);
  };
  Goal goal;
  goal.holds_ml = 500.0;
  EXPECT_NEAR(factors(goal).first, std::cbrt(500.0 / holds), 1e-6);
  goal.height_mm = 120.0;  // then the radius alone
  EXPECT_NEAR(factors(goal).second, 1.2, 1e-6);
  EXPECT_NEAR(factors(goal).first, std::sqrt(500.0 / (1.2 * holds)), 1e-6);
  goal = {};
  goal.diameter_mm = 60.0;
  goal.weighs_g = 400.0;  // then the height alone
  const double weight = 1e-3 * 1.9 * std::numbers::pi * (40 * 40 * 100 - 35 * 35 * 90);
  EXPECT_NEAR(factors(goal).first, 0.75, 1e-6);
  EXPECT_NEAR(factors(goal).second, 400.0 / (0.75 * 0.75 * weight), 1e-5);
  goal = {};
  goal.height_mm = 90.0;
  goal.fired = true;  // shrinkage enlarges the files, so that the pot has its size once fired
  EXPECT_NEAR(factors(goal, 0.1).second, 0.9, 1e-6);
  goal.fired = false;
  EXPECT_NEAR(factors(goal, 0.1).second, 0.81, 1e-6);
}

TEST(Goal, OfTheFinishedPotCountsItsGlaze) {
  // Glaze fills the set-back: the glazed cup has the size of the cup before it.
  std::vector<shapes::Radii> rings(10, {40, 35});
  rings[0] = {40, 0};
  const Pot cup = pot_of(shapes::stack_of(10.0, rings));
  ExportOptions options;
  options.smoothing = Smoothing::none;
  options.shrinkage = 0.1;
  options.finish.glaze_mm = enlargement(0.1);  // 1 mm, fired
  Goal goal;
  goal.fired = true;
  goal.height_mm = 100.0;
  const auto reached = scaled_to(cup, goal, options);
  ASSERT_TRUE(reached) << reached.error().message;
  EXPECT_NEAR(reached->met.height_factor, 1.0, 1e-6);
  EXPECT_EQ(text_of(reached->met), "100 mm high, fired and glazed");
  const auto report = run_export(reached->pot, {}, options);
  ASSERT_TRUE(report) << report.error().message;
  const MakerNumbers& numbers = *report->maker;
  ASSERT_TRUE(numbers.glazed && numbers.fired);
  EXPECT_NEAR(numbers.glazed->size.height_mm, 100.0, 1e-4);
  EXPECT_NEAR(numbers.glazed->size.diameter_mm, 80.0, 1e-4);
  EXPECT_NEAR(numbers.fired->size.height_mm, 99.0, 0.02);
  EXPECT_NEAR(numbers.fired->size.diameter_mm, 78.0, 0.02);
  EXPECT_NEAR(numbers.glazed->capacity_ml, 1e-3 * std::numbers::pi * 35 * 35 * 90, 1e-3);
  EXPECT_EQ(numbers.glazed->weight_g, numbers.fired->weight_g);
}

/// The weight of the glaze is not known.
TEST(Goal, StatesAWeightWithoutTheGlaze) {
  Goal goal;
  goal.weighs_g = 400.0;
  goal.fired = true;
  EXPECT_EQ(text_of(MetGoal{goal, true}), "weighs 400 g, fired, without its glaze");
  EXPECT_EQ(text_of(MetGoal{goal, false}), "weighs 400 g, fired");
  goal.height_mm = 100.0;
  EXPECT_EQ(text_of(MetGoal{goal, true}),
            "weighs 400 g without its glaze, 100 mm high, fired and glazed");
}

TEST(Goal, IsRefusedWithTheReason) {
  const Pot vase = pot_of(shapes::vase(100));
  const auto why = [&](const Pot& pot, const Goal& goal, const ExportOptions& options = {}) {
    const auto reached = scaled_to(pot, goal, options);
    return reached ? std::string("not refused") : reached.error().message;
  };
  const auto of = [](auto change) {
    Goal goal;
    change(goal);
    return goal;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != text.npos ? std::string() : text;
  };
  EXPECT_EQ(has(why(vase, {}), "expected a capacity"), "");
  EXPECT_EQ(
      has(why(vase, of([](Goal& g) { g.holds_ml = g.weighs_g = 1.0; })), "expected one figure"),
      "");
  EXPECT_EQ(has(why(vase, of([](Goal& g) { g.holds_ml = 350.0, g.fired = true; })),
                "expected a shrinkage"),
            "");
  EXPECT_EQ(has(why(vase, of([](Goal& g) { g.height_mm = 1e7; })),
                "a factor from 0.02 to 50, found 10000000, a factor of "),
            "");
  // Beyond 64 bits, in quanta.
  const Pot disc = pot_of(shapes::stack_of(10.0, {{1000, 0}}));
  EXPECT_EQ(has(why(disc, of([](Goal& g) { g.diameter_mm = 25'000.0; })),
                "goal: expected a diameter of at most 10000 mm, found 25000"),
            "");
  const Pot tube = pot_of(shapes::stack_of(10.0, {{40, 30}, {40, 30}}));
  EXPECT_EQ(has(why(tube, of([](Goal& g) { g.holds_ml = 350.0; })), "no floor"), "");
  const Pot vessel = pot_of(shapes::stack_of(10.0, {{40, 0}, {40, 30}, {40, 0}}));
  EXPECT_EQ(has(why(vessel, of([](Goal& g) { g.holds_ml = 350.0; })), "no opening at the top"), "");
  ExportOptions thick;
  thick.walls.min_wall_mm = 3.0;
  EXPECT_EQ(has(why(vase, of([](Goal& g) { g.height_mm = 20.0; }), thick), "thin wall"), "");
}

}  // namespace
}  // namespace clay::solid
