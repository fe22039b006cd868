// Borders that lie in one place but do not match: T-junctions, and holes that touch in a vertex.

#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "export/formats/file_floats.hpp"
#include "export/repair/border_rings.hpp"
#include "export/solid/mesh_topology.hpp"
#include "tests/export/repair/repair_counts.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::ball;
using shapes::cube;

constexpr const char* kSplit = "edge split at a vertex on it";

/// Splits the edge of the triangle that has it in the direction from a to b, of no other one.
void split_one_side(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const auto middle = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
  for (Triangle& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      if (t.at(c) != a || t.at((c + 1) % 3) != b) continue;
      const std::uint32_t opposite = t.at((c + 2) % 3);
      t = {a, middle, opposite};
      mesh.triangles.push_back({middle, b, opposite});
      return;
    }
}

/// The cube of 40 mm with its vertices and middles of edges only, without a fill.
void expect_whole_cube(const TriangleMesh& broken, std::size_t splits) {
  ASSERT_FALSE(check_mesh(broken).value().sound());
  const auto result = repair_mesh(broken);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(check_mesh(result->mesh).value().sound());
  EXPECT_EQ(signed_volume(result->mesh), 64'000.0);  // all coordinates are small integers
  EXPECT_EQ(times(*result, kSplit), splits);
  EXPECT_EQ(result->repaired.size(), 1U);
  EXPECT_EQ(result->mesh.points.size(), broken.points.size());
  EXPECT_EQ(result->mesh.triangles.size(), broken.triangles.size() + splits);
  EXPECT_EQ(result->change.added_mm, 0.0);
}

TEST(OpenBorders, AnEdgeSplitOnOneSideIsSplitOnTheOther) {
  const TriangleMesh whole = cube(40.0);
  for (const Triangle& t : whole.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      TriangleMesh mesh = whole;
      split_one_side(mesh, t.at(c), t.at((c + 1) % 3));
      expect_whole_cube(mesh, 1);
    }
}

TEST(OpenBorders, AllEdgesOfACubeAreSplit) {
  // From low to high in one turn, from high to low in the other: triangles with up to three split
  // edges.
  for (const bool upward : {true, false}) {
    TriangleMesh mesh = cube(40.0);
    for (const Triangle& t : cube(40.0).triangles)
      for (std::size_t c = 0; c < 3; ++c)
        if (const std::uint32_t a = t.at(c), b = t.at((c + 1) % 3); (a < b) == upward)
          split_one_side(mesh, a, b);
    expect_whole_cube(mesh, 18);  // 12 edges of the cube and 6 diagonals
  }
}

/// A cube of 40 mm whose faces are grids of n x n squares.
TriangleMesh grid_cube(const std::array<int, 6>& n) {
  std::map<std::array<double, 3>, std::uint32_t> number;
  TriangleMesh mesh;
  const auto vertex = [&](const std::array<double, 3>& p) {
    const auto next = static_cast<std::uint32_t>(mesh.points.size());
    const auto [at, fresh] = number.emplace(p, next);
    if (fresh) mesh.points.emplace_back(p[0], p[1], p[2]);
    return at->second;
  };
  for (std::size_t face = 0; face < 6; ++face) {
    const std::size_t axis = face / 2;
    const auto corner = [&](int i, int j) {
      std::array<double, 3> p{};
      p.at(axis) = face % 2 == 0 ? 0.0 : 40.0;
      p.at((axis + 1) % 3) = 40.0 * i / n.at(face);
      p.at((axis + 2) % 3) = 40.0 * j / n.at(face);
      return vertex(p);
    };
    for (int i = 0; i < n.at(face); ++i)
      for (int j = 0; j < n.at(face); ++j) {
        const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                            d = corner(i, j + 1);
        mesh.triangles.push_back(face % 2 == 0 ? Triangle{c, b, a} : Triangle{a, b, c});
        mesh.triangles.push_back(face % 2 == 0 ? Triangle{d, c, a} : Triangle{a, c, d});
      }
  }
  return mesh;
}

/// Each edge of the cube belongs to two faces: each is split at the other one's vertices.
std::size_t splits_of(const std::array<int, 6>& n) {
  std::size_t splits = 0;
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t g = f + 1; g < 6; ++g) {
      if (f / 2 == g / 2) continue;
      for (const auto& [fine, coarse] : {std::pair(n.at(f), n.at(g)), std::pair(n.at(g), n.at(f))})
        for (int i = 1; i < fine; ++i) splits += i * coarse % fine == 0 ? 0U : 1U;
    }
  return splits;
}

