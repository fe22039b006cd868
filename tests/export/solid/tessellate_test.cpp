#include "claystack/export/solid.hpp"

#include "claystack/export/proof.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace clay::solid {
namespace {

using shapes::stack_of;
constexpr double kPi = std::numbers::pi;

Profile profile_from(double h, const std::vector<shapes::Radii>& radii) {
  return profile_of(stack_of(h, radii)).value().profile;
}

/// V - E + F, with independently counted edges: 2 for each sphere, 0 for each torus.
long euler(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) edges.insert(std::minmax(t[c], t[(c + 1) % 3]));
  return static_cast<long>(mesh.points.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(mesh.triangles.size());
}

TEST(Revolve, CylinderHasTheVolumeOfTheCircleForAnyNumberOfSegments) {
  for (const std::size_t n : {3u, 4u, 5u, 17u, 64u, 1000u}) {
    const TriangleMesh mesh = revolve(profile_from(4.0, {{10, 0}}), n);
    EXPECT_EQ(mesh.points.size(), 2 * n + 2);
    EXPECT_EQ(mesh.triangles.size(), 4 * n);
    EXPECT_NEAR(signed_volume(mesh) / (kPi * 100 * 4), 1.0, 1e-14) << n;
  }
}

TEST(Revolve, HasZUp) {
  const TriangleMesh mesh = revolve(profile_from(4.0, {{10, 0}}), 8);
  double low = 1e9, high = -1e9;
  for (const glm::dvec3& p : mesh.points) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_EQ(low, 0.0);
  EXPECT_EQ(high, 4.0);
}

TEST(Revolve, HasTheEulerCharacteristicOfEachTopology) {
  EXPECT_EQ(euler(revolve(profile_from(1, {{9, 0}, {9, 5}}), 12)), 2);          // cup: a sphere
  EXPECT_EQ(euler(revolve(profile_from(1, {{9, 4}, {9, 5}}), 12)), 0);          // tube: a torus
  EXPECT_EQ(euler(revolve(profile_from(1, {{9, 0}, {9, 5}, {9, 0}}), 12)), 4);  // two spheres
  EXPECT_EQ(euler(revolve(profile_from(1, {{9, 0}, {9, 5}, {9, 0}, {9, 5}, {9, 0}}), 12)), 6);
  EXPECT_EQ(euler(revolve(profile_from(1, {{3, 0}, {9, 5}, {3, 0}}), 12)), 4);  // three pieces
}

TEST(Revolve, CavityIsAnInwardShell) {
  const TriangleMesh mesh = revolve(profile_from(2, {{9, 0}, {9, 5}, {9, 0}}), 16);
  const MeshReport report = check_mesh(mesh).value();
  EXPECT_TRUE(report.sound());
  EXPECT_EQ(report.components, 2u);
  EXPECT_NEAR(report.volume_mm3, kPi * (81 * 6 - 25 * 2), 1e-9);
}

TEST(Revolve, CollinearPointsOnTheAxisMakeNoPole) {
  const Profile profile{{{{2, 0}, {2, 3}, {0, 3}, {0, 2}, {0, 1}, {0, 0}}}};
  const TriangleMesh mesh = revolve(profile, 8);
  EXPECT_EQ(mesh.points.size(), 2u * 8 + 2);
  EXPECT_TRUE(check_mesh(mesh).value().sound());
}

TEST(Revolve, IsExactlySymmetricWithoutMinusZero) {
  for (const std::size_t n : {8u, 12u, 20u, 28u}) {
    const TriangleMesh mesh = revolve({{{{7.3, -0.0}, {7.3, 1.0}, {2.1, 1.0}, {2.1, -0.0}}}}, n);
    std::set<std::pair<double, double>> places;
    for (const glm::dvec3& p : mesh.points) {
      places.emplace(p.x, p.y);
      for (const double x : {p.x, p.y, p.z}) EXPECT_FALSE(x == 0.0 && std::signbit(x));
    }
    for (const auto& [x, y] : places) {
      EXPECT_TRUE(places.count({-x, y})) << n;
      EXPECT_TRUE(places.count({x, -y})) << n;
      EXPECT_TRUE(places.count({y, x})) << n;
    }
  }
}

TEST(Revolve, IsCounterclockwiseSeenFromAbove) {
  const TriangleMesh mesh = revolve(profile_from(1.0, {{5, 2}}), 12);
  for (std::size_t s = 0; s < 12; ++s) {
    const double angle = std::atan2(mesh.points[s].y, mesh.points[s].x);
    EXPECT_NEAR(std::remainder(angle - 2 * kPi * static_cast<double>(s) / 12, 2 * kPi), 0.0, 1e-14);
  }
}

TEST(ChordalError, EqualsTheDistanceBetweenCircleAndPolygon) {
  for (const std::size_t n : {3u, 8u, 100u}) {
    const TriangleMesh mesh = revolve(profile_from(1.0, {{10, 2}}), n);
    const glm::dvec3 a = mesh.points[0], b = mesh.points[1];
    const double vertex = std::hypot(a.x, a.y) - 10.0;
    const double middle = 10.0 - std::hypot(0.5 * (a.x + b.x), 0.5 * (a.y + b.y));
    EXPECT_NEAR(chordal_error_mm(10.0, n), std::max(vertex, middle), 1e-13);
  }
}

RC_GTEST_PROP(SegmentsFor, IsTheMinimumWithinTheTolerance, ()) {
  const double radius = *rc::gen::inRange(1, 5000000) * 1e-3;
  const double tolerance = std::pow(10.0, -*rc::gen::inRange(0, 50) / 10.0);
  const std::size_t n = segments_for(radius, tolerance);
  RC_ASSERT(n >= 8u);
  RC_ASSERT(n % 4 == 0u);
  RC_ASSERT(chordal_error_mm(radius, n) <= tolerance);
  RC_ASSERT(n == 8u || chordal_error_mm(radius, n - 4) > tolerance);
}

TEST(SegmentsFor, StopsAtTheLimit) {
  EXPECT_EQ(segments_for(10.0, 0.0), kMaxSegments);
  EXPECT_EQ(segments_for(10.0, -1.0), kMaxSegments);
  EXPECT_EQ(segments_for(10.0, std::nan("")), kMaxSegments);
}

RC_GTEST_PROP(Revolve, CertifiedStacksGiveSoundSolidsOfEqualVolume, (const ClayStack& stack)) {
  const auto found = profile_of(stack);
  if (!found || !certify(found->profile)) RC_DISCARD("no certificate");
  const auto segments = *rc::gen::inRange<std::size_t>(3, 24);
  const TriangleMesh mesh = revolve(found->profile, segments);
  RC_ASSERT(mesh.triangles.size() == triangle_count(found->profile, segments));

  const MeshReport report = check_mesh(mesh).value();
  RC_ASSERT(report.sound());
  std::size_t shells = 0;
  long genus0 = 0;
  for (const PieceShape& shape : found->shapes) {
    shells += 1 + shape.cavities.size();
    genus0 += (shape.topology == Topology::tube ? 0 : 1) + static_cast<long>(shape.cavities.size());
  }
  RC_ASSERT(report.components == shells);
  RC_ASSERT(euler(mesh) == 2 * genus0);

  const double rounding = shapes::volume_rounding(stack);
  RC_ASSERT(std::abs(report.volume_mm3 - volume_of(found->profile)) <= rounding);
  RC_ASSERT(std::abs(report.volume_mm3 - stack.volume_mm3()) <= rounding);
}

TEST(Revolve, BigPotKeepsItsVolume) {
  const ClayStack stack = shapes::vase(2000);
  const TriangleMesh mesh = revolve(profile_of(stack)->profile, 256);
  EXPECT_NEAR(signed_volume(mesh) / stack.volume_mm3(), 1.0, 1e-12);
}

}  // namespace
}  // namespace clay::solid
