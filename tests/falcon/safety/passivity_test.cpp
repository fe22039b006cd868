#include "falcon/safety/passivity_law.hpp"

#include "tests/falcon/random_values.hpp"
#include "tests/falcon/safety/passivity_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace clay::falcon {
namespace {

PassivityLaw controller_of(const SampledLoop& loop, double step_mm = 0.0) {
  PassivitySettings settings;
  settings.loop = loop;
  settings.step_mm = step_mm;
  return PassivityLaw(settings);
}

/// Moves a hand along a path against a spring at x < 0; `each` gets the answer and the requested
/// force.
template <class Each>
void play(PassivityLaw& controller, double stiffness, int ticks,
          const std::function<double(double)>& path, Each each) {
  for (int k = 0; k < ticks; ++k) {
    const glm::dvec3 at = along(path(k * kTickS));
    const glm::dvec3 requested = along(stiffness * std::max(0.0, -at.x));
    each(controller.tick(k * 1000, at, requested), requested);
  }
}

/// A press of 5 mm with one fraction of the force on the way in and another on the way out: energy
/// given to the hand, largest debt and worst state of the controller.
struct PressAndLeave {
  double given_mj = 0.0, debt_mj = 0.0;
  PassivityState worst = PassivityState::watching;
};
PressAndLeave press_and_leave(double fraction_in, double fraction_out, bool reports_displayed) {
  constexpr double kStiffness = 0.4, kDepthMm = 5.0;
  PassivityLaw controller = controller_of({1000, 0.1, 0.0005, 0});
  PressAndLeave run;
  double before_mm = 0.0, held_n = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const bool in = k <= 500;
    const double x_mm = 1e-3 - kDepthMm * (in ? k : 1000 - k) / 500.0;
    run.given_mj += held_n * (x_mm - before_mm);
    before_mm = x_mm;
    const glm::dvec3 requested = along(kStiffness * std::max(0.0, -x_mm));
    const PassiveForce answer = controller.tick(1000 * k, along(x_mm), requested);
    const glm::dvec3 shown = (in ? fraction_in : fraction_out) * answer.force_n;
    if (reports_displayed) controller.displayed(shown);
    held_n = shown.x;
    run.debt_mj = std::max(run.debt_mj, controller.observer().debt_mj());
    run.worst = std::max(run.worst, answer.state);
  }
  return run;
}

// A guard's ramp that grows during a contact gives the hand more energy on the way out than it took
// on the way in: at most F^2 / 2K. The controller detects it if the displayed force is reported.
TEST(Passivity, CountsTheDisplayedForce) {
  const double stored_mj = 0.5 * 0.4 * 25.0;
  const PressAndLeave steady = press_and_leave(1.0, 1.0, true);
  EXPECT_NEAR(steady.given_mj, 0.0, 0.01 * stored_mj);
  EXPECT_EQ(steady.worst, PassivityState::watching);

  const PressAndLeave unreported = press_and_leave(0.1, 1.0, false);
  EXPECT_NEAR(unreported.given_mj, 0.9 * stored_mj, 0.01 * stored_mj);
  EXPECT_EQ(unreported.worst, PassivityState::watching) << "it counts credit that does not exist";

  const PressAndLeave reported = press_and_leave(0.1, 1.0, true);
  EXPECT_EQ(reported.worst, PassivityState::damping);
  EXPECT_LT(reported.given_mj, 0.95 * unreported.given_mj);
  EXPECT_GT(reported.debt_mj, 0.0);

  const PressAndLeave less = press_and_leave(1.0, 0.1, true);
  EXPECT_LT(less.given_mj, 0.0) << "a force that fades takes energy";
  EXPECT_EQ(less.worst, PassivityState::watching);
}

