#include "export/repair/crack_welding.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace clay::solid {
namespace {

/// The mesh with separate corners for every triangle.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t v : t) soup.points.push_back(mesh.points[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

/// A strip of 1,000 squares of 0.1 mm: a thousandth of its length would be 0.1 mm.
TEST(CrackWelding, WeldsCracksOfAQuarterOfTheShortestEdge) {
  TriangleMesh strip;
  for (std::uint32_t i = 0; i <= 1000; ++i) {
    strip.points.emplace_back(0.1 * i, 0.0, 0.0);
    strip.points.emplace_back(0.1 * i, 0.1, 0.0);
    if (i == 0) continue;
    const std::uint32_t v = 2 * i - 2;
    strip.triangles.push_back({v, v + 2, v + 3});
    strip.triangles.push_back({v, v + 3, v + 1});
  }
  EXPECT_NEAR(open_border(soup_of(strip), std::nullopt).crack_mm, 0.025, 1e-9);
  EXPECT_EQ(open_border(soup_of(strip), 0.04).crack_mm, 0.04);
}

/// A ball is large enough for its cracks to be a thousandth of its size.
TEST(CrackWelding, WeldsCracksOfAtMostAThousandthOfTheSize) {
  const TriangleMesh soup = soup_of(shapes::ball(10.0));
  EXPECT_NEAR(open_border(soup, std::nullopt).crack_mm, 1e-3 * glm::length(extent_of(soup).size()),
              1e-12);
}

/// One triangle that is almost a line leaves the cracks of a large mesh as wide as they were.
TEST(CrackWelding, ASliverDoesNotNarrowTheCracks) {
  TriangleMesh soup = soup_of(shapes::ball(10.0));
  const double crack_mm = open_border(soup, std::nullopt).crack_mm;
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), {{1, 1, 5}, {1.0001, 1, 5}, {2, 2, 5}});
  soup.triangles.push_back({first, first + 1, first + 2});
  EXPECT_NEAR(open_border(soup, std::nullopt).crack_mm, crack_mm, 0.1 * crack_mm);
}

}  // namespace
}  // namespace clay::solid
