#include "export/proof/revolve_match.hpp"

#include "claystack/export/formats.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <random>
#include <string>
#include <utility>

namespace clay::solid {
namespace {

constexpr double kReach = 1e-3;

Profile vase_profile() { return profile_of(shapes::vase(20))->profile; }

::testing::AssertionResult refused(const TriangleMesh& mesh, const RevolveLayout& rule,
                                   const std::string& because) {
  const auto matched = match_revolve(mesh, rule, kReach, MeshFormat::stl_binary, "file");
  if (matched) return ::testing::AssertionFailure() << "was accepted";
  if (matched.error().message.find(because) == std::string::npos)
    return ::testing::AssertionFailure() << matched.error().message;
  return ::testing::AssertionSuccess();
}

/// The same surface with points and triangles in another order, and rotated triangles.
TriangleMesh shuffled(const TriangleMesh& mesh, std::mt19937& random) {
  std::vector<std::uint32_t> place(mesh.points.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), random);
  TriangleMesh result{std::vector<glm::dvec3>(mesh.points.size()), mesh.triangles};
  for (std::size_t i = 0; i < place.size(); ++i) result.points[place[i]] = mesh.points[i];
  for (auto& t : result.triangles) {
    for (auto& v : t) v = place[v];
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
  }
  std::shuffle(result.triangles.begin(), result.triangles.end(), random);
  return result;
}

RC_GTEST_PROP(MatchRevolve, MatchesTheSolidInAnyOrder, (const ClayStack& stack, unsigned seed)) {
  const auto section = profile_of(stack, 0.01);
  if (!section || !certify(section->profile)) return;
  const RevolveLayout rule(section->profile, *rc::gen::inRange<std::size_t>(8, 30));
  std::mt19937 random(seed);
  TriangleMesh mesh = shuffled(revolve(rule), random);
  const auto exact = match_revolve(mesh, rule, 1e-9, MeshFormat::stl_binary, "file");
  // Walls may be thinner than the reach: then another vertex may be as near.
  if (!exact) return;
  RC_ASSERT(*exact == 0.0);
  std::swap(mesh.triangles.front()[0], mesh.triangles.front()[1]);
  RC_ASSERT(!match_revolve(mesh, rule, 1e-9, MeshFormat::stl_binary, "file"));
}

TEST(MatchRevolve, MeasuresTheFarthestPoint) {
  const RevolveLayout rule(vase_profile(), 24);
  TriangleMesh mesh = revolve(rule);
  mesh.points[7] += glm::dvec3(0.0, 3e-4, 4e-4);
  EXPECT_NEAR(match_revolve(mesh, rule, kReach, MeshFormat::stl_binary, "file").value(), 5e-4,
              1e-12);
}

TEST(MatchRevolve, ReportsDifferencesFromTheSolid) {
  const RevolveLayout rule(vase_profile(), 24);
  const TriangleMesh good = revolve(rule);
  TriangleMesh bad = good;
  bad.points[3].z += 2.0 * kReach;
  EXPECT_TRUE(refused(bad, rule, "point 4: expected a vertex of the solid"));
  bad = good;
  bad.triangles[5] = bad.triangles[6];
  EXPECT_TRUE(refused(bad, rule, "triangle 7"));
  bad = good;
  std::swap(bad.triangles[8][0], bad.triangles[8][1]);
  EXPECT_TRUE(refused(bad, rule, "triangle 9"));
  bad = good;
  bad.triangles.pop_back();
  EXPECT_TRUE(refused(bad, rule, "triangles, found"));
  bad = good;
  bad.points.push_back(bad.points.front());
  EXPECT_TRUE(refused(bad, rule, "points, found"));
}

TEST(MatchRevolve, RefusesTheOtherDiagonal) {
  // Flat quads may have either diagonal, but files use one, and an edge with both diagonals is
  // open.
  const RevolveLayout rule(vase_profile(), 24);
  TriangleMesh mesh = revolve(rule);
  const auto shared = std::find_if(mesh.triangles.begin() + 1, mesh.triangles.end(),
                                   [&](const auto& t) { return t[0] == mesh.triangles[0][0]; });
  const std::uint32_t next = mesh.triangles[0][1], up = (*shared)[2];
  mesh.triangles[0] = {mesh.triangles[0][0], next, up};
  *shared = {next, (*shared)[1], up};
  EXPECT_FALSE(match_revolve(mesh, rule, kReach, MeshFormat::stl_binary, "file"));
}

TEST(MatchRevolve, RefusesAnotherNumberOfSegments) {
  EXPECT_FALSE(match_revolve(revolve(RevolveLayout(vase_profile(), 24)),
                             RevolveLayout(vase_profile(), 25), kReach, MeshFormat::stl_binary,
                             "file"));
}

}  // namespace
}  // namespace clay::solid
