#include "claystack/export/profile_smoothing.hpp"

#include "claystack/export/certificate.hpp"
#include "claystack/export/wall_thickness.hpp"
#include "engine/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace clay::solid {
namespace {

ClayStack stack_of(double h, const std::vector<std::pair<double, double>>& radii,
                   Quanta crown = 0) {
  std::vector<Ring> rings;
  for (const auto& [outer, inner] : radii)
    rings.push_back({quanta_from_radius(outer), quanta_from_radius(inner)});
  return ClayStack::from_rings(h, std::move(rings), crown).value();
}

TEST(ProfileSmoothing, AStraightPotStaysARectangle) {
  const auto section =
      smooth_profile_of(ClayStack::cylinder(100, 1.0, 40, 30, 100).value(), 0.02).value();
  ASSERT_EQ(section.profile.pieces.size(), 1u);
  ASSERT_EQ(section.profile.pieces[0].size(), 4u);
  EXPECT_NEAR(section.profile.pieces[0][0].rho, 40.0, 1e-9);
  EXPECT_NEAR(section.profile.pieces[0][3].rho, 30.0, 1e-9);
}

TEST(ProfileSmoothing, AConeInStepsBecomesACone) {
  std::vector<std::pair<double, double>> radii;
  for (int i = 0; i < 100; ++i) radii.emplace_back(20.0 + 0.3 * (i + 0.5), 0.0);
  const auto polygon = smooth_profile_of(stack_of(1.0, radii), 0.02).value().profile.pieces.at(0);
  EXPECT_LE(polygon.size(), 6u);  // two on the axis, and the half rings at both ends
  for (const ProfilePoint& p : polygon) {
    if (p.rho > 0.0 && p.y > 1.0 && p.y < 99.0) {
      EXPECT_NEAR(p.rho, 20.0 + 0.3 * p.y, 0.02);
    }
  }
}

TEST(ProfileSmoothing, FloorsAndLidsStayWhereTheyAre) {
  std::vector<std::pair<double, double>> radii(30, {40.0, 25.0});
  for (const int i : {0, 1, 2, 3, 27, 28, 29}) radii[static_cast<std::size_t>(i)].second = 0.0;
  const auto section = smooth_profile_of(stack_of(1.5, radii), 0.02).value();
  ASSERT_EQ(section.shapes.at(0).topology, Topology::cavity);
  EXPECT_NEAR(min_wall_mm(section.profile), 3 * 1.5, 1e-12);
  const auto certificate = certify(section.profile).value();
  EXPECT_EQ(certificate.axis_segments, 2u);
}

RC_GTEST_PROP(ProfileSmoothing, KeepsTheClayOfEveryPiece, ()) {
  auto random = *samples::random_engine();
  const auto count = *rc::gen::inRange<std::size_t>(1, 60);
  const double tolerance = *rc::gen::element(1e-6, 0.02, 0.5);
  const ClayStack stack = samples::stack(random, count, 0.7);
  const auto section = smooth_profile_of(stack, tolerance);
  RC_PRE(section.has_value());
  for (std::size_t k = 0; k < section->shapes.size(); ++k) {
    WideQuanta counted = 0;
    for (std::size_t i = section->shapes[k].first_ring; i <= section->shapes[k].last_ring; ++i)
      counted += stack.rings()[i].volume();
    const double expected = static_cast<double>(counted) * stack.mm3_per_quantum();
    // Relative to what is turned, since a thin wall is a difference of large volumes.
    const double turned = M_PI * 60.0 * 60.0 * 0.7 * static_cast<double>(count);
    RC_ASSERT(std::abs(volume_of({{section->profile.pieces[k]}}) - expected) < 1e-12 * turned);
  }
}

/// A pot as potters make them: walls that change slowly, 2 mm at least.
ClayStack pot(std::mt19937_64& random, std::size_t count, double h) {
  std::vector<std::pair<double, double>> radii;
  double outer = 40.0, slope = 0.0, wall = 5.0;
  for (std::size_t i = 0; i < count; ++i) {
    slope = std::clamp(slope + 0.2 * (samples::uniform(random) - 0.5), -1.0, 1.0);
    outer = std::clamp(outer + slope * h, 20.0, 80.0);
    wall = std::clamp(wall + 0.3 * (samples::uniform(random) - 0.5), 2.0, 8.0);
    radii.emplace_back(outer, i < 6 ? 0.0 : outer - wall);
  }
  return stack_of(h, radii);
}

RC_GTEST_PROP(ProfileSmoothing, IsCertifiedAndThinsNoWallBeyondTheTolerance, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = pot(random, *rc::gen::inRange<std::size_t>(10, 300), 0.5);
  const double tolerance = *rc::gen::element(0.001, 0.02, 0.1);
  const auto section = smooth_profile_of(stack, tolerance).value();
  RC_ASSERT(certify(section.profile).has_value());
  double thinnest = 1e300;  // along the radius
  for (const Ring& ring : stack.rings())
    if (ring.inner2 > 0) thinnest = std::min(thinnest, ring.outer_mm() - ring.inner_mm());
  const double floor = 6 * 0.5;
  // Walls lean by about 45 degrees at most: across, they are cos 45 of what they are along the
  // radius.
  RC_ASSERT(min_wall_mm(section.profile) >
            std::min(floor, thinnest * std::sqrt(0.5)) - 2.0 * tolerance);
}

RC_GTEST_PROP(ProfileSmoothing, StaysWithinTheToleranceOfTheMiddles, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = pot(random, 200, 0.5);
  const double tolerance = *rc::gen::element(0.01, 0.05);
  const auto polygon = smooth_profile_of(stack, tolerance).value().profile.pieces.at(0);
  // Outer wall: the rising edges. At the middle of every ring it is within the tolerance of R.
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const double y = (static_cast<double>(i) + 0.5) * 0.5;
    for (std::size_t k = 0; k + 1 < polygon.size(); ++k) {
      const ProfilePoint &a = polygon[k], &b = polygon[k + 1];
      if (!(a.y <= y && y < b.y)) continue;
      const double rho = a.rho + (b.rho - a.rho) * (y - a.y) / (b.y - a.y);
      // Half of the tolerance across a slope of 45 degrees, and what the scale adds.
      RC_ASSERT(std::abs(rho - stack.rings()[i].outer_mm()) < tolerance);
    }
  }
}

}  // namespace
}  // namespace clay::solid
