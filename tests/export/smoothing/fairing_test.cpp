// Fair smoothing with a length, against closed forms of its filter.
//
// The curve minimises integral (u - R)^2 + (l / 2 pi)^6 u'''^2. Far from the ends that is a filter
// of gain 1 / (1 + (l / w)^6) for wavelengths w, with the kernel
//   g(y) = k / 6 [e^-t + e^-t/2 (cos(sqrt 3 t / 2) + sqrt 3 sin(sqrt 3 t / 2))], t = k |y|, k = 2
//   pi / l.
// So g(0) = k / 3, |g'| <= k^2 / (3 sqrt 3), and integral |g'''| = 0.672 k^3.

#include "claystack/export/proof.hpp"
#include "claystack/export/walls.hpp"
#include "export/smoothing/faired_curve.hpp"
#include "tests/export/smoothing/smoothed_pieces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace clay::solid {
namespace {

using oracles::Real;
using shapes::Radii;
using shapes::smooth;
using shapes::stack_of;

constexpr double kFine = 1e-5;  // tolerance [mm]: the polyline is the curve
constexpr double kTurnRad = 2.0 * std::numbers::pi;

SmoothingOptions faired(double length_mm, double tolerance_mm = kFine) {
  SmoothingOptions options = shapes::options_for(Smoothing::fair, tolerance_mm);
  options.smooth_length_mm = length_mm;
  options.min_wall_mm = 0.1;  // below all walls: no guard, except in some tests
  return options;
}

/// A tube whose outer wall has these radii at the middles of its rings.
ClayStack tube(double height_mm, double h, const std::function<double(double)>& outer_mm,
               double bore_mm = 20.0) {
  std::vector<Radii> radii;
  for (double y = 0.5 * h; y < height_mm; y += h) radii.push_back({outer_mm(y), bore_mm});
  return stack_of(h, radii);
}

/// The outer wall of a section of one piece.
class OuterWall {
 public:
  explicit OuterWall(const SmoothedProfile& made)
      : line_(oracles::walls_of(made.section.profile.pieces.at(0)).outer) {}

  [[nodiscard]] double at(double y) const {
    const auto above = std::find_if(line_.begin() + 1, line_.end() - 1,
                                    [&](const oracles::Point& p) { return p.y >= y; });
    const oracles::Point &a = *(above - 1), &b = *above;
    return static_cast<double>(a.rho + (b.rho - a.rho) * (y - a.y) / (b.y - a.y));
  }
  /// u'' from three points.
  [[nodiscard]] double bend(double y, double step) const {
    return (at(y - step) - 2.0 * at(y) + at(y + step)) / (step * step);
  }
  [[nodiscard]] double most_bend(double from, double to, double step) const {
    double most = 0.0;
    for (double y = from; y <= to; y += step) most = std::max(most, std::abs(bend(y, step)));
    return most;
  }