TEST(Passivity, IgnoresANonFiniteDisplayedForce) {
  PassivityLaw reported = controller_of(kLoop), unreported = controller_of(kLoop);
  for (int k = 0; k < 100; ++k) {
    const glm::dvec3 at = along(-1e-2 * k), requested = along(4e-3 * k);
    EXPECT_EQ(reported.tick(1000 * k, at, requested).force_n,
              unreported.tick(1000 * k, at, requested).force_n);
    reported.displayed(along(std::nan("")));
  }
  EXPECT_EQ(reported.observer().injected_mj(), unreported.observer().injected_mj());
}

RC_GTEST_PROP(Passivity, PassesAnAcceptedSpringUnchanged, ()) {
  SampledLoop loop = kLoop;
  loop.delay_ticks = *rc::gen::inRange(0, 4);
  loop.damping_ns_per_mm = within(0.0005, 0.01);
  PassivityLaw controller = controller_of(loop);
  // Any passive hand: swings of any frequency up to 30 Hz, in and out of the contact.
  std::vector<glm::dvec3> waves;
  for (int n = 0; n < 4; ++n) waves.push_back({within(0, 0.4), within(1, 30), within(0, 6)});
  const double offset = within(-2.0, 0.0);
  const auto path = [&](double t) {
    double x = offset * t;  // it starts outside
    for (const auto& w : waves)
      x +=
          w.x * (1.0 + std::sin(2 * std::numbers::pi * w.y * t + w.z)) - 2 * w.x * std::min(t, 1.0);
    return x;
  };
  const double stiffness = within(0.0, 1.0) * accepted_stiffness(loop);
  bool touched = false;
  play(controller, stiffness, 1000, path,
       [&](const PassiveForce& sent, const glm::dvec3& requested) {
         touched = touched || requested.x > 0.0;
         RC_ASSERT(sent.state == PassivityState::watching);
         RC_ASSERT(sent.force_n == requested);
       });
  RC_CLASSIFY(touched, "in contact");
}

TEST(Passivity, DisplaysAStiffContactAtTheAcceptedStiffness) {
  PassivityLaw controller = controller_of(kLoop);  // accepted: b / T = 2 N/mm
  const auto path = [](double t) { return 0.1 - 10.0 * t; };
  double at = 0.0;
  play(controller, 1e3, 200, path, [&](const PassiveForce& sent, const glm::dvec3& requested) {
    const double x = path(kTickS * at++);
    const double expected = requested.x > 0.0 ? -2.0 * x : 0.0;
    // The spring starts at the last reading outside, at most one tick's motion before the surface.
    EXPECT_GE(sent.force_n.x, expected - 1e-12);
    EXPECT_LE(sent.force_n.x, expected + 2.0 * 1.1e-2);
  });
}

/// Pushes 1 mm at 1 mm/s into a wall that is far too stiff, with readings at this interval;
/// returns the largest force.
double force_after_1_mm(PassivityLaw& controller, std::int64_t& time_us, std::int64_t interval_us) {
  const double step_mm = 1e-6 * static_cast<double>(interval_us);
  double force_n = 0.0;
  for (double depth_mm = -0.1; depth_mm <= 1.0; depth_mm += step_mm)
    force_n = controller
                  .tick(time_us += interval_us, along(-depth_mm),
                        along(depth_mm > 0.0 ? 1e3 * depth_mm : 0.0))
                  .force_n.x;
  (void)controller.tick(time_us += interval_us, along(0.1), along(0.0));
  return force_n;
}

TEST(Passivity, SlowReadingsLowerTheAcceptedStiffness) {
  PassivityLaw controller = controller_of(kLoop);  // accepted: b / T, 2 N/mm at 1000 Hz
  std::int64_t time_us = 0;
  EXPECT_NEAR(force_after_1_mm(controller, time_us, 1000), 2.0, 0.02);
  EXPECT_FALSE(controller.slow_rate_hz());
  (void)force_after_1_mm(controller, time_us, 4000);  // 275 readings
  ASSERT_TRUE(controller.slow_rate_hz());
  EXPECT_NEAR(*controller.slow_rate_hz(), 250.0, 0.15 * 250.0);
  EXPECT_NEAR(force_after_1_mm(controller, time_us, 4000), 0.002 * *controller.slow_rate_hz(),
              0.02);
  (void)force_after_1_mm(controller, time_us, 1000);
  EXPECT_FALSE(controller.slow_rate_hz());
  EXPECT_NEAR(force_after_1_mm(controller, time_us, 1000), 2.0, 0.02);
}

