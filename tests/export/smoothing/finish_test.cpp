// Foot rings, fillets of the floor and set-backs for glaze, against closed forms and distances.

#include "claystack/export/proof.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/walls.hpp"
#include "tests/export/smoothing/smoothing_stacks.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

namespace clay::solid {
namespace {

using std::numbers::pi;

constexpr double kTolerance = 1e-4;

/// Outside radius 40 mm, bore 34 mm, 60 mm high, floor of 8 mm.
Profile cup() { return {{{{0, 0}, {40, 0}, {40, 60}, {34, 60}, {34, 8}, {0, 8}}}}; }

/// The same with an outside that grows from 30 mm at the foot by half a mm for each mm of height.
Profile flaring() { return {{{{0, 0}, {30, 0}, {60, 60}, {54, 60}, {28, 8}, {0, 8}}}}; }

Finish foot(double width_mm, double depth_mm, std::optional<double> diameter_mm = {}) {
  Finish finish;
  finish.foot = FootRing{width_mm, depth_mm, diameter_mm};
  return finish;
}
Finish fillet(double radius_mm) { return {{}, radius_mm, 0.0}; }
Finish glaze(double mm) { return {{}, 0.0, mm}; }

FinishedProfile made(const Profile& profile, const Finish& finish) {
  auto result = finished(profile, finish, {}, kTolerance);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  if (!result) return {profile, {}};
  EXPECT_TRUE(certify(result->profile));
  const double change = volume_of(result->profile) - volume_of(profile);
  EXPECT_NEAR(change, result->ledger.floor_added_mm3 - result->ledger.trimmed_mm3(), 1e-6);
  return *result;
}

TEST(FootRing, AsWideAsTheFootTrimsADisc) {
  const FinishedProfile ring = made(cup(), foot(6, 4));
  EXPECT_NEAR(ring.ledger.foot_trimmed_mm3, pi * 34.0 * 34.0 * 4.0, 1e-8);
  EXPECT_EQ(ring.ledger.floor_added_mm3, 0.0);
  const Polygon expected{{34, 4}, {34, 0}, {40, 0}, {40, 60}, {34, 60}, {34, 8}, {0, 8}, {0, 4}};
  EXPECT_EQ(ring.profile.pieces.at(0), expected);
}

TEST(FootRing, WithADiameterTrimsInsideAndOutside) {
  const FinishedProfile ring = made(cup(), foot(6, 4, 60.0));
  EXPECT_NEAR(ring.ledger.foot_trimmed_mm3, pi * 4.0 * (40.0 * 40.0 - (30.0 * 30.0 - 24.0 * 24.0)),
              1e-8);
}

TEST(FootRing, OfAFlaringPotTrimsAFrustum) {
  const FinishedProfile ring = made(flaring(), foot(5, 3, 50.0));
  const double frustum = pi * 3.0 / 3.0 * (30.0 * 30.0 + 30.0 * 31.5 + 31.5 * 31.5);
  EXPECT_NEAR(ring.ledger.foot_trimmed_mm3, frustum - pi * 3.0 * (25.0 * 25.0 - 20.0 * 20.0), 1e-8);
  const Polygon& section = ring.profile.pieces.at(0);
  EXPECT_NE(std::ranges::find(section, ProfilePoint{31.5, 3}), section.end());
}

TEST(FootRing, RefusesWhatDoesNotFit) {
  const auto expect = [](const Profile& profile, const Finish& finish, const std::string& words) {
    const auto result = finished(profile, finish, {}, kTolerance);
    ASSERT_FALSE(result) << words;
    EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  expect(cup(), foot(6, 8), "depth below 8.00 mm");
  expect(cup(), foot(40, 4), "width below 40.00 mm");
  expect(cup(), foot(6, 4, 81.0), "diameter of at most 80.00 mm");
  expect({{{{34, 0}, {40, 0}, {40, 60}, {34, 60}}}}, foot(2, 1), "expected a solid foot");
  expect({{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{0, 20}, {9, 20}, {9, 29}, {0, 29}}}}, foot(2, 1),
         "expected one piece, found 2");
  // Narrows from 40 to 30 mm within the depth: the ring would end in the air.
  const Profile narrowing{
      {{{0, 0}, {40, 0}, {40, 2}, {30, 2}, {30, 60}, {24, 60}, {24, 8}, {0, 8}}}};
  expect(narrowing, foot(6, 4), "width above 10.00 mm");
  EXPECT_TRUE(finished(narrowing, foot(12, 4), {}, kTolerance));
  EXPECT_TRUE(finished(narrowing, foot(6, 1), {}, kTolerance));
}

TEST(Finish, RefusesNumbersThatAreNoLengths) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto expect = [](const Finish& finish, double tolerance_mm, const std::string& name) {
    const auto result = finished(cup(), finish, {}, tolerance_mm);
    ASSERT_FALSE(result) << name;
    EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
    EXPECT_TRUE(result.error().message.starts_with(name + ": expected ")) << result.error().message;
  };
  for (const double wrong : {kNan, -1.0, kInfinite}) {
    expect(foot(wrong, 4), kTolerance, "foot ring width");
    expect(foot(6, wrong), kTolerance, "foot ring depth");
    expect(foot(6, 4, wrong), kTolerance, "foot ring diameter");
    expect(fillet(wrong), kTolerance, "floor fillet");
    expect(glaze(wrong), kTolerance, "glaze allowance");
    expect(glaze(1), wrong, "tolerance");
  }
  expect(foot(0, 4), kTolerance, "foot ring width");
  expect(glaze(1), 0.0, "tolerance");
}

/// The number after `words` in the message of a refusal.
double named_limit(const Result<FinishedProfile>& refused, const std::string& words) {
  if (refused) throw std::runtime_error("not refused");
  const std::string& message = refused.error().message;
  return std::stod(message.substr(message.find(words) + words.size()));
}

TEST(Finish, TheLimitsOfItsMessagesAreAccepted) {
  for (const double scale : {1.0, 1.00237, 1.00481, 0.99713}) {
    Profile profile = cup();
    for (ProfilePoint& p : profile.pieces.front()) p = {scale * p.rho, scale * p.y};
    const double diameter =
        named_limit(finished(profile, foot(6, 4, 90.0), {}, kTolerance), "diameter of at most ");
    EXPECT_NEAR(diameter, scale * 80.0, 0.01);
    EXPECT_TRUE(finished(profile, foot(6, 4, diameter), {}, kTolerance)) << scale;
    const double radius =
        named_limit(finished(profile, fillet(60), {}, kTolerance), "radius of at most ");
    EXPECT_NEAR(radius, scale * 34.0, 0.015);
    EXPECT_TRUE(finished(profile, fillet(radius), {}, kTolerance)) << scale;
  }
}

TEST(FootRing, KeepsTheMinimumWallAndNamesThePlace) {
  EXPECT_TRUE(finished(cup(), foot(6, 4), 3.9, kTolerance));
  const auto thin = finished(cup(), foot(6, 5), 3.9, kTolerance);
  ASSERT_FALSE(thin);
  EXPECT_EQ(thin.error().kind, ErrorKind::unsound);
  EXPECT_NE(thin.error().message.find("at least 3.90 mm, found 3.00 mm at a height of"),
            std::string::npos)
      << thin.error().message;
  // A pot that was thinner before is not refused for it.
  EXPECT_TRUE(finished(cup(), foot(6.5, 1), 7.0, kTolerance));
}

TEST(FloorFillet, FillsTheCornerByTheClosedForm) {
  for (const double r : {2.0, 10.0, 30.0}) {
    const FinishedProfile round = made(cup(), fillet(r));
    const double centre = 34.0 - r;
    const double added =
        pi * (r * 34.0 * 34.0 - centre * centre * r - centre * pi * r * r / 2 - 2 * r * r * r / 3);
    // The chords are within the tolerance of the arc, in the clay's favour.
    EXPECT_GE(round.ledger.floor_added_mm3, added - 1e-6);
    EXPECT_LE(round.ledger.floor_added_mm3, added + 2 * pi * 34.0 * kTolerance * pi / 2 * r);
    EXPECT_GE(min_wall_mm(round.profile), 6.0 - 1e-9);
  }
}

TEST(FloorFillet, RefusesARadiusThatLeavesNoFloor) {
  const auto wide = finished(cup(), fillet(35), {}, kTolerance);
  ASSERT_FALSE(wide);
  EXPECT_NE(wide.error().message.find("radius of at most 33.99 mm"), std::string::npos)
      << wide.error().message;
  const auto none = finished({{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}}}, fillet(2), {}, kTolerance);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("found none"), std::string::npos) << none.error().message;
}

