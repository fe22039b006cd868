#include "export/repair/crack_welding.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace clay::solid {
namespace {

/// Every triangle with corners of its own.
TriangleMesh soup_of(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (const std::uint32_t v : t) soup.points.push_back(mesh.points[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(CrackWelding, WeldsCracksOfAQuarterOfTheShortestEdge) {
  const TriangleMesh soup = soup_of(shapes::cube(10.0));
  const OpenBorder border = open_border(soup, std::nullopt);
  const double edge_mm = glm::distance(soup.points[0], soup.points[1]);
  EXPECT_LE(border.crack_mm, 0.25 * edge_mm);
  EXPECT_GT(border.crack_mm, border.rounding_mm);
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
