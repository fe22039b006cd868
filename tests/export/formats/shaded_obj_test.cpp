#include "export/formats/shaded_obj.hpp"

#include "claystack/export/formats.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace clay::solid {
namespace {

struct Corner {
  glm::dvec3 point, normal;
};

/// The decoder ignores normals, so the text is parsed here.
std::vector<Corner> corners_in(const std::string& obj) {
  std::vector<glm::dvec3> points, normals;
  std::vector<Corner> corners;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    glm::dvec3 v;
    if (keyword == "v" || keyword == "vn") {
      words >> v.x >> v.y >> v.z;
      (keyword == "v" ? points : normals).push_back(v);
    } else if (keyword == "f") {
      for (int i = 0; i < 3; ++i) {
        std::size_t point = 0, normal = 0;
        char slash = 0;
        words >> point >> slash >> slash >> normal;
        corners.push_back({points.at(point - 1), normals.at(normal - 1)});
      }
    }
  }
  return corners;
}

std::vector<Corner> shaded(const Profile& profile, std::size_t segments) {
  const RevolveLayout rule(profile, segments);
  const TriangleMesh mesh = revolve(rule);
  const std::string obj = encode_shaded_obj(rule, mesh, "pot");
  EXPECT_EQ(decode_obj(obj, "pot").value(), rounded_to_float(mesh));
  return corners_in(obj);
}

TEST(ShadedObj, CylinderHasARoundWallAndFlatEnds) {
  const auto corners = shaded({{{{20, 0}, {20, 30}, {0, 30}, {0, 0}}}}, 16);
  ASSERT_EQ(corners.size(), 3u * 16 * 4);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const bool wall = corners[i].point.z != corners[i + 1].point.z ||
                      corners[i].point.z != corners[i + 2].point.z;
    for (std::size_t c = i; c < i + 3; ++c) {
      const auto& [p, n] = corners[c];
      const glm::dvec3 expected =
          wall ? glm::normalize(glm::dvec3(p.x, p.y, 0)) : glm::dvec3(0, 0, p.z > 0 ? 1 : -1);
      EXPECT_LT(glm::distance(n, expected), 1e-6);
    }
  }
}

TEST(ShadedObj, BallIsSmoothEverywhere) {
  Polygon half;
  for (int i = 0; i <= 24; ++i) {
    const double angle = std::numbers::pi * i / 24;
    half.push_back({i % 24 == 0 ? 0.0 : 10.0 * std::sin(angle), -10.0 * std::cos(angle)});
  }
  for (const auto& [p, n] : shaded({{half}}, 32)) {
    if (std::hypot(p.x, p.y) < 0.1) continue;  // at the poles each facet has its own
    EXPECT_LT(glm::distance(n, glm::normalize(p)), 2e-3);
  }
}

TEST(ShadedObj, NormalsOfABorePointToTheAxis) {
  const Profile tube{{{{20, 0}, {20, 30}, {15, 30}, {15, 0}}}};
  for (const auto& [p, n] : shaded(tube, 12)) {
    const double radius = std::hypot(p.x, p.y);
    if (std::abs(n.z) > 0.5) continue;
    EXPECT_NEAR((n.x * p.x + n.y * p.y) / radius, radius > 17 ? 1.0 : -1.0, 1e-6);
  }
}

}  // namespace
}  // namespace clay::solid
