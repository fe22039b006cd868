#include "export/proof/verify_file.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

std::vector<std::pair<MeshFormat, std::string>> encoded(const TriangleMesh& mesh) {
  std::vector<std::pair<MeshFormat, std::string>> files{
      {MeshFormat::stl_binary, encode_stl_binary(mesh)},
      {MeshFormat::stl_ascii, encode_stl_ascii(mesh, "ball")},
      {MeshFormat::obj, encode_obj(mesh, "ball")}};
#ifdef CLAYSTACK_DRACO
  files.emplace_back(MeshFormat::drc, encode_drc(mesh, {0.001, 8, 3}).value());
#endif
  return files;
}

::testing::AssertionResult refused(const Result<double>& result, const std::string& because) {
  if (result) return ::testing::AssertionFailure() << "was accepted";
  if (result.error().message.find(because) == std::string::npos)
    return ::testing::AssertionFailure() << result.error().message;
  return ::testing::AssertionSuccess();
}

TEST(VerifyFile, MeasuresTheLargestMove) {
  const TriangleMesh ball = shapes::ball(8.0);
  TriangleMesh dented = ball;
  dented.points[5].z += 0.25;
  for (const auto& [format, bytes] : encoded(dented)) {
    const auto moved = verify_file(bytes, format, ball, kAnyDistance);
    ASSERT_TRUE(moved) << moved.error().message;
    EXPECT_NEAR(*moved, 0.25, 0.0011);
    EXPECT_TRUE(refused(verify_file(bytes, format, ball, 0.2), "of their places"));
  }
}

TEST(VerifyFile, DetectsEveryMissingTriangle) {
  const TriangleMesh ball = shapes::ball(8.0);
  TriangleMesh holed = ball;
  holed.triangles.pop_back();
  for (const auto& [format, bytes] : encoded(holed)) {
    EXPECT_TRUE(refused(verify_file(bytes, format, ball, kAnyDistance), "triangles, found"));
    EXPECT_TRUE(refused(verify_file(bytes, format, holed, kAnyDistance), "found"));
  }
}

TEST(VerifyFile, RefusesInvalidBytes) {
  EXPECT_FALSE(verify_file("pot", MeshFormat::stl_binary, shapes::ball(8.0), kAnyDistance));
}

TEST(FloatRounding, BoundsTheDisplacementByFloat32) {
  const TriangleMesh mesh = shapes::moved(shapes::ball(8.0), {1000.1, -2000.7, 3000.3});
  const TriangleMesh rounded = rounded_to_float(mesh);
  double largest = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    largest = std::max(largest, glm::distance(mesh.points[i], rounded.points[i]));
  EXPECT_GT(largest, 0.0);
  EXPECT_LE(largest, float_rounding_mm(mesh));
}

}  // namespace
}  // namespace clay::solid