/// A force built up at 1000 Hz, 2 N/mm, must not stay when only 250 Hz remain.
TEST(Passivity, ReadingsThatBecomeSlowReduceAForceInPlace) {
  PassivityLaw controller = controller_of(kLoop);
  std::int64_t time_us = 0;
  const auto tick = [&](double x, std::int64_t interval_us) {
    return controller.tick(time_us += interval_us, along(x), along(x < 0.0 ? 5.0 : 0.0)).force_n.x;
  };
  (void)tick(0.0, 1000);
  EXPECT_NEAR(tick(-2.0, 1000), 4.0, 1e-12);
  double force_n = 4.0;
  for (int k = 0; k < 300; ++k) force_n = tick(-2.0, 4000);
  EXPECT_NEAR(force_n, 4.0 * *controller.slow_rate_hz() / 1000.0, 1e-9);
}

TEST(Passivity, InwardMotionBuildsUpTheForce) {
  PassivityLaw controller = controller_of(kLoop);
  std::int64_t time_us = 0;
  const auto sent = [&](double x, double requested) {
    return controller.tick(time_us += 1000, along(x), along(requested)).force_n.x;
  };
  EXPECT_EQ(sent(-1.0, 5), 0.0);  // starts inside
  EXPECT_NEAR(sent(-1.5, 5), 1.0, 1e-12);
  EXPECT_NEAR(sent(-2.0, 5), 2.0, 1e-12);
  EXPECT_NEAR(sent(-1.8, 5), 1.6, 1e-12);
  EXPECT_EQ(sent(-1.7, 0), 0.0);  // released
  EXPECT_NEAR(sent(-1.8, 5), 0.2, 1e-12);
}

/// A contact that takes almost no energy on 20 mm in, and gives `gain_mj` on 1 mm out.
void inject(PassivityLaw& controller, std::int64_t& time_us, double gain_mj) {
  const auto tick = [&](double x, double force) {
    (void)controller.tick(time_us += 1000, along(x), along(force));
  };
  for (int k = 0; k <= 2000; ++k) tick(-1e-2 * k, k > 0 ? 1e-6 : 0.0);
  for (int k = 0; k < 20; ++k) tick(-20.0 + 0.05 * k, gain_mj / 1.0);
  tick(-19.0, 0.0);
  tick(-19.0, 0.0);
}

TEST(Passivity, DampingRemovesTheInjectedEnergyExactly) {
  PassivityLaw controller = controller_of(kLoop);
  std::int64_t time_us = 0;
  inject(controller, time_us, 2.0);
  const double injected = controller.observer().injected_mj();
  ASSERT_GT(injected, 1e-2);
  ASSERT_EQ(controller.state(), PassivityState::damping);
  // The free hand moves on at 50 mm/s. Each tick reduces the debt, with at most the
  // largest damping.
  double x = -19.0, remaining = injected;
  const double way_mm = 0.05, largest = controller.most_damping_ns_per_mm();
  for (int k = 0; k < 1000 && controller.state() == PassivityState::damping; ++k) {
    x += way_mm;
    const PassiveForce sent = controller.tick(time_us += 1000, along(x), along(0));
    EXPECT_LE(-sent.force_n.x, largest * way_mm / kTickS * (1 + 1e-12));
    EXPECT_LE(sent.force_n.x, 0.0);
    EXPECT_LE(controller.observer().injected_mj(), remaining);
    remaining = controller.observer().injected_mj();
  }
  EXPECT_EQ(controller.state(), PassivityState::watching);
  EXPECT_NEAR(controller.observer().injected_mj(), controller.observer().tolerance_mj(), 1e-9);
}

