#include "claystack/export/smoothing.hpp"

#include "claystack/export/proof.hpp"
#include "claystack/export/walls.hpp"
#include "tests/export/smoothing/smoothed_pieces.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <optional>

namespace clay::solid {
namespace {

using oracles::Real;
using shapes::options_for;
using shapes::pieces_of_both;
using shapes::Radii;
using shapes::smooth;
using shapes::stack_of;
using shapes::swept;
using shapes::treads;

constexpr std::size_t kMostRings = 120;

RC_GTEST_PROP(SmoothingPromises, KeepsTheClayOfEveryPiece, ()) {
  const ClayStack stack = shapes::hard_stack(kMostRings);
  RC_PRE(profile_of(stack).has_value());
  const SmoothedProfile made = smooth(stack, shapes::any_options());
  for (const auto& [first, last, levels, steps, walls] : pieces_of_both(stack, made)) {
    WideQuanta clay = last + 1 == stack.size() ? stack.crown() : 0;
    for (std::size_t i = first; i <= last; ++i) clay += stack.rings()[i].volume();
    const Real counted = static_cast<Real>(clay) * 0x1p-36L * stack.ring_height_mm();
    // Relative to the volume within the outer wall, since a thin wall is a difference of large
    // volumes.
    RC_ASSERT(std::abs(swept(walls.outer) - swept(walls.bore) - counted) <
              1e-12L * swept(steps.outer));
  }
}

RC_GTEST_PROP(SmoothingPromises, ExactKeepsBothWallsOfEveryRing, ()) {
  const ClayStack stack = shapes::hard_stack(kMostRings);
  RC_PRE(profile_of(stack).has_value());
  SmoothingOptions options = shapes::any_options();
  options.mode = Smoothing::exact;
  options.smooth_length_mm = 0.0;
  options.overshoot_limit_mm = *rc::gen::element(0.0, 0.1, 100.0);
  const SmoothedProfile made = smooth(stack, options);
  RC_ASSERT(made.max_ring_error_relative < 1e-12);
  RC_ASSERT(made.overshoot_mm <= *options.overshoot_limit_mm || made.overshoot_mm < 1e-4);
  for (const auto& [first, last, levels, steps, walls] : pieces_of_both(stack, made))
    for (std::size_t i = first; i <= last; ++i) {
      const Real low = levels[i - first], high = levels[i - first + 1];
      Real height = stack.ring_height_mm();
      if (i + 1 == stack.size()) height += stack.crown_height_mm();
      const Ring& ring = stack.rings()[i];
      const Real outer = static_cast<Real>(ring.outer2) * 0x1p-36L * height;
      const Real bore = static_cast<Real>(ring.inner2) * 0x1p-36L * height;
      RC_ASSERT(std::abs(oracles::swept_over_pi(walls.outer, low, high) - outer) <= 1e-12L * outer);
      RC_ASSERT(std::abs(oracles::swept_over_pi(walls.bore, low, high) - bore) <= 1e-12L * bore);
    }
}

RC_GTEST_PROP(SmoothingPromises, ExactStaysWithinTheReportedDistanceOfTheRadiiAboutARing, ()) {
  const ClayStack stack = shapes::hard_stack(kMostRings);
  RC_PRE(profile_of(stack).has_value());
  SmoothingOptions options = shapes::any_options();
  options.mode = Smoothing::exact;
  options.smooth_length_mm = 0.0;
  const SmoothedProfile made = smooth(stack, options);
  const Real spare = std::max(made.overshoot_mm, made.extrapolated_mm) + 1e-9;
  Real widest = 0;  // of all steps: no wall continues by more
  for (const shapes::PieceOfBoth& piece : pieces_of_both(stack, made))
    for (std::size_t i = 0; i <= piece.last - piece.first; ++i) {
      const std::size_t ring = piece.first + i;
      const std::size_t below = i == 0 ? ring : ring - 1, above = std::min(ring + 1, piece.last);
      // A level line at the end of a ring may belong to the next one.
      const Real inside = 1e-6L * (piece.levels[i + 1] - piece.levels[i]);
      const auto stays = [&](const oracles::Line& line, auto radius_of) {
        const Real a = radius_of(below), b = radius_of(ring), c = radius_of(above);
        widest = std::max({widest, std::abs(a - b), std::abs(b - c)});
        const auto found =
            oracles::radii(line, piece.levels[i] + inside, piece.levels[i + 1] - inside);
        RC_ASSERT(found.first >= std::min({a, b, c}) - spare);
        RC_ASSERT(found.second <= std::max({a, b, c}) + spare);
      };
      stays(piece.smooth.outer, [&](std::size_t r) { return Real(stack.rings()[r].outer_mm()); });
      stays(piece.smooth.bore, [&](std::size_t r) { return Real(stack.rings()[r].inner_mm()); });
    }
  RC_ASSERT(made.extrapolated_mm <= made.overshoot_mm + widest + 1e-9);
}

/// By the one definition of a wall, which also measures flanges.
RC_GTEST_PROP(SmoothingPromises, TheMinimumWallIsAtLeastTheLimitOrThatOfTheSteps, ()) {
  const ClayStack stack = shapes::hard_stack(kMostRings);
  const auto steps = profile_of(stack);
  RC_PRE(steps.has_value());
  const SmoothingOptions options = shapes::any_options();
  const SmoothedProfile made = smooth(stack, options);
  Real largest = 0;
  for (const Ring& ring : stack.rings()) largest = std::max<Real>(largest, ring.outer_mm());
  for (std::size_t k = 0; k < made.section.shapes.size(); ++k) {
    const auto& shape = made.section.shapes[k];
    const auto own =
        oracles::walls_by_ring(stack, shape.first_ring, shape.last_ring,
                               oracles::steps_of(stack, shape.first_ring, shape.last_ring));
    // The minimum wall of the wall guard, and that by the definition, both on the steps.
    const double guarded = static_cast<double>(*std::min_element(own.begin(), own.end()));
    const double defined = min_wall_mm({{steps->profile.pieces[k]}});
    const double least = std::min({options.min_wall_mm.value_or(1e300), guarded, defined});
    const Wall found = min_wall({{made.section.profile.pieces[k]}});
    if (found.compact) continue;  // a lump without a wall
    const double slack = 2.0 * made.taken_mm + made.overshoot_mm * 1e-9 +
                         static_cast<double>(largest) * 0x1p-19 +
                         shapes::wall_slack_mm(options, static_cast<double>(largest));
    RC_ASSERT(found.thickness_mm >= least * (1 - 1e-8) - slack);
  }
}

RC_GTEST_PROP(SmoothingPromises, FairLeavesTheRadiiAboutARingByTheVolumeCorrectionOnly, ()) {
  const ClayStack stack = shapes::hard_stack(kMostRings);
  RC_PRE(profile_of(stack).has_value());
  const SmoothingOptions options = options_for(Smoothing::fair, 1e-7);
  const SmoothedProfile made = smooth(stack, options);
  RC_ASSERT(made.overshoot_mm <= shapes::allowed_move_mm(stack, options));
  const Real spare = made.overshoot_mm + 1e-4;  // 1e-7 across a shallow chord
  for (const auto& [first, last, levels, steps, walls] : pieces_of_both(stack, made))
    for (std::size_t i = 0; i <= last - first; ++i) {
      const Real below = levels[i == 0 ? 0 : i - 1],
                 above = levels[std::min(i + 2, last - first + 1)];
      for (const auto& [own, smoothed] :
           {std::pair{steps.outer, walls.outer}, std::pair{steps.bore, walls.bore}}) {
        const auto [least, most] = oracles::radii(own, below, above);
        const auto [found_least, found_most] = oracles::radii(smoothed, levels[i], levels[i + 1]);
        RC_ASSERT(found_least >= least - spare);
        RC_ASSERT(found_most <= most + spare);
      }
    }
}

RC_GTEST_PROP(SmoothingPromises, FairingLeavesTheRadiusOfARingByTheReportedDistance, ()) {
  const ClayStack stack = shapes::hard_stack(kMostRings);
  RC_PRE(profile_of(stack).has_value());
  SmoothingOptions options = options_for(Smoothing::fair, 1e-5);
  options.smooth_length_mm = *rc::gen::element(0.5, 9.0, 60.0);
  const SmoothedProfile made = smooth(stack, options);
  RC_ASSERT(
      made.fairing.length_mm == std::max(options.smooth_length_mm, 2.0 * stack.ring_height_mm()) ||
      std::ranges::any_of(
          made.guard, [](const KeptSteps& kept) { return kept.reason == KeptFor::certificate; }));
  RC_ASSERT(made.overshoot_mm <= shapes::allowed_move_mm(stack, options));
  const Real spare = made.fairing.moved_mm + made.overshoot_mm + 1e-2;  // 1e-5 across a steep chord
  for (const auto& [first, last, levels, steps, walls] : pieces_of_both(stack, made))
    for (std::size_t i = 0; i <= last - first; ++i) {
      const Real y = levels[i] + 0.5 * stack.ring_height_mm();
      const Ring& ring = stack.rings()[first + i];
      const auto [least, most] = oracles::radii(walls.outer, y, y + 1e-9L);
      RC_ASSERT(least >= ring.outer_mm() - spare);
      RC_ASSERT(most <= ring.outer_mm() + spare);
      const auto [bore_least, bore_most] = oracles::radii(walls.bore, y, y + 1e-9L);
      RC_ASSERT(bore_least >= ring.inner_mm() - spare);
      RC_ASSERT(bore_most <= ring.inner_mm() + spare);
    }
}

/// Of the stretches of rings without a bore, the least height.
Real least_floor(const ClayStack& stack, std::size_t first, std::size_t last,
                 const std::vector<Real>& levels) {
  Real least = 1e300L, bottom = levels.front();
  for (std::size_t i = first; i <= last; ++i) {
    if (stack.rings()[i].inner2 > 0)
      bottom = levels[i - first + 1];
    else if (i == last || stack.rings()[i + 1].inner2 > 0)
      least = std::min(least, levels[i - first + 1] - bottom);
  }
  return least;
}

/// The largest amount by which a wall is thinner than permitted [mm]; at most 0 if no wall is.
Real thinned_mm(const ClayStack& stack, const SmoothingOptions& options,
                const SmoothedProfile& made) {
  Real largest = 0, thinned = -1e300L;
  for (const Ring& ring : stack.rings()) largest = std::max<Real>(largest, ring.outer_mm());
  for (const auto& [first, last, levels, steps, walls] : pieces_of_both(stack, made)) {
    const auto own = oracles::walls_by_ring(stack, first, last, steps);
    const auto now = oracles::walls_by_ring(stack, first, last, walls);
    const Real limit = options.min_wall_mm ? *options.min_wall_mm
                                           : std::min(*std::min_element(own.begin(), own.end()),
                                                      least_floor(stack, first, last, levels));
    bool tiny_steps = false;
    for (std::size_t i = first + 1; i <= last; ++i) {
      const Ring &a = stack.rings()[i - 1], &b = stack.rings()[i];
      for (const Real step : {Real(a.outer_mm()) - b.outer_mm(), Real(a.inner_mm()) - b.inner_mm()})
        tiny_steps |= step != 0 && std::abs(step) < largest * 0x1p-20L;
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      const bool solid = stack.rings()[first + i].inner2 == 0;
      const Real slack = (solid ? 2 : 1) * made.taken_mm + (tiny_steps ? largest * 0x1p-20L : 0) +
                         shapes::wall_slack_mm(options, static_cast<double>(limit));
      thinned = std::max(thinned, std::min(limit, own[i]) * (1 - 2e-9L) - slack - 1e-13L - now[i]);
    }
  }
  return thinned;
}

RC_GTEST_PROP(SmoothingPromises, ThinsNoWallBelowItsOwnAndTheLimit, ()) {
  const ClayStack stack = shapes::hard_stack(50);
  RC_PRE(profile_of(stack).has_value());
  const SmoothingOptions options = shapes::any_options();
  const SmoothedProfile made = smooth(stack, options);
  RC_ASSERT(made.taken_mm <= shapes::allowed_move_mm(stack, options));
  RC_ASSERT(thinned_mm(stack, options, made) <= 0);
}

/// The wall of a thin ring may end at the outside of its neighbour, which is thick enough to be
/// moved by the volume correction.
TEST(SmoothingPromises, TheVolumeCorrectionThinsNoWallThatEndsInAnotherRing) {
  const ClayStack stack = stack_of(0.2, {{39.985351, 34.813247},
                                         {39.997123, 34.647501},
                                         {40.001914, 34.625766},
                                         {40.036083, 34.80965},
                                         {41.363454, 36.241606},
                                         {41.431674, 36.335515},
                                         {41.519617, 36.546581},
                                         {41.597097, 36.434653},
                                         {41.682928, 36.631517},
                                         {41.791859, 36.606592},
                                         {41.905889, 36.587014},
                                         {41.027336, 35.824094}});
  SmoothingOptions options = options_for(Smoothing::fair, 1e-4);
  options.min_wall_mm = 4.0;
  const SmoothedProfile made = smooth(stack, options);
  EXPECT_LE(thinned_mm(stack, options, made), 0);
}

RC_GTEST_PROP(SmoothingPromises, IsCertifiedWhereTheStepsAre, ()) {
  const ClayStack stack = shapes::hard_stack(2 * kMostRings);
  const auto steps = profile_of(stack);
  RC_PRE(steps.has_value());
  RC_PRE(certify(steps->profile).has_value());
  const SmoothedProfile made = smooth(stack, shapes::any_options());
  const auto certificate = certify(made.section.profile);
  if (!certificate) RC_FAIL(certificate.error().message);
}

/// A pot as potters make them: walls that change slowly, 2 mm at least.
ClayStack pot(std::mt19937_64& random, std::size_t count, double h) {
  std::vector<Radii> radii;
  double outer = 40.0, slope = 0.0, wall = 5.0;
  for (std::size_t i = 0; i < count; ++i) {
    slope = std::clamp(slope + 0.2 * (samples::uniform(random) - 0.5), -1.0, 1.0);
    outer = std::clamp(outer + slope * h, 20.0, 80.0);
    wall = std::clamp(wall + 0.3 * (samples::uniform(random) - 0.5), 2.0, 8.0);
    radii.push_back({outer, i < 6 ? 0.0 : outer - wall});
  }
  return stack_of(h, radii);
}

/// From middle to middle the radial wall is a mean of two rings' walls.
RC_GTEST_PROP(SmoothingPromises, FairKeepsTheRadialWallAMeanOfTwoRings, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = pot(random, 60, 0.5);
  const SmoothedProfile made = smooth(stack, options_for(Smoothing::fair, 1e-7));
  const auto walls = oracles::walls_of(made.section.profile.pieces.at(0));
  RC_PRE(made.guard.empty());
  RC_PRE(treads(walls.outer).empty());
  RC_PRE(treads(walls.bore).size() == 1u);
  // Beside the floor, the bore has the radius of its ring.
  const auto beside = [&](Real part) {
    const Real y = (6 + part) * 0.5L;
    return oracles::radii(walls.outer, y, y + 1e-12L).first -
           oracles::radii(walls.bore, y, y + 1e-12L).first;
  };
  const Real first_wall = stack.rings()[6].outer_mm() - stack.rings()[6].inner_mm();
  const Real step = std::abs(stack.rings()[6].outer_mm() - stack.rings()[5].outer_mm());
  for (const Real part : {0.01L, 0.2L, 0.49L})
    RC_ASSERT(std::abs(beside(part) - first_wall) <= step / 2 + made.overshoot_mm + 1e-6L);
  for (std::size_t i = 6; i + 1 < stack.size(); ++i)
    for (const Real t : {0.0L, 0.3L, 0.5L, 0.9L}) {
      const Real y = (static_cast<Real>(i) + 0.5L + t) * 0.5L;
      const auto own = [&](std::size_t ring) {
        return stack.rings()[ring].outer_mm() - stack.rings()[ring].inner_mm();
      };
      const Real found = oracles::radii(walls.outer, y, y + 1e-12L).first -
                         oracles::radii(walls.bore, y, y + 1e-12L).first;
      RC_ASSERT(std::abs(found - ((1 - t) * own(i) + t * own(i + 1))) <= made.overshoot_mm + 1e-6L);
    }
}

RC_GTEST_PROP(SmoothingPromises, StaysWithinTheToleranceOfTheMiddles, ()) {
  auto random = *samples::random_engine();
  const ClayStack stack = pot(random, 200, 0.5);
  const double tolerance = *rc::gen::element(0.01, 0.05);
  const SmoothedProfile made = smooth(stack, options_for(Smoothing::fair, tolerance));
  RC_ASSERT(made.guard.empty());
  const auto walls = oracles::walls_of(made.section.profile.pieces.at(0));
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const Real y = (static_cast<double>(i) + 0.5) * 0.5;
    const auto [least, most] = oracles::radii(walls.outer, y, y + 1e-9L);
    // Half of the tolerance across a slope of 45 degrees, and the part that the scale adds.
    RC_ASSERT(std::abs(least - stack.rings()[i].outer_mm()) < tolerance);
  }
}

// A search over all rings for each of them would take minutes.
TEST(SmoothingPromises, FinishForTwoHundredThousandRings) {
  std::mt19937_64 random(3);
  const ClayStack stack = pot(random, 200'000, 0.005);
  const SmoothedProfile made = smooth(stack, options_for(Smoothing::fair));
  EXPECT_LT(made.volume_error_relative, 1e-12);
  EXPECT_TRUE(certify(made.section.profile));
}

}  // namespace
}  // namespace clay::solid