 private:
  oracles::Line line_;
};

TEST(FairedCurve, LimitsItsPointsForAnySagitta) {
  const ClayStack stack = tube(100.0, 0.5, [](double y) { return 40.0 + std::sin(0.1 * y); });
  const PieceWalls piece = walls_of(stack, {0, stack.size() - 1});
  const FairedCurve curve({piece, piece.outer, 0, piece.size()},
                          std::vector<double>(piece.size(), 9.0));
  for (const double sagitta_mm : {1e-2, 1e-14, 1e-320}) {
    const Polygon points = curve.points(sagitta_mm);
    EXPECT_GE(points.size(), 10u) << sagitta_mm;
    EXPECT_LE(points.size(), 4'200'000u) << sagitta_mm;
    EXPECT_EQ(points.back().y, 100.0) << sagitta_mm;
  }
}

TEST(Fairing, LeavesCylindersConesAndParaboloids) {
  for (const double length : {2.0, 9.0, 40.0, 1000.0})
    for (const double slope : {0.0, 0.3})
      for (const double bend : {0.0, 2e-3}) {
        const auto radius = [&](double y) { return 40.0 + slope * y + bend * y * y; };
        const ClayStack stack = tube(100.0, 0.5, radius);
        const SmoothedProfile made = smooth(stack, faired(length));
        EXPECT_LT(made.fairing.moved_mm, 1e-8) << length << ' ' << slope << ' ' << bend;
        const OuterWall wall(made);
        for (const double y : {0.1, 3.0, 51.3, 99.9})
          EXPECT_NEAR(wall.at(y), radius(y), made.overshoot_mm + kFine);
      }
}

TEST(Fairing, KeepsHalfARippleOfItsLength) {
  constexpr double kLength = 10.0, kHeight = 0.1;
  for (const double wave : {5.0, 10.0, 20.0}) {
    const auto radius = [&](double y) { return 40.0 + kHeight * std::sin(kTurnRad * y / wave); };
    const OuterWall wall(smooth(tube(200.0, 0.25, radius), faired(kLength)));
    double high = 0.0, low = 100.0;
    for (double y = 90.0; y < 110.0; y += 0.01) {
      high = std::max(high, wall.at(y));
      low = std::min(low, wall.at(y));
    }
    const double gain = 1.0 / (1.0 + std::pow(kLength / wave, 6));
    EXPECT_NEAR((high - low) / (2.0 * kHeight), gain, 2e-3) << wave;
  }
}

TEST(Fairing, TurnsAKinkIntoTheCurvatureOfItsKernel) {
  constexpr double kLength = 12.0, kTurn = 0.2;  // of the slope
  const auto radius = [](double y) { return 40.0 + kTurn * std::max(0.0, y - 100.0); };
  for (const double h : {0.5, 0.25}) {
    const SmoothedProfile chords = smooth(tube(200.0, h, radius), faired(0.0));
    const SmoothedProfile made = smooth(tube(200.0, h, radius), faired(kLength));
    const double expected = kTurnRad / kLength * kTurn / 3.0;  // g(0) times the turn
    EXPECT_NEAR(OuterWall(made).bend(100.0, h), expected, 0.02 * expected);
    EXPECT_LE(OuterWall(made).most_bend(50.0, 150.0, h), 1.02 * expected);
    EXPECT_GT(OuterWall(chords).most_bend(50.0, 150.0, h),
              0.45 * kTurn / h);  // the finer, the more
  }
}

TEST(Fairing, BoundsTheCurvatureOfAStepOfAStroke) {
  constexpr double kLength = 12.0, kStep = 0.5;
  for (const double spread : {1.0, 2.0, 4.0}) {
    const auto radius = [&](double y) {
      return 40.0 + kStep * std::clamp((y - 100.0) / spread, 0.0, 1.0);
    };
    const double k = kTurnRad / kLength;
    const double bound = kStep * k * k / (3.0 * std::sqrt(3.0));
    const OuterWall wall(smooth(tube(200.0, 0.5, radius), faired(kLength)));
    const double found = wall.most_bend(50.0, 150.0, 0.5);
    EXPECT_LE(found, 1.02 * bound) << spread;
    EXPECT_GE(found, (spread < 3.0 ? 0.7 : 0.5) * bound) << spread;
  }
}

TEST(Fairing, MovesASphereByLessThanTheBoundOfItsKernel) {
  constexpr double kRadius = 60.0;
  const auto radius = [](double y) {
    return std::sqrt(kRadius * kRadius - (y - 50.0) * (y - 50.0));
  };
  // R''' = -3 z R^2 / rho^5 at a distance z from the equator; largest at the ends, z = 50.
  const double rho = radius(0.0), third = 3.0 * 50.0 * kRadius * kRadius / std::pow(rho, 5);
  for (const double length : {5.0, 10.0, 20.0}) {
    const SmoothedProfile made = smooth(tube(100.0, 0.25, radius, 10.0), faired(length));
    const double bound = 0.672 * std::pow(length / (kTurnRad), 3) * third;
    EXPECT_LE(made.fairing.moved_mm, bound) << length;
    EXPECT_GT(made.fairing.moved_mm, 0.0);
  }
}

/// A wall with a kink, a ripple and a slope.
double lively(double y) {
  return 40.0 + 0.2 * std::abs(y - 61.0) + 0.3 * std::sin(kTurnRad * y / 14.0) + 0.1 * y;
}

TEST(Fairing, ConvergesWithTheHeightOfTheRings) {
  std::vector<double> differences;
  for (const double h : {2.0, 1.0, 0.5}) {
    const OuterWall coarse(smooth(tube(120.0, h, lively), faired(12.0)));
    const OuterWall fine(smooth(tube(120.0, 0.5 * h, lively), faired(12.0)));
    double most = 0.0;
    for (double y = 30.0; y < 90.0; y += 0.1)
      most = std::max(most, std::abs(coarse.at(y) - fine.at(y)));
    differences.push_back(most);
  }
  EXPECT_LT(differences[1], 0.4 * differences[0]);
  EXPECT_LT(differences[2], 0.4 * differences[1]);
  EXPECT_LT(differences[2], 0.01);
}

TEST(Fairing, KeepsThePolylineWithinTheToleranceOfTheCurve) {
  for (const double h : {0.5, 4.0, 20.0}) {
    const ClayStack stack = tube(120.0, h, lively);
    const SmoothedProfile exact = smooth(stack, faired(8.0, 1e-6));
    const OuterWall curve(exact);
    for (const double tolerance : {0.002, 0.05}) {
      const SmoothedProfile made = smooth(stack, faired(8.0, tolerance));
      const OuterWall wall(made);
      const double allowed = 0.5 * tolerance + made.overshoot_mm + exact.overshoot_mm + 1e-6;
      for (double y = 0.0; y < 120.0; y += 0.05) {
        const double slope = (curve.at(y + 0.05) - curve.at(std::max(0.0, y - 0.05))) / 0.1;
        ASSERT_LE(std::abs(wall.at(y) - curve.at(y)), allowed * std::hypot(1.0, slope))
            << h << ' ' << y;
      }
    }
  }
}

TEST(Fairing, KeepsFootAndLip) {
  // Both edges are rounded within three rings, as the rim rule leaves them.
  const auto radius = [](double y) {
    const double end = std::min(y, 120.0 - y);
    return lively(y) - (end < 1.0 ? 1.2 * (1.0 - end) * (1.0 - end) : 0.0);
  };
  const ClayStack stack = tube(120.0, 0.25, radius);
  const SmoothedProfile made = smooth(stack, faired(12.0));
  const OuterWall wall(made);
  for (std::size_t i = 0; i < 3; ++i)
    for (const std::size_t ring : {i, stack.size() - 1 - i}) {
      const double y = (static_cast<double>(ring) + 0.5) * 0.25;
      EXPECT_NEAR(wall.at(y), stack.rings()[ring].outer_mm(), 0.02) << ring;
    }
}

TEST(Fairing, LedgesStayCorners) {
  std::vector<Radii> radii;
  for (int i = 0; i < 120; ++i)
    radii.push_back({(i < 60 ? 30.0 : 34.0) + 0.05 * std::abs(i - 30), 20.0});
  const SmoothedProfile made = smooth(stack_of(0.5, radii), faired(9.0));
  const auto found = shapes::treads(oracles::walls_of(made.section.profile.pieces.at(0)).outer);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, 30.0);
  // 4.05 between the middles; each side goes on to the corner by half a step of 0.05.
  EXPECT_NEAR(found[0].second, 4.0, 1e-3);
}

