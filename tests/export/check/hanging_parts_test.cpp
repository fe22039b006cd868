#include "claystack/export/check.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

namespace clay::solid {
namespace {

using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::together;

std::optional<HangingParts> hanging(const TriangleMesh& mesh) {
  return hanging_parts(mesh, check_mesh(mesh).value());
}

void expect_hanging(const TriangleMesh& mesh, std::size_t hanging_count, std::size_t parts,
                    double lowest_mm) {
  const auto found = hanging(mesh);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->hanging, hanging_count);
  EXPECT_EQ(found->parts, parts);
  EXPECT_NEAR(found->lowest_mm, lowest_mm, 1e-9);
}

TEST(HangingParts, AreThoseInMidAir) {
  const TriangleMesh base = moved(cube(10), {0, 0, 7});  // the bed is where the mesh begins
  expect_hanging(together(base, moved(cube(4), {10.2, 3, 10})), 1, 2, 3.0);
  // One above the other, and one beside them that stands.
  TriangleMesh mesh = together(base, moved(cube(10), {0, 0, 20}));
  mesh = together(mesh, moved(cube(10), {0, 0, 32}));
  expect_hanging(together(mesh, moved(cube(5), {30, 0, 7})), 2, 4, 13.0);
}

TEST(HangingParts, AreNotThoseThatStandOrTouchWhatStands) {
  const TriangleMesh base = cube(10);
  EXPECT_FALSE(hanging(base));
  EXPECT_FALSE(hanging(together(base, moved(cube(5), {30, 0, 0})))) << "two on the bed";
  EXPECT_FALSE(hanging(together(base, moved(cube(4), {9, 3, 3})))) << "overlap";
  EXPECT_FALSE(hanging(together(base, moved(cube(6), {2, 2, 10})))) << "a lid";
  EXPECT_FALSE(hanging(together(base, moved(cube(6), {2, 2, 10.001})))) << "rounding";
  EXPECT_TRUE(hanging(together(base, moved(cube(6), {2, 2, 10.1}))));
  // Under a part that stands beside it.
  TriangleMesh chain = together(base, moved(cube(4), {9, 3, 6}));
  chain = together(chain, moved(cube(4), {12, 3, 6}));
  EXPECT_FALSE(hanging(chain)) << "a part that touches one that touches one that stands";
}

TEST(HangingParts, AreNotThoseInTheClayOfOthers) {
  const TriangleMesh hollow = together(cube(20), moved(inverted(cube(10)), {5, 5, 5}));
  EXPECT_FALSE(hanging(hollow)) << "a cavity";
  expect_hanging(together(hollow, moved(cube(4), {8, 8, 8})), 1, 2, 8.0);  // loose in it
  EXPECT_FALSE(hanging(together(cube(20), moved(cube(4), {8, 8, 8})))) << "filled by a slicer";
  // The same where other shells intersect.
  const TriangleMesh crossing = together(hollow, moved(cube(10), {15, 5, 5}));
  EXPECT_FALSE(hanging(crossing));
  EXPECT_FALSE(hanging(together(crossing, moved(cube(2), {1, 1, 8}))));
  EXPECT_TRUE(hanging(together(crossing, moved(cube(2), {30, 1, 8}))));
}

TEST(HangingParts, AreNotSoughtWhereTheClayIsUnknown) {
  const TriangleMesh mesh = together(cube(10), moved(cube(4), {0, 0, 12}));
  EXPECT_FALSE(hanging(inverted(mesh)));
  TriangleMesh open = mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(hanging(open));
}

TEST(HangingParts, AreCountedInCrowds) {
  // 20 x 20 columns of 50 cubes; the lowest of each column stands.
  const TriangleMesh one = cube(1);
  TriangleMesh crowd;
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 place{2 * (i % 20), 2 * (i / 20 % 20), 2 * (i / 400)};
    const auto offset = static_cast<std::uint32_t>(crowd.points.size());
    for (const glm::dvec3& p : one.points) crowd.points.push_back(p + place);
    for (const auto& [a, b, c] : one.triangles)
      crowd.triangles.push_back({offset + a, offset + b, offset + c});
  }
  expect_hanging(crowd, 19'600, 20'000, 2.0);
}

}  // namespace
}  // namespace clay::solid
