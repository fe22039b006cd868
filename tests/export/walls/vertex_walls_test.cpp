#include "export/walls/vertex_walls.hpp"

#include "claystack/export/walls.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/export/section/cup_section.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay::solid {
namespace {

TEST(VertexWalls, AreThoseOfTheFacesThatMeet) {
  // A wall of 5 mm with extra vertices in the middle, a floor of 8 mm.
  const Polygon pot{{0, 0}, {40, 0}, {40, 30}, {40, 60}, {35, 60}, {35, 30}, {35, 8}, {0, 8}};
  const auto walls = vertex_walls({{pot}}).at(0);
  ASSERT_EQ(walls.size(), pot.size());
  EXPECT_NEAR(walls[2], 5.0, 1e-9);
  EXPECT_NEAR(walls[5], 5.0, 1e-9);
  EXPECT_NEAR(walls[0], 8.0, 1e-9);
  EXPECT_NEAR(walls[7], 8.0, 1e-9);
  // The lip is no wall; the nearest vertices with one are those in the middle of the wall.
  EXPECT_NEAR(walls[3], 5.0, 1e-9);
  EXPECT_NEAR(walls[4], 5.0, 1e-9);
}

TEST(VertexWalls, AboveALimitAreTheLimit) {
  // As above: a wall of 5 mm, a floor of 8 mm.
  const Polygon pot{{0, 0}, {40, 0}, {40, 30}, {40, 60}, {35, 60}, {35, 30}, {35, 8}, {0, 8}};
  const auto walls = thin_vertex_walls(pot, 6.0);
  EXPECT_NEAR(walls[2], 5.0, 1e-9);
  EXPECT_NEAR(walls[5], 5.0, 1e-9);
  EXPECT_EQ(walls[0], 6.0);
  EXPECT_EQ(walls[7], 6.0);
  for (const double wall : thin_vertex_walls(pot, 2.0)) EXPECT_EQ(wall, 2.0);
}

TEST(VertexWalls, OfAFineLongTubeAreItsWall) {
  // The search handles edges in groups only if there are many; these are nearer than 1 mm.
  Polygon tube;
  for (int i = 0; i <= 200; ++i) tube.push_back({40.0, 0.3 * i});
  for (int i = 200; i >= 0; --i) tube.push_back({39.8, 0.3 * i});
  const auto walls = thin_vertex_walls(tube, 6.0);
  for (std::size_t i = 1; i < 401; ++i) {
    if (i == 200 || i == 201) continue;  // the corners are lips
    EXPECT_NEAR(walls[i], 0.2, 1e-9) << i;
  }
}

TEST(VertexWalls, OfAPieceWithoutAWallAreItsLargestDisc) {
  const Profile square{{{{30, 0}, {40, 0}, {40, 10}, {30, 10}}}};
  const auto walls = vertex_walls(square);
  for (const double wall : walls.at(0)) EXPECT_NEAR(wall, min_wall_mm(square), 1e-9);
}

RC_GTEST_PROP(VertexWalls, AreFiniteAndNoThinnerThanTheMinimum, ()) {
  auto random = *samples::random_engine();
  const auto section = profile_of(samples::stack(random, 20));
  RC_PRE(section.has_value());
  const double least = min_wall_mm(section->profile);
  const auto walls = vertex_walls(section->profile);
  for (const auto& piece : walls)
    for (const double wall : piece) {
      RC_ASSERT(std::isfinite(wall));
      RC_ASSERT(wall >= least * (1.0 - 1e-9));
    }
}

}  // namespace
}  // namespace clay::solid