TEST(Passivity, BoundOfTheDampingFollowsFromTheSampleTime) {
  const SampledLoop slow{100, 0.1, 1e-6, 1}, fast{1000, 0.1, 1e-6, 1};
  // Half the stable damping of a free mass: (sqrt 8 - 2) m / 2T, less the spring's share.
  EXPECT_NEAR(controller_of(slow).most_damping_ns_per_mm(), (std::sqrt(8.0) - 2.0) * 0.005, 2e-5);
  EXPECT_NEAR(controller_of(fast).most_damping_ns_per_mm(), (std::sqrt(8.0) - 2.0) * 0.05, 2e-4);
  // With a coarse encoder, one step in a tick gives 0.25 N.
  EXPECT_NEAR(controller_of(fast, 0.05).most_damping_ns_per_mm(), 0.25 * kTickS / 0.05, 1e-15);
}

TEST(Passivity, TooMuchEnergyReducesThenEndsTheForce) {
  PassivityLaw controller = controller_of(kLoop);
  std::int64_t time_us = 0;
  inject(controller, time_us, 11.0);
  EXPECT_EQ(controller.state(), PassivityState::yielding);
  // Half of b / T from now on.
  EXPECT_NEAR(controller.tick(time_us += 1000, along(-19.5), along(5)).force_n.x, 0.5, 1e-12);
  (void)controller.tick(time_us += 1000, along(0), along(0));
  inject(controller, time_us, 11.0);
  EXPECT_EQ(controller.state(), PassivityState::safe);
  EXPECT_EQ(controller.tick(time_us += 1000, along(-10.0), along(5)).force_n, along(0));
  EXPECT_EQ(controller.tick(time_us += 1000, along(-20.0), along(5)).force_n, along(0));
  controller.reset();
  EXPECT_EQ(controller.state(), PassivityState::watching);
  (void)controller.tick(0, along(0), along(0));
  EXPECT_EQ(controller.tick(1000, along(-1.0), along(1)).force_n, along(1));
}

TEST(Passivity, LittleEnergyIsOnlyDamped) {
  PassivityLaw controller = controller_of(kLoop);
  std::int64_t time_us = 0;
  inject(controller, time_us, 2.0);
  EXPECT_EQ(controller.state(), PassivityState::damping);
}

/// A hand that gets a little energy: in without force, then out with 0.9 N until a debt arises.
struct SmallDebts {
  PassivityLaw controller = controller_of(kLoop);
  std::int64_t time_us = 0;
  double x = 0.0;

  void tick(double force) { (void)controller.tick(time_us += 1000, along(x), along(force)); }
  void pay() {
    for (int k = 0; k < 20; ++k, tick(1e-6)) x -= 0.05;
    EXPECT_EQ(controller.state(), PassivityState::watching) << "motion pays the debt";
  }
  void give() {
    tick(0.0);
    pay();
    for (int k = 0; k < 20 && controller.state() == PassivityState::watching; ++k, tick(0.9))
      x += 0.05;
  }
};

// A debt counts when it arises, and again when its contact ends with a gain. The third reduces the
// force: here during the second contact, although each gives less than 0.1 mJ.
TEST(Passivity, TheThirdSmallDebtReducesTheForce) {
  SmallDebts hand;
  hand.give();
  hand.tick(0.0);
  const EnergyObserver& observer = hand.controller.observer();
  EXPECT_FALSE(observer.in_contact());
  EXPECT_GT(observer.last_contact_mj(), observer.tolerance_mj());
  EXPECT_LT(observer.last_contact_mj(), 0.1);
  EXPECT_EQ(hand.controller.state(), PassivityState::damping);
  hand.give();
  EXPECT_TRUE(observer.in_contact());
  EXPECT_EQ(hand.controller.state(), PassivityState::yielding);
}

TEST(Passivity, AQuietIntervalForgetsSmallDebts) {
  SmallDebts hand;
  hand.give();
  hand.tick(0.0);
  hand.pay();
  for (int k = 0; k < 2000; ++k) hand.tick(0.0);
  hand.give();
  EXPECT_EQ(hand.controller.state(), PassivityState::damping);
}