TEST(GlazeAllowance, SetsBackACupByTheClosedForm) {
  constexpr double g = 1.5;
  const FinishedProfile back = made(cup(), glaze(g));
  const double left = pi * ((40 - g) * (40 - g) * (60 - g) - (34 + g) * (34 + g) * (60 - g - 8) -
                            (34.0 * 34.0 * g + 34.0 * pi * g * g / 2 + 2 * g * g * g / 3));
  const double face = 2 * pi * 40.0 * g;  // of the rounded corner inside
  EXPECT_NEAR(volume_of(back.profile), left, face * kTolerance);
  EXPECT_NEAR(min_wall_mm(back.profile), 6.0 - 2 * g, 1e-3);
  double low = 1e9, high = 0.0, foot_mm = 0.0;
  for (const ProfilePoint& p : back.profile.pieces.at(0)) {
    low = std::min(low, p.y), high = std::max(high, p.y);
    if (p.y == 0.0) foot_mm = std::max(foot_mm, p.rho);
  }
  EXPECT_EQ(low, 0.0);
  EXPECT_NEAR(high, 60 - g, 1e-12);
  EXPECT_NEAR(foot_mm, 40 - g, 1e-12);
}

/// A solid cone with a tip of 0.05 mm: the clay inside its glaze ends lower, where it is 0.1 mm
/// wide.
TEST(GlazeAllowance, ShortensTheTipOfASolid) {
  constexpr double g = 0.5, kHeight = 40.0, kFoot = 20.0, kTip = 0.025;
  const FinishedProfile back =
      made({{{{0, 0}, {kFoot, 0}, {kTip, kHeight}, {0, kHeight}}}}, glaze(g));
  const double lean = (kFoot - kTip) / kHeight;
  const double foot_mm = kFoot - g * std::hypot(1.0, lean);  // the parallel line at the distance
  const double top_mm = (foot_mm - 0.05) / lean;
  double high = 0.0, widest = 0.0, at_top = 0.0;
  for (const ProfilePoint& p : back.profile.pieces.at(0)) {
    high = std::max(high, p.y), widest = std::max(widest, p.rho);
    if (p.y > top_mm - 0.01) at_top = std::max(at_top, p.rho);
  }
  EXPECT_NEAR(high, top_mm, 1e-3);
  EXPECT_NEAR(widest, foot_mm, 1e-3);
  EXPECT_NEAR(at_top, 0.05, 1e-3);
}