TEST(OpenBorders, AFinerGridOnAFaceIsJoined) {
  // By the edges of the sixth face: four, each with n - 1 vertices of the finer grid.
  EXPECT_EQ(splits_of({1, 1, 1, 1, 1, 4}), 12U);
  // The second turn puts the edges across the axes, so that rounding moves vertices off them.
  const glm::dmat3 turn =
      glm::dmat3(2.0, 2.0, -1.0, -1.0, 2.0, 2.0, 2.0, -1.0, 2.0) / 3.0;  // about (1, 1, 1)
  for (const glm::dmat3& by : {glm::dmat3(1.0), turn})
    for (const std::array<int, 6>& n :
         {std::array{1, 1, 1, 1, 1, 2}, std::array{1, 1, 1, 1, 1, 4}, std::array{2, 2, 2, 2, 2, 4},
          std::array{1, 2, 3, 4, 5, 6}, std::array{1, 1, 60, 1, 1, 1}}) {
      TriangleMesh mesh = grid_cube(n);
      for (glm::dvec3& p : mesh.points) p = by * p;
      round_to_file(mesh.points);
      const auto result = repair_mesh(mesh);
      ASSERT_TRUE(result) << n[5] << ": " << result.error().message;
      EXPECT_TRUE(check_mesh(result->mesh).value().sound());
      EXPECT_TRUE(result->holes.empty());
      EXPECT_EQ(times(*result, kSplit), splits_of(n));
      // Coordinates up to 67 mm are rounded by at most 2^-18 mm, the surface has 9,600 mm2.
      EXPECT_NEAR(signed_volume(result->mesh), 64'000.0, 9'600.0 * std::sqrt(3.0) * 0x1p-18);
    }
}

TEST(OpenBorders, AVertexFarFromTheEdgeIsKept) {
  // By 0.04 mm, a thousandth of the edge: the slit is filled, and no point moves.
  TriangleMesh mesh = cube(40.0);
  split_one_side(mesh, 0, 1);
  mesh.points.back().y = -0.04;
  const auto result = repair_mesh(mesh);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(times(*result, kSplit), 0U);
  EXPECT_EQ(times(*result, "hole filled"), 1U);
}

/// Whether the triangles have exactly one vertex in common.
bool share_a_vertex_only(const Triangle& t, const Triangle& u) {
  return std::count_if(t.begin(), t.end(), [&](std::uint32_t v) {
           return std::find(u.begin(), u.end(), v) != u.end();
         }) == 1;
}

TEST(OpenBorders, HolesThatTouchInAVertexAreFilledEachByItself) {
  const TriangleMesh whole = ball(20.0);
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < whole.triangles.size(); i += 7)
    for (std::size_t j = i + 1; j < whole.triangles.size(); ++j) {
      if (!share_a_vertex_only(whole.triangles[i], whole.triangles[j])) continue;
      ++pairs;
      TriangleMesh mesh = whole;
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(j));
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
      const auto result = repair_mesh(mesh);
      ASSERT_TRUE(result) << i << ", " << j << ": " << result.error().message;
      EXPECT_TRUE(check_mesh(result->mesh).value().sound()) << i << ", " << j;
      ASSERT_EQ(result->holes.size(), 2U) << i << ", " << j;
      for (const FilledHole& hole : result->holes) EXPECT_EQ(hole.edges, 3U);
      EXPECT_EQ(result->repaired.size(), 1U) << i << ", " << j;
      EXPECT_EQ(result->mesh.triangles.size(), whole.triangles.size());
      // The points were rounded, by at most 2^-20 mm up to 20 mm.
      EXPECT_NEAR(signed_volume(result->mesh), signed_volume(whole),
                  4.0 * 3.15 * 400.0 * std::sqrt(3.0) * 0x1p-20);
    }
  EXPECT_GT(pairs, 50U);
}

/// Of a revolved outline, without the triangles in a plane of equal height.
TriangleMesh without_level(TriangleMesh mesh, double z) {
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return mesh.points[v].z == z; });
  });
  return mesh;
}

