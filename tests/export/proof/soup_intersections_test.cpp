#include "export/proof/soup_intersections.hpp"

#include "export/solid/bounded_volume.hpp"
#include "tests/export/solid/shapes.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using shapes::cube;
using shapes::inverted;
using shapes::moved;
using shapes::together;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Pairs by CGAL's test of whole meshes, lower number first, ascending.
std::vector<Pair> pairs_by_cgal(const TriangleMesh& mesh) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> points;
  for (const glm::dvec3& p : mesh.points) points.emplace_back(p.x, p.y, p.z);
  CGAL::Surface_mesh<Point> surface;
  pmp::polygon_soup_to_polygon_mesh(points, mesh.triangles, surface);
  using Face = CGAL::Surface_mesh<Point>::Face_index;
  std::vector<std::pair<Face, Face>> faces;
  pmp::self_intersections(surface, std::back_inserter(faces));
  std::vector<Pair> pairs;
  for (const auto& [a, b] : faces)
    pairs.emplace_back(std::min<std::uint32_t>(a, b), std::max<std::uint32_t>(a, b));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Parts in reverse order, because the order must not matter.
Fault found_in_slabs(const TriangleMesh& mesh, std::size_t fewest_slabs) {
  SoupIntersections search(mesh);
  EXPECT_GE(search.slabs(), fewest_slabs);
  for (std::size_t part = search.parts(); part > 0; --part) search.search(part - 1);
  return search.found();
}

void expect_same_as_cgal(const TriangleMesh& mesh, std::size_t fewest_slabs) {
  const std::vector<Pair> expected = pairs_by_cgal(mesh);
  ASSERT_FALSE(expected.empty());
  ASSERT_LT(expected.size(), kMaxSelfIntersections);
  const Fault fault = found_in_slabs(mesh, fewest_slabs);
  EXPECT_EQ(fault.count, expected.size());
  ASSERT_EQ(fault.triangles.size(), 2u);
  EXPECT_EQ(Pair(fault.triangles[0], fault.triangles[1]), expected.front());
}

TriangleMesh vase(std::size_t rings, std::size_t segments) {
  return revolve(profile_of(shapes::vase(rings))->profile, segments);
}

TEST(SoupIntersections, MatchCgalOnCrossingVases) {
  // Intersecting along the whole height, so that pairs also lie on the borders of slabs.
  const TriangleMesh one = vase(60, 140);
  expect_same_as_cgal(together(one, moved(one, {1.1, 0.7, 0.3})), 3);
}

TEST(SoupIntersections, CountTrianglesAcrossManySlabsOnce) {
  // Staves as long as the prism, beside a fine vase that determines the slabs.
  const TriangleMesh staves = revolve({{{{0, -20}, {52, -20}, {52, 230}, {0, 230}}}}, 90);
  expect_same_as_cgal(together(vase(100, 100), staves), 2);
}

TEST(SoupIntersections, ListsStayShortForLongTriangles) {
  // Parallel staves, half as long as the whole set: with six slabs, each would be in three or four
  // of the lists.
  constexpr std::uint32_t kStaves = 200'000;
  TriangleMesh staves;
  for (std::uint32_t i = 0; i < kStaves; ++i) {
    const double x = 0.005 * i, z = 0.005 * (i * 7919U % kStaves);
    staves.points.insert(staves.points.end(), {{x, 0, z}, {x + 0.002, 0, z}, {x, 0, z + 1000}});
    staves.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  SoupIntersections search(staves);
  EXPECT_LE(search.slabs(), 3u);
  for (std::size_t part = 0; part < search.parts(); ++part) search.search(part);
  EXPECT_EQ(search.found().count, 0u);
}

TEST(SoupIntersections, FindNoneInAFineVase) {
  EXPECT_EQ(found_in_slabs(vase(60, 200), 2).count, 0u);
}

TEST(BoundedVolume, SignIsCertainOnlyBeyondTheError) {
  EXPECT_TRUE(bounded_volume(cube(2.0)).sign_is_certain());
  EXPECT_TRUE(bounded_volume(moved(inverted(cube(1e-3)), {1e3, 1e3, 1e3})).sign_is_certain());
  // Flat: zero volume.
  TriangleMesh flat = cube(2.0);
  for (glm::dvec3& p : flat.points) p.z = 0.1 * p.x + 0.3 * p.y;
  EXPECT_FALSE(bounded_volume(flat).sign_is_certain());
  EXPECT_FALSE(bounded_volume({}).sign_is_certain());
  // A needle far from its first point, thinner than the digits there resolve.
  TriangleMesh far = moved(cube(1e-9), {1e6, 1e6, 1e6});
  far.points.insert(far.points.begin(), {0, 0, 0});
  for (auto& t : far.triangles)
    for (auto& v : t) ++v;
  EXPECT_FALSE(bounded_volume(far).sign_is_certain());
}

RC_GTEST_PROP(BoundedVolume, ErrorIsWithinTheBound, ()) {
  // Tetrahedra on a grid have a volume that 64-bit integers represent exactly; the translation
  // costs digits.
  const auto coordinate = rc::gen::inRange<std::int64_t>(-1000, 1001);
  std::array<std::array<std::int64_t, 3>, 4> corners{};
  for (auto& corner : corners)
    for (auto& x : corner) x = *coordinate;
  const auto edge = [&](std::size_t i, std::size_t axis) {
    return corners[i][axis] - corners[0][axis];
  };
  std::int64_t sextuple = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sextuple += edge(1, i) * (edge(2, (i + 1) % 3) * edge(3, (i + 2) % 3) -
                              edge(2, (i + 2) % 3) * edge(3, (i + 1) % 3));
  TriangleMesh mesh{{{0.0, 0.0, 0.0}}, {{1, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}}};
  const double far = static_cast<double>(*rc::gen::inRange(0, 1 << 20));
  for (const auto& c : corners)
    mesh.points.emplace_back(static_cast<double>(c[0]) + far, static_cast<double>(c[1]) - far,
                             static_cast<double>(c[2]) + far);
  const SignedVolume volume = bounded_volume(mesh);
  const double exact = static_cast<double>(sextuple) / 6.0;
  RC_ASSERT(std::abs(volume.mm3 - exact) <= volume.error_mm3 + 1e-15 * std::abs(exact));
  if (volume.sign_is_certain()) RC_ASSERT((volume.mm3 > 0.0) == (sextuple > 0));
}

}  // namespace
}  // namespace clay::solid