TEST(GlazeAllowance, KeepsTheMinimumWall) {
  EXPECT_TRUE(finished(cup(), glaze(1.0), 3.9, kTolerance));
  const auto thin = finished(cup(), glaze(1.1), 3.9, kTolerance);
  ASSERT_FALSE(thin);
  EXPECT_NE(thin.error().message.find("at least 3.90 mm, found 3.80 mm"), std::string::npos)
      << thin.error().message;
  const auto gone = finished(cup(), glaze(3.0), {}, kTolerance);
  ASSERT_FALSE(gone);
  EXPECT_NE(gone.error().message.find("more than 6.00 mm, found 6.00 mm"), std::string::npos)
      << gone.error().message;
}

TEST(Finish, PrintsAWallBelowItsLimitWithDigitsThatDiffer) {
  // Beyond the allowance of 0.1 %, but equal in two decimals.
  const auto thin = finished(cup(), glaze(1.0), 4.0044, kTolerance);
  ASSERT_FALSE(thin);
  EXPECT_NE(thin.error().message.find("at least 4.004 mm, found 4.000 mm"), std::string::npos)
      << thin.error().message;
}

TEST(Finish, KeepsTheDigitsOfSmallSizes) {
  Profile tiny = cup();
  for (ProfilePoint& p : tiny.pieces.front()) p = {1e-3 * p.rho, 1e-3 * p.y};
  const auto wide = finished(tiny, fillet(0.05), {}, 1e-6);
  ASSERT_FALSE(wide);
  const std::string& message = wide.error().message;
  EXPECT_NE(message.find("radius of at most 0.033 mm"), std::string::npos) << message;
  EXPECT_NE(message.find("found 0.05 mm"), std::string::npos) << message;
}

double distance(const ProfilePoint& p, const ProfilePoint& a, const ProfilePoint& b) {
  const double dx = b.rho - a.rho, dy = b.y - a.y;
  const double t =
      std::clamp(((p.rho - a.rho) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(a.rho + t * dx - p.rho, a.y + t * dy - p.y);
}

/// From the nearest face of the profile but the foot and the axis.
double depth_in(const Polygon& section, const ProfilePoint& p) {
  double least = 1e9;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const ProfilePoint &a = section[i], &b = section[(i + 1) % section.size()];
    if ((a.y == 0.0 && b.y == 0.0) || (a.rho == 0.0 && b.rho == 0.0)) continue;
    least = std::min(least, distance(p, a, b));
  }
  return least;
}

RC_GTEST_PROP(GlazeAllowance, LeavesEveryFaceAtItsDistance, ()) {
  // A wall of 8 mm with steps of up to 1.5 mm, smooth or not, on a floor of 10 mm.
  const double lean = 1e-2 * *rc::gen::inRange(-20, 40);
  std::vector<shapes::Radii> radii;
  double outer = 40.0;
  for (int i = 0; i < 40; ++i) {
    outer = std::max(outer + lean + 1e-3 * *rc::gen::inRange(-1000, 1000), 20.0);
    radii.push_back({outer, i < 5 ? 0.0 : outer - 8.0});
  }
  const ClayStack stack = shapes::stack_of(2.0, radii);
  const bool smooth = *rc::gen::arbitrary<bool>();
  SmoothingOptions options;
  options.mode = smooth ? Smoothing::fair : Smoothing::none;
  const Profile profile = smooth_profile_of(stack, options).value().section.profile;
  const double g = 1e-2 * *rc::gen::inRange(5, 200);
  constexpr double kWithin = 0.01;
  const auto back = finished(profile, glaze(g), {}, kWithin);
  if (!back) {
    RC_ASSERT(min_wall_mm(profile) < 2.0 * g + 1.0);
    RC_DISCARD("too thin");
  }
  const Polygon& section = back->profile.pieces.at(0);
  double top = 0.0;
  for (const ProfilePoint& p : section) top = std::max(top, p.y);
  for (const ProfilePoint& p : section) {
    if (p.rho == 0.0) continue;
    const double depth = depth_in(profile.pieces.at(0), p);
    RC_ASSERT(depth > g - kWithin);
    RC_ASSERT(p.y == top || depth < g + kWithin);
  }
}

}  // namespace
}  // namespace clay::solid