/// Turned about (1, 1, 1), so that no coordinate of a plane is the same, and rounded.
TriangleMesh turned(TriangleMesh mesh) {
  const glm::dmat3 by = glm::dmat3(2.0, 2.0, -1.0, -1.0, 2.0, 2.0, 2.0, -1.0, 2.0) / 3.0;
  for (glm::dvec3& p : mesh.points) p = by * p;
  round_to_file(mesh.points);
  return mesh;
}

TEST(OpenBorders, TheRimOfACupIsARingBetweenItsWalls) {
  // A wall and a floor of 1 mm; the rim is 1.1 % of the surface.
  const TriangleMesh cup = revolve({{{{0, 0}, {20, 0}, {20, 40}, {19, 40}, {19, 1}, {0, 1}}}}, 64);
  for (const TriangleMesh& open : {without_level(cup, 40.0), turned(without_level(cup, 40.0))}) {
    const auto result = repair_mesh(open);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_EQ(check_mesh(result->mesh).value().components, 1U);
    ASSERT_EQ(result->holes.size(), 1U);
    EXPECT_EQ(result->holes[0].edges, 128U);
    // The 64-gons have the area of the circles: equal volume.
    EXPECT_NEAR(result->holes[0].area_mm2, 3.14159265 * (400.0 - 361.0), 1e-3);
    EXPECT_NEAR(signed_volume(result->mesh), signed_volume(cup), 1e-4 * signed_volume(cup));
    EXPECT_LT(result->change.added_mm, 1.0);  // the middle of the rim is 0.5 mm from both walls
  }
}

TEST(OpenBorders, TwoWallsOfAPipeAreJoinedByRingsOnRequest) {
  const TriangleMesh pipe = revolve({{{{15, 0}, {20, 0}, {20, 40}, {15, 40}}}}, 64);
  const TriangleMesh walls = without_level(without_level(pipe, 0.0), 40.0);
  for (const TriangleMesh& open : {walls, turned(walls)}) {
    const auto refused = repair_mesh(open);
    ASSERT_FALSE(refused);
    for (const char* part :
         {"one around the other", "capping closes by a ring", "which thickening gives one"})
      EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
    const auto capped = repair_mesh(open, {.cap_openings = true});
    ASSERT_TRUE(capped) << capped.error().message;
    EXPECT_EQ(capped->holes.size(), 2U);
    EXPECT_EQ(check_mesh(capped->mesh).value().components, 1U);
    EXPECT_NEAR(signed_volume(capped->mesh), signed_volume(pipe), 1e-4 * signed_volume(pipe));
  }
}

/// The walls of a block of 100 x 100 x 40 mm with square tunnels of 10 mm through it, around
/// (middle, middle); without top and bottom.
TriangleMesh walls_of_block(const std::vector<double>& middles) {
  TriangleMesh mesh;
  const auto add = [&](double from, double to, bool inward) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const double z : {0.0, 40.0})
      for (const auto& [x, y] :
           {std::pair(from, from), std::pair(to, from), std::pair(to, to), std::pair(from, to)})
        mesh.points.emplace_back(x, y, z);
    for (std::uint32_t i = 0; i < 4; ++i) {
      std::uint32_t a = first + i, b = first + (i + 1) % 4;
      if (inward) std::swap(a, b);
      mesh.triangles.push_back({a, b, b + 4});
      mesh.triangles.push_back({a, b + 4, a + 4});
    }
  };
  add(0.0, 100.0, false);
  for (const double middle : middles) add(middle - 5.0, middle + 5.0, true);
  return mesh;
}

TEST(OpenBorders, ARingWithSeveralHolesIsFilledInAnyOrderOfThem) {
  // The straight way from a corner of the block to the middle tunnel crosses another tunnel.
  std::vector<double> middles{30.0, 50.0, 70.0};
  do {
    const auto capped = repair_mesh(walls_of_block(middles), {.cap_openings = true});
    ASSERT_TRUE(capped) << capped.error().message;
    EXPECT_EQ(times(*capped, "hole filled"), 2U) << middles[0] << " " << middles[1];
    EXPECT_EQ(capped->repaired.size(), 1U);
    ASSERT_EQ(capped->holes.size(), 2U);
    for (const FilledHole& hole : capped->holes) {
      EXPECT_EQ(hole.edges, 16U);
      EXPECT_EQ(hole.area_mm2, 100.0 * 100.0 - 3.0 * 10.0 * 10.0);
    }
    EXPECT_TRUE(check_mesh(capped->mesh).value().sound());
    EXPECT_EQ(signed_volume(capped->mesh), (100.0 * 100.0 - 3.0 * 10.0 * 10.0) * 40.0);
  } while (std::ranges::next_permutation(middles).found);
}