/// A tube with a tooth outside, two rings high, as strokes leave it.
ClayStack with_tooth(double tread_mm) {
  std::vector<Radii> radii(160, {30.0, 20.0});
  radii[80].outer_mm += tread_mm;
  radii[81].outer_mm += 1.08 * tread_mm;
  return stack_of(0.065, radii);
}

/// The minimum wall with a length, and with a limit if it is above 0.
double wall_mm(const ClayStack& stack, double length_mm, double limit_mm = 0.0) {
  SmoothingOptions options = faired(length_mm, 0.02);
  options.min_wall_mm.reset();
  if (limit_mm > 0.0) options.min_wall_mm = limit_mm;
  return min_wall_mm(smooth(stack, options).section.profile);
}

TEST(Fairing, SmoothsAwayATreadMuchNarrowerThanItsLength) {
  const auto treads_of = [](double tread_mm, double length_mm, double tolerance_mm) {
    const SmoothedProfile made = smooth(with_tooth(tread_mm), faired(length_mm, tolerance_mm));
    return shapes::treads(oracles::walls_of(made.section.profile.pieces.at(0)).outer).size();
  };
  for (const double length : {4.0, 9.0, 20.0}) {
    EXPECT_EQ(treads_of(0.15, length, 0.02), 0u) << length;
    EXPECT_NEAR(wall_mm(with_tooth(0.15), length), 10.0, 0.05) << length;
  }
  EXPECT_EQ(treads_of(0.5, 9.0, 0.02), 0u);
  EXPECT_EQ(treads_of(0.57, 9.0, 0.02), 2u);  // 1/16 of the length: a flange
  // Chords keep a tread that is wider than the tolerance.
  EXPECT_EQ(treads_of(0.15, 0.0, 0.02), 2u);
  EXPECT_EQ(treads_of(0.15, 0.0, 0.2), 0u);
}