TEST(Passivity, OscillationReducesTheForce) {
  for (const double swing : {0.9, 1.1}) {
    for (const int half_period_ticks : {6, 8}) {  // 8 swings in 42 and in 56 ms
      PassivityLaw controller = controller_of(kLoop);
      for (int k = 0; k < 200; ++k) {
        const double force = 2.0 + (k / half_period_ticks % 2) * swing;
        (void)controller.tick(k * 1000, along(-10.0), along(k < 20 ? 2.0 : force));
      }
      EXPECT_EQ(controller.state() != PassivityState::watching,
                swing > 1.0 && half_period_ticks == 6)
          << swing << " " << half_period_ticks;
    }
  }
}

TEST(Passivity, InvalidTickGivesNoForceAndChangesNothing) {
  PassivityLaw controller = controller_of(kLoop);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  (void)controller.tick(0, along(0), along(0));
  (void)controller.tick(1000, along(-1.0), along(1));
  const double before = controller.observer().injected_mj();
  EXPECT_EQ(controller.tick(2000, along(nan), along(1)).force_n, along(0));
  EXPECT_EQ(controller.tick(2000, along(-1.0), {0, inf, 0}).force_n, along(0));
  EXPECT_EQ(controller.tick(1000, along(-1.0), along(1)).force_n, along(0));  // time stands still
  EXPECT_EQ(controller.tick(-5, along(-1.0), along(1)).force_n, along(0));    // runs backwards
  EXPECT_EQ(controller.observer().injected_mj(), before);
  EXPECT_EQ(controller.tick(3000, along(-1.0), along(1)).force_n, along(1));
}

TEST(Passivity, ErrorsNameTheSetting) {
  const auto refused = [](auto change) {
    PassivitySettings settings;
    change(settings);
    const auto built = PassivityController::build(settings);
    return built ? std::string() : std::string(built.error().setting);
  };
  EXPECT_EQ(refused([](PassivitySettings&) {}), "");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.loop.rate_hz = 0; }), "rate_hz");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.step_mm = -1; }), "step_mm");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.energy_limit_mj = 0; }), "energy_limit_mj");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.energy_window_s = 11; }), "energy_window_s");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.reversal_limit = 17; }), "reversal_limit");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.reversal_window_s = std::nan(""); }),
            "reversal_window_s");
  EXPECT_EQ(refused([](PassivitySettings& s) { s.reversal_force_n = 0; }), "reversal_force_n");
}

TEST(Passivity, AcceptsSettingsUpToTheirLimitsAndNoOthers) {
  struct Range {
    double PassivitySettings::*setting;
    double low, high;
  };
  const Range ranges[] = {
      {&PassivitySettings::step_mm, 0.0, 10.0},
      {&PassivitySettings::energy_limit_mj, 1e-6, 1e6},
      {&PassivitySettings::energy_window_s, 1e-3, 10.0},
      {&PassivitySettings::reversal_window_s, 1e-3, 10.0},
      {&PassivitySettings::reversal_force_n, 1e-9, 1e3},
  };
  for (const Range& range : ranges) {
    const auto accepts = [&](double value) {
      PassivitySettings settings;
      settings.*range.setting = value;
      return PassivityController::build(settings).has_value();
    };
    EXPECT_TRUE(accepts(range.low)) << range.low;
    EXPECT_TRUE(accepts(range.high)) << range.high;
    EXPECT_FALSE(accepts(range.low - 1e-10)) << range.low;
    EXPECT_FALSE(accepts(range.high * 1.001)) << range.high;
  }
  const auto accepts_reversals = [](int limit) {
    PassivitySettings settings;
    settings.reversal_limit = limit;
    return PassivityController::build(settings).has_value();
  };
  EXPECT_TRUE(accepts_reversals(2) && accepts_reversals(16));
  EXPECT_FALSE(accepts_reversals(1) || accepts_reversals(17));
}

}  // namespace
}  // namespace clay::falcon
