// Strokes that are planned on the pot: the places of the tool, from the geometry of tool and clay.

#include "app/strokes/strokes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace clay::strokes {
namespace {

constexpr double kToolMm = 10.0, kRadiusMm = 40.0, kHeightMm = 60.0, kBoreMm = 30.0;

/// A tube of 10 mm that does not yield, so that it keeps the shape for which the stroke was
/// planned.
SceneSpec tube() {
  SceneSpec scene;
  scene.lump = {.rings = 120,
                .ring_height_mm = kHeightMm / 120,
                .outer_radius_mm = kRadiusMm,
                .inner_radius_mm = kBoreMm};
  scene.tool = {SphereSpec{kToolMm}, ToolMode::press, 20.0};
  scene.removal.min_wall_mm = kRadiusMm - kBoreMm;
  return scene;
}

StrokeScript script_of(const Stroke& stroke) {
  StrokeScript script;
  script.tremor_mm = 0.0;
  script.rate_hz = 250.0;
  script.start_mm = {90.0, 120.0};
  script.strokes = {stroke};
  return script;
}

Stroke stroke_of(StrokeKind kind) {
  Stroke stroke;
  stroke.kind = kind;
  return stroke;
}

std::vector<Pose> poses_of(const Stroke& stroke, const SceneSpec& scene = tube()) {
  return play(script_of(stroke), scene, Wheel::build(scene).value()).value().poses;
}

/// What `play` reports on a stroke after others.
PlayedStroke report_on(std::vector<Stroke> strokes, const SceneSpec& scene,
                       glm::dvec2 start_mm = {90.0, 120.0}) {
  StrokeScript script = script_of({});
  script.strokes = std::move(strokes);
  script.start_mm = start_mm;
  return play(script, scene, Wheel::build(scene).value()).value().strokes.back();
}

Stroke path_of(std::vector<glm::dvec2> through_mm) {
  Stroke stroke;
  stroke.through_mm = std::move(through_mm);
  return stroke;
}

std::string all_of(const std::vector<std::string>& warnings) {
  std::string all;
  for (const std::string& warning : warnings) all += warning + "; ";
  return all;
}

TEST(Played, ReportsThePotAfterAStroke) {
  Stroke stroke = stroke_of(StrokeKind::shape);
  stroke.outline = {{kRadiusMm - 2.0, 0.25}, {kRadiusMm - 2.0, 0.75}};
  const PlayedStroke played = report_on({stroke}, tube());
  EXPECT_NEAR(played.height_mm, kHeightMm, 1e-9) << "without rules of clay the rim stays";
  ASSERT_TRUE(played.thinnest_mm);
  EXPECT_NEAR(*played.thinnest_mm, kRadiusMm - kBoreMm, 1e-6) << "the minimum wall";
  EXPECT_GT(played.seconds, 1.0);
  EXPECT_EQ(all_of(played.warnings), "");
}

TEST(Played, WarnsOfAStrokeInTheAir) {
  const Stroke high = path_of({{90.0, 150.0}, {60.0, 150.0}});
  EXPECT_EQ(all_of(report_on({high}, tube()).warnings), "touches no clay; ");
  // Also after a stroke that touched some.
  Stroke press = stroke_of(StrokeKind::shape);
  press.outline = {{kRadiusMm - 2.0, 0.25}, {kRadiusMm - 2.0, 0.75}};
  EXPECT_EQ(all_of(report_on({press, high}, tube()).warnings), "touches no clay; ");
}

TEST(Played, WarnsOfAWayThroughThePot) {
  // From the bore through the wall to the start.
  const Stroke inside = path_of({{0.0, 150.0}, {0.0, 0.5 * kHeightMm}});
  const std::string across = all_of(report_on({inside, inside}, tube(), {90.0, 60.0}).warnings);
  EXPECT_NE(across.find("presses the clay at a height of "), std::string::npos) << across;
  EXPECT_NE(across.find("start_mm (90, 60)"), std::string::npos) << across;
  // A tool that leaves the wall it has pressed does not press it on its way.
  const Stroke press =
      path_of({{90.0, 0.5 * kHeightMm}, {kRadiusMm + kToolMm - 3.0, 0.5 * kHeightMm}});
  EXPECT_EQ(all_of(report_on({press, press}, tube(), {90.0, 0.5 * kHeightMm}).warnings), "");
}

TEST(Played, WarnsOfAPullOnSolidClay) {
  SceneSpec solid = tube();
  solid.lump.inner_radius_mm = 0.0;
  Stroke pull = stroke_of(StrokeKind::pull);
  pull.outline = {{kRadiusMm, 0.0}, {kRadiusMm, 1.0}};
  pull.gap_mm = {6.0};
  pull.speed_mm_s = 60.0;
  pull.from_mm = 20.0;
  const std::string warnings = all_of(report_on({pull}, solid).warnings);
  EXPECT_NE(warnings.find("expected a wall between the two tools at a height of 20 mm"),
            std::string::npos)
      << warnings;
}

TEST(Played, WarnsOfAPotThatFalls) {
  SceneSpec weak = tube();
  weak.removal.min_wall_mm = 0.5;
  // Its limit is just above what the foot carries at the beginning.
  const auto stresses = stresses_kpa(Wheel::build(weak)->stack(), weak.lump.density_g_cm3);
  weak.stability.emplace().max_stress_kpa = 1.02 * *std::ranges::max_element(stresses);
  Stroke press = path_of({{90.0, 15.0}, {kRadiusMm + kToolMm - 4.0, 15.0}});
  press.trim = true;
  EXPECT_EQ(all_of(report_on({press}, weak).warnings), "the pot falls; ");
  EXPECT_EQ(all_of(report_on({press, press}, weak).warnings),
            "does nothing, because the pot has fallen; ");
}

TEST(Shape, LeadsTheToolAlongTheOutsideOfAnOutline) {
  Stroke stroke = stroke_of(StrokeKind::shape);
  stroke.outline = {{kRadiusMm - 2.0, 0.25}, {kRadiusMm - 2.0, 0.75}};
  double nearest = 1e9;
  for (const Pose& pose : poses_of(stroke)) {
    nearest = std::min(nearest, pose.position_mm.x);
    // A ball that touches a step of 2 mm from above or below stands off by less.
    if (pose.position_mm.x < kRadiusMm + kToolMm - 1.999) {
      EXPECT_GT(pose.position_mm.y, 0.25 * kHeightMm + std::sqrt(100.0 - 64.0) - 1.0);
      EXPECT_LT(pose.position_mm.y, 0.75 * kHeightMm - std::sqrt(100.0 - 64.0) + 1.0);
    }
  }
  EXPECT_NEAR(nearest, kRadiusMm - 2.0 + kToolMm, 0.01);
}

TEST(Shape, TakesAnEqualPartOfTheWayInEachPass) {
  Stroke stroke = stroke_of(StrokeKind::shape);
  stroke.outline = {{kRadiusMm - 3.0, 0.2}, {kRadiusMm - 3.0, 0.8}};
  stroke.passes = 3;
  // The tube does not yield: the way that remains is 3 mm before each pass, of which the first
  // takes a third, the second a half and the last all.
  double nearest = 1e9;
  std::vector<double> depths;
  for (const Pose& pose : poses_of(stroke)) {
    if (pose.position_mm.x > 80.0 && nearest < 60.0) {
      depths.push_back(kRadiusMm + kToolMm - nearest);
      nearest = 1e9;
    }
    nearest = std::min(nearest, pose.position_mm.x);
  }
  ASSERT_EQ(depths.size(), 3u);
  EXPECT_NEAR(depths[0], 1.0, 0.01);
  EXPECT_NEAR(depths[1], 1.5, 0.01);
  EXPECT_NEAR(depths[2], 3.0, 0.01);
}

TEST(Shape, EntersAndLeavesABoreByItsMouth) {
  Stroke stroke = stroke_of(StrokeKind::shape);
  stroke.inside = true;
  stroke.outline = {{kBoreMm + 1.0, 0.4}, {kBoreMm + 1.0, 0.8}};
  double widest = 0.0;
  for (const Pose& pose : poses_of(stroke)) {
    if (pose.position_mm.y > kHeightMm + kToolMm) continue;
    widest = std::max(widest, pose.position_mm.x);
    EXPECT_LE(pose.position_mm.x, kBoreMm + 1.0 - kToolMm + 0.01) << pose.position_mm.y;
  }
  EXPECT_NEAR(widest, kBoreMm + 1.0 - kToolMm, 0.01);
}

TEST(Pull, ClosesOnTheWallAndRisesOverTheRim) {
  Stroke stroke = stroke_of(StrokeKind::pull);
  stroke.outline = {{34.0, 0.0}, {36.0, 1.0}};
  stroke.gap_mm = {12.0, 11.0};
  stroke.from_mm = 15.0;
  stroke.speed_mm_s = 30.0;
  double highest = 0.0, lowest = 1e9, last_y = 1e9;
  bool closed = false;
  for (const Pose& pose : poses_of(stroke)) {
    if (pose.gap_mm == 0.0) continue;
    const double y = pose.position_mm.y, share = y / kHeightMm;
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
    closed = closed || (y > 20.0 && y > last_y);
    if (closed && share <= 1.0) {
      EXPECT_NEAR(pose.gap_mm, 12.0 - share, 0.01);
      EXPECT_NEAR(pose.position_mm.x, 34.0 + 2.0 * share, 0.01);
    }
    last_y = y;
  }
  EXPECT_NEAR(lowest, 15.0, 0.01);
  EXPECT_GT(highest, kHeightMm + kToolMm);
}

TEST(Lip, RollsTheToolAroundASemicircle) {
  Stroke stroke = stroke_of(StrokeKind::lip);
  const double middle = 0.5 * (kRadiusMm + kBoreMm), round = 0.5 * (kRadiusMm - kBoreMm);
  // The tube has the minimum wall, so its lip must keep its width: there is no clay to round. With
  // less of a minimum the tool's surface touches the semicircle.
  SceneSpec scene = tube();
  scene.removal.min_wall_mm = 1.0;
  scene.removal.rate_per_s = 1e-9;
  double nearest = 1e9;
  for (const Pose& pose : poses_of(stroke, scene)) {
    const double away =
        std::hypot(pose.position_mm.x - middle, pose.position_mm.y - (kHeightMm - round));
    if (pose.position_mm.y > kHeightMm - round) nearest = std::min(nearest, away);
  }
  EXPECT_NEAR(nearest, round + kToolMm, 0.1);
}

}  // namespace
}  // namespace clay::strokes