/// A ledge, and noise of strokes above it.
ClayStack with_noise_above_a_ledge(const std::vector<double>& noise_mm, double slope) {
  std::vector<Radii> radii(60, {26.0, 20.0});
  for (std::size_t i = 0; i < 100; ++i)
    radii.push_back(
        {30.0 + slope * 0.065 * static_cast<double>(i) + (i < noise_mm.size() ? noise_mm[i] : 0.0),
         20.0});
  return stack_of(0.065, radii);
}

/// Not below half of the chords' minimum, nor below a limit that chords keep.
void expect_as_thick_as_chords(const ClayStack& stack, double length_mm) {
  const double chords = wall_mm(stack, 0.0);
  EXPECT_GE(wall_mm(stack, length_mm), 0.499 * chords) << length_mm;
  for (const double limit : {0.8, 0.95 * chords})
    if (wall_mm(stack, 0.0, limit) >= limit) {
      EXPECT_GE(wall_mm(stack, length_mm, limit), limit - 1e-3) << length_mm;
    }
}

/// A ledge allows only short lengths beside it: these can turn noise into a tooth, which the chords
/// leave blunt.
TEST(Fairing, IsUndoneWhereChordsAreThicker) {
  const ClayStack known = with_noise_above_a_ledge(
      {0, 0.164, 0, 0.032, 0.061, 0, 0.227, 0.124, 0.102, 0.074, 0.004, 0.165}, -0.38);
  EXPECT_GT(wall_mm(known, 0.0), 7.0);
  EXPECT_GT(wall_mm(known, 4.0), 3.5);
  EXPECT_GE(wall_mm(known, 4.0, 0.8), 0.8);
  // With chords the treads of this noise are corners again.
  expect_as_thick_as_chords(
      with_noise_above_a_ledge({0.81, 0.833, 0.915, 0.008, 0, 0, 0, 0, 0.799, 0.935, 0.83, 0.826},
                               0.36127),
      20.0);
  std::mt19937_64 random(3);
  for (int pot = 0; pot < 200; ++pot) {
    SCOPED_TRACE(pot);
    std::vector<double> noise_mm(12);
    for (double& mm : noise_mm)
      if (samples::uniform(random) < 0.5) mm = 0.3 * samples::uniform(random);
    const ClayStack stack = with_noise_above_a_ledge(noise_mm, samples::uniform(random) - 0.5);
    for (const double length : {2.0, 9.0}) expect_as_thick_as_chords(stack, length);
  }
}

TEST(Fairing, ReportsTheLargestDisplacement) {
  const ClayStack stack = tube(120.0, 0.5, lively);
  const SmoothedProfile made = smooth(stack, faired(12.0));
  const OuterWall wall(made);
  double most = 0.0, at = 0.0;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const double y = 0.5 * static_cast<double>(i) + 0.25;
    const double moved = std::abs(wall.at(y) - stack.rings()[i].outer_mm());
    if (moved > most) most = moved, at = y;
  }
  EXPECT_EQ(made.fairing.length_mm, 12.0);
  EXPECT_NEAR(made.fairing.moved_mm, most, made.overshoot_mm + kFine);
  EXPECT_NEAR(made.fairing.moved_at_mm, at, 1e-9);
  EXPECT_GT(most, 0.1);
  EXPECT_TRUE(made.fairing.shortened.empty());
  EXPECT_LT(made.volume_error_relative, 1e-12);
}