/// A square hole around (x, y) at a height, in either turn.
Border square(double x, double y, double z, double half, bool turned) {
  Border border;
  border.points = {{x - half, y - half, z},
                   {x + half, y - half, z},
                   {x + half, y + half, z},
                   {x - half, y + half, z}};
  if (turned) std::ranges::reverse(border.points);
  border.low = {x - half, y - half, z};
  border.high = {x + half, y + half, z};
  border.area.z = (turned ? -4.0 : 4.0) * half * half;
  return border;
}

RC_GTEST_PROP(OpenBorders, ABorderLiesInTheSmallestOppositeOneAroundIt, ()) {
  std::vector<Border> borders;
  const int count = *rc::gen::inRange(1, 60);
  double half = 0.0;
  for (int i = 0; i < count; ++i) {
    // Two of each size, without rounding; sides of others lie beside each other.
    if (i % 2 == 0) half = *rc::gen::inRange(1, 9) + i / 128.0;
    borders.push_back(square(*rc::gen::inRange(-9, 9), *rc::gen::inRange(-9, 9),
                             *rc::gen::inRange(0, 2), half, *rc::gen::arbitrary<bool>()));
  }
  const std::vector<std::size_t> around = borders_around(borders);
  RC_ASSERT(around.size() == borders.size());
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const Border& inner = borders[i];
    std::size_t wanted = i;
    for (std::size_t j = 0; j < borders.size(); ++j) {
      const Border& outer = borders[j];
      const bool is_around = outer.low.z == inner.low.z && outer.area.z * inner.area.z < 0.0 &&
                             outer.low.x < inner.low.x && outer.low.y < inner.low.y &&
                             outer.high.x > inner.high.x && outer.high.y > inner.high.y;
      if (is_around && (wanted == i || std::abs(outer.area.z) < std::abs(borders[wanted].area.z)))
        wanted = j;
    }
    RC_ASSERT(around[i] == wanted);
  }
}

TEST(OpenBorders, TheWidthOfAHoleIsItsLargestDistance) {
  // A regular polygon of 400 corners: opposite ones are a diameter apart.
  const TriangleMesh tube = revolve({{{{0, 0}, {35, 0}, {35, 50}, {0, 50}}}}, 400);
  const auto open = without_level(tube, 50.0);
  double widest = 0.0;
  for (const glm::dvec3& p : open.points) widest = std::max(widest, 2.0 * std::hypot(p.x, p.y));
  const auto refused = repair_mesh(open);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("an opening 70 mm wide"), std::string::npos)
      << refused.error().message;
  const auto capped = repair_mesh(open, {.cap_openings = true});
  ASSERT_TRUE(capped) << capped.error().message;
  ASSERT_EQ(capped->holes.size(), 1U);
  EXPECT_NEAR(capped->holes[0].extent_mm, widest, 1e-4);
}

TEST(OpenBorders, AMoebiusStripIsASurfaceWithoutAWall) {
  constexpr std::uint32_t kSteps = 40;
  TriangleMesh strip;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double angle = 2.0 * 3.141592653589793 * i / kSteps;
    for (const double side : {-3.0, 3.0}) {
      const double r = 20.0 + side * std::cos(0.5 * angle);
      strip.points.emplace_back(r * std::cos(angle), r * std::sin(angle),
                                side * std::sin(0.5 * angle));
    }
    // The last quadrilateral joins the sides crosswise.
    const bool last = i + 1 == kSteps;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  for (const bool cap : {false, true}) {
    const auto refused = repair_mesh(strip, {.cap_openings = cap});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::unsound);
    EXPECT_NE(refused.error().message.find("a surface without a wall"), std::string::npos)
        << refused.error().message;
  }
  const auto thick = repair_mesh(strip, {.thicken_mm = 2.0});
  ASSERT_TRUE(thick) << thick.error().message;
  EXPECT_TRUE(check_mesh(thick->mesh).value().sound());
}

}  // namespace
}  // namespace clay::solid