TEST(Fairing, ShortensTheLengthWhereAWallWouldBecomeTooThin) {
  // A wall as thick everywhere as along the radius: fairing spreads the slope of the ridge into the
  // straight wall beside it, where the thickness across it would become less.
  const auto ridge = [](double y) { return 30.0 + 0.3 * std::max(0.0, 10.0 - std::abs(y - 60.0)); };
  std::vector<Radii> radii;
  for (double y = 0.25; y < 120.0; y += 0.5) radii.push_back({ridge(y), ridge(y) - 3.0});
  const ClayStack stack = stack_of(0.5, radii);
  SmoothingOptions options = faired(20.0, 0.02);
  options.min_wall_mm = 2.995;
  const SmoothedProfile made = smooth(stack, options);
  const double own = min_wall_mm(profile_of(stack)->profile);
  EXPECT_GE(min_wall_mm(made.section.profile), std::min(own, 2.995) - 1e-6);
  ASSERT_FALSE(made.fairing.shortened.empty());
  for (const ShortenedFairing& place : made.fairing.shortened) {
    EXPECT_LT(place.length_mm, 20.0);
    EXPECT_LT(place.from_mm, place.to_mm);
  }
  EXPECT_GT(made.fairing.moved_mm, 0.01);  // elsewhere
}

TEST(Fairing, GoesThroughTheMiddlesOfTheRingsWithoutALength) {
  const ClayStack stack = tube(120.0, 0.5, lively);
  SmoothingOptions chords = faired(0.0, 0.02);
  const SmoothedProfile made = smooth(stack, chords);
  EXPECT_EQ(made.fairing.length_mm, 0.0);
  EXPECT_EQ(made.fairing.moved_mm, 0.0);
  for (std::size_t i = 0; i < stack.size(); ++i)  // through the middles
    EXPECT_NEAR(OuterWall(made).at(0.5 * static_cast<double>(i) + 0.25),
                stack.rings()[i].outer_mm(), 0.02);
}

TEST(Fairing, HoldsForFewLowHighAndManyRings) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 17u})
    for (const double h : {0.001, 0.5, 50.0})
      for (const double length : {0.001, 9.0, 1e4}) {
        std::vector<Radii> radii;
        for (std::size_t i = 0; i < count; ++i)
          radii.push_back({40.0 + (i % 2 == 0 ? 0.5 : 0.0), i % 3 == 0 ? 30.0 : 30.4});
        const SmoothedProfile made = smooth(stack_of(h, radii), faired(length, 0.02));
        EXPECT_LT(made.volume_error_relative, 1e-12);
        EXPECT_TRUE(certify(made.section.profile)) << count << ' ' << h << ' ' << length;
        EXPECT_EQ(made.fairing.length_mm, std::max(length, 2.0 * h));
      }
}

TEST(Fairing, FinishesForTwoHundredThousandRings) {
  for (const double length : {0.01, 9.0, 2000.0}) {
    std::vector<Radii> radii;
    for (int i = 0; i < 200'000; ++i) {
      const double y = 0.005 * i, outer = 40.0 + 4.0 * std::sin(0.05 * y) + 0.1 * std::sin(3.0 * y);
      radii.push_back({outer, outer - 4.0});
    }
    const SmoothedProfile made = smooth(stack_of(0.005, radii), faired(length, 0.02));
    EXPECT_LT(made.volume_error_relative, 1e-12);
    EXPECT_TRUE(certify(made.section.profile));
  }
}

TEST(Fairing, NarrowBoresStayOpen) {
  std::vector<Radii> radii;
  for (int i = 0; i < 60; ++i) radii.push_back({30.0, i < 30 ? 0.02 : 8.0 + 0.1 * (i - 30)});
  const SmoothedProfile made = smooth(stack_of(0.5, radii), faired(30.0, 0.02));
  EXPECT_TRUE(certify(made.section.profile));
  for (const ProfilePoint& p : made.section.profile.pieces.at(0)) EXPECT_GT(p.rho, 0.0);
}

TEST(Fairing, IsRefusedOutOfRangeAndInOtherModes) {
  const ClayStack stack = shapes::vase(20);
  for (const double length : {-1.0, std::nan(""), HUGE_VAL}) {
    const auto made = smooth_profile_of(stack, faired(length));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().kind, ErrorKind::bad_input);
    EXPECT_NE(made.error().message.find("smooth length"), std::string::npos);
  }
  for (const Smoothing mode : {Smoothing::exact, Smoothing::none}) {
    SmoothingOptions options = faired(9.0);
    options.mode = mode;
    const auto made = smooth_profile_of(stack, options);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("smooth length: expected fair smoothing, found "),
              std::string::npos);
  }
}

}  // namespace
}  // namespace clay::solid
