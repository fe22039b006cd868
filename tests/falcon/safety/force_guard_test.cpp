#include "claystack/falcon/guard.hpp"

#include "falcon/safety/basic_guard.hpp"
#include "tests/falcon/safety/guard_faults.hpp"
#include "tests/falcon/safety/guard_trial.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace clay::falcon {
namespace {

static_assert(std::is_trivially_copyable_v<BasicForceGuard<kAllGuardRules>>,
              "a tick allocates nothing");
static_assert(noexcept(std::declval<ForceGuard&>().admit(0, std::declval<const GuardSample&>())));
static_assert(noexcept(std::declval<ForceGuard&>().force(0, std::declval<const WantedForce&>())));

/// The first five violations, one per line.
std::string first_violations(const Trial& trial) {
  std::string text;
  for (std::size_t i = 0; i < trial.violations().size() && i < 5; ++i)
    text.append(trial.violations()[i]).append("\n");
  return text;
}

/// Writes a CSV line per tick if CLAYSTACK_GUARD_LOG names a folder.
void keep_log(const Trial& trial, const GuardFault& fault) {
  const char* folder = std::getenv("CLAYSTACK_GUARD_LOG");
  if (folder == nullptr) return;
  std::ofstream file(fmt::format("{}/{:02}.csv", folder, fault.number));
  file << "time_s,force_n,rise_n,gain,state,cause,flags\n";
  for (const LogEntry& e : trial.log())
    file << fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{},{},{}\n", e.time_s, norm(e.sent_n),
                        e.rise_n, e.out.gain, static_cast<int>(e.out.state),
                        static_cast<int>(e.out.cause), e.out.flags);
}

class Fault : public testing::TestWithParam<GuardFault> {};

TEST_P(Fault, DoesNoHarm) {
  Trial trial;
  GetParam().run(trial);
  keep_log(trial, GetParam());
  EXPECT_TRUE(trial.violations().empty()) << first_violations(trial);
}

INSTANTIATE_TEST_SUITE_P(ForceGuard, Fault,
                         testing::ValuesIn(guard_faults().begin(), guard_faults().end()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           for (char& letter : name)
                             if (letter == ' ') letter = '_';
                           return name;
                         });

/// "| rule | 1, 2 |", the faults that pass a guard without the rule.
std::string row_without(const NamedGuardRule& rule) {
  std::string faults;
  for (const GuardFault& fault : guard_faults()) {
    Trial trial(rule.rule);
    fault.run(trial);
    if (trial.violations().empty()) continue;
    faults.append(faults.empty() ? "" : ", ").append(std::to_string(fault.number));
  }
  return std::string("| ").append(rule.name).append(" | ").append(faults).append(" |");
}

TEST(ForceGuardRules, EachStopsFaultsThatNoOtherRuleStops) {
  std::set<std::string> lines;
  std::ifstream page(CLAYSTACK_DOCS "/force-guard.md");
  for (std::string line; std::getline(page, line);) lines.insert(line);
  for (const NamedGuardRule& rule : kGuardRules) {
    const std::string row = row_without(rule);
    EXPECT_EQ(row.find("|  |"), std::string::npos) << "no fault tests the rule: " << row;
    EXPECT_TRUE(lines.contains(row)) << "docs/force-guard.md lacks: " << row;
  }
}

glm::dvec3 any_force() {
  const auto part = [] { return *rc::gen::inRange(-60, 61) / 10.0; };
  return *rc::gen::element(0, 1, 2, 3) == 0 ? glm::dvec3(0.1, 0.0, 0.0)
                                            : glm::dvec3(part(), part(), part());
}

/// A jump is 0 or at least 12 mm, so -5e-324 is for forces only.
double any_extreme_number(bool jump) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  return jump ? *rc::gen::element(nan, inf, -inf, 1e308, 50.0)
              : *rc::gen::element(nan, inf, -inf, 1e308, -5e-324, 50.0);
}

/// A tick with up to three faults.
Tick any_tick() {
  Tick tick{.wanted_n = any_force()};
  const int faults = *rc::gen::element(0, 0, 1, 1, 2, 3);
  for (int i = 0; i < faults; ++i) switch (*rc::gen::inRange(0, 12)) {
      case 0:
        tick.wanted_n[*rc::gen::inRange(0, 3)] = any_extreme_number(false);
        break;
      case 1:
        tick.gap_us = *rc::gen::element(0, 1, 100, 250, 2'000, 9'000, 10'000, 11'000, 60'000);
        break;
      case 2:
        tick.clock_jump_us = *rc::gen::inRange(-100'000, 100'000);
        break;
      case 3:
        tick.clock_stopped = true;
        break;
      case 4:
      case 5:
        tick.frame = false;
        break;
      case 6:
        tick.frame_age_us = *rc::gen::inRange(0, 20'000);
        break;
      case 7:
        tick.ready = *rc::gen::inRange(0, 4) != 0;
        break;
      case 8:
        tick.jump_mm[*rc::gen::inRange(0, 2)] = *rc::gen::element(15.0, 30.0);
        break;
      case 9:
        tick.jump_mm.z = any_extreme_number(true);
        break;
      case 10:
        tick.clay_new = false;
        break;
      default:
        tick.passive = *rc::gen::inRange(0, 4) != 0;
    }
  return tick;
}

std::string describe(const Tick& t, int times) {
  const auto v = [](const glm::dvec3& p) { return fmt::format("({}, {}, {})", p.x, p.y, p.z); };
  return fmt::format(
      "{} x wanted {} gap {} jump {} stopped {} frame {} age {} ready {} offset {} clay {} passive "
      "{}\n",
      times, v(t.wanted_n), t.gap_us, t.clock_jump_us, t.clock_stopped, t.frame, t.frame_age_us,
      t.ready, v(t.jump_mm), t.clay_new, t.passive);
}

RC_GTEST_PROP(ForceGuardStorm, DoesNoHarm, ()) {
  Trial trial;
  const int phases = *rc::gen::inRange(1, 25);
  for (int phase = 0; phase < phases; ++phase) {
    if (*rc::gen::inRange(0, 4) == 0) {
      trial.rearm();
      trial.run(0.12, {});
      trial.run(*rc::gen::element(0.1, 1.0, 2.1), {.wanted_n = any_force()});
    }
    const Tick storm = any_tick();
    const int ticks = *rc::gen::element(1, 1, 2, 3, 7, 30, 80);
    RC_LOG() << describe(storm, ticks);
    for (int i = 0; i < ticks; ++i) trial.tick(storm);
    if (*rc::gen::inRange(0, 20) == 0) trial.tick({.command = Tick::Command::pause});
  }
  RC_ASSERT(trial.violations() == std::vector<std::string>());
}

TEST(ForceGuard, ReportsItsEvents) {
  Trial trial;
  const auto flags = [&](const Tick& tick) {
    trial.tick(tick);
    return trial.log().back().out.flags & ~kGuardSlewed;
  };
  const glm::dvec3 push(3.0, 0.0, 0.0);
  trial.engage(push);
  EXPECT_EQ(flags({.wanted_n = push}), 0u);
  EXPECT_EQ(flags({.wanted_n = {std::nan(""), 0, 0}}), kGuardNotFinite);
  EXPECT_EQ(flags({.wanted_n = 2.0 * push}), kGuardLimited);
  EXPECT_EQ(flags({.wanted_n = push, .jump_mm = {20, 0, 0}}), kGuardJump);
  EXPECT_EQ(flags({.wanted_n = push, .frame_age_us = 6'000}), kGuardStale);
  EXPECT_EQ(flags({.wanted_n = push, .gap_us = 12'000}), kGuardLate);
  EXPECT_EQ(flags({.wanted_n = push, .gap_us = 0}), kGuardClock);
  EXPECT_EQ(flags({.wanted_n = push, .ready = false}), kGuardNotReady);
  trial.engage(push);
  trial.run(0.11, {.wanted_n = push, .clay_new = false});
  EXPECT_EQ(trial.log().back().out.flags, kGuardOldClay);
}

TEST(ForceGuard, ReportsALimitedRise) {
  Trial trial;
  const glm::dvec3 push(1.0, 0.0, 0.0), jump(4.9, 0.0, 0.0);
  trial.engage(push);
  const auto slewed = [&] { return (trial.log().back().out.flags & kGuardSlewed) != 0; };
  trial.tick({.wanted_n = push});
  EXPECT_FALSE(slewed());
  trial.tick({.wanted_n = jump});
  EXPECT_TRUE(slewed());
  EXPECT_LT(trial.log().back().sent_n.x, jump.x);
  trial.run(0.2, {.wanted_n = jump});
  EXPECT_FALSE(slewed());
}

TEST(ForceGuard, NamesTheCauseOfSafe) {
  const auto cause = [](const Tick& tick, int times) {
    Trial trial;
    trial.engage({3.0, 0.0, 0.0});
    for (int i = 0; i < times; ++i) trial.tick(tick);
    return trial.log().back().out.cause;
  };
  EXPECT_EQ(cause({}, 1), SafeCause::none);
  EXPECT_EQ(cause({.wanted_n = {std::nan(""), 0, 0}}, 2), SafeCause::none);
  EXPECT_EQ(cause({.wanted_n = {std::nan(""), 0, 0}}, 3), SafeCause::not_finite);
  EXPECT_EQ(cause({.passive = false}, 1), SafeCause::not_passive);
  EXPECT_EQ(cause({.jump_mm = {20, 0, 0}}, 2), SafeCause::jumped);
  EXPECT_EQ(cause({.gap_us = 51'000}, 1), SafeCause::overrun);
  EXPECT_EQ(cause({.command = Tick::Command::pause}, 1), SafeCause::paused);
  EXPECT_EQ(cause({.command = Tick::Command::stop}, 1), SafeCause::stopped);
}

TEST(ForceGuard, RestsATenthOfASecondAfterAJump) {
  Trial trial;
  trial.engage({3.0, 0.0, 0.0});
  const Tick elsewhere{.jump_mm = {20.0, 0.0, 0.0}};
  trial.tick(elsewhere);
  trial.tick(elsewhere);
  trial.run(0.099, elsewhere);
  trial.expect_state(GuardState::safe);
  trial.run(0.002, elsewhere);
  trial.expect_state(GuardState::waiting);
  EXPECT_TRUE(trial.violations().empty()) << first_violations(trial);
}

TEST(ForceGuard, MinorCauseDoesNotUnlatchAMajorOne) {
  Trial trial;
  trial.engage({3.0, 0.0, 0.0});
  trial.tick({.passive = false});
  trial.tick({.gap_us = 100'000});
  trial.run(1.0, {});
  EXPECT_EQ(trial.log().back().out.cause, SafeCause::not_passive);
  trial.tick({.command = Tick::Command::stop});
  trial.rearm();
  EXPECT_EQ(trial.log().back().out.cause, SafeCause::stopped);
}

/// Accepted, it would move the clay's time ahead, and every later frame would be too old.
TEST(ForceGuard, DropsAFrameFromTheFuture) {
  ForceGuard guard = ForceGuard::build({}).value();
  std::int64_t now = 0;
  const auto deforms = [&](std::int64_t ahead_us) {
    now += 1000;
    const bool may = guard.admit(now, {now + ahead_us, glm::dvec3(0.0), true, true}).may_deform;
    const bool clock = (guard.force(now, {glm::dvec3(0.0), now, true}).flags & kGuardClock) != 0;
    EXPECT_NE(may, clock) << ahead_us;
    return may;
  };
  EXPECT_FALSE(deforms(3'600'000'000)) << "the first frame (its tick has no time either)";
  EXPECT_TRUE(deforms(0));
  for (const std::int64_t ahead_us : {std::int64_t{10'000}, std::int64_t{3'600'000'000}}) {
    EXPECT_FALSE(deforms(ahead_us)) << ahead_us;
    EXPECT_TRUE(deforms(0)) << "the next frame after one " << ahead_us << " us ahead";
  }
  EXPECT_FALSE(deforms(INT64_MAX - now - 2000));
  EXPECT_TRUE(deforms(9'999)) << "a clock of the device that is slightly ahead";
}

/// Without admit() the hand position is unknown, so an engaged force fades.
TEST(ForceGuard, FadesWithoutAdmittedSamples) {
  ForceGuard guard = ForceGuard::build({}).value();
  auto tick = [&guard, now = std::int64_t{0}](bool admits, double wanted_n) mutable {
    now += 1000;
    if (admits) (void)guard.admit(now, {now, glm::dvec3(0.0), true, true});
    return guard.force(now, {glm::dvec3(wanted_n, 0.0, 0.0), now, true}).force_n.x;
  };
  for (int i = 0; i < 10; ++i) (void)tick(true, 0.0);
  for (int i = 0; i < 2100; ++i) (void)tick(true, 3.0);
  EXPECT_EQ(tick(true, 3.0), 3.0);
  for (int i = 0; i < 9; ++i) (void)tick(false, 3.0);
  EXPECT_EQ(tick(false, 3.0), 0.0);
}

/// A device holds each force until the next tick, and without frames ticks are 1.5 periods apart.
TEST(ForceGuard, NoForceStandsLongerThan10MsAfterTheLastFrame) {
  for (const std::int64_t period_us : {250, 1000, 2500})
    for (std::int64_t first_us = period_us / 5; first_us <= period_us; first_us += period_us / 5) {
      const double period_s = 1e-6 * static_cast<double>(period_us);
      ForceGuard guard = ForceGuard::build({.period_s = period_s}).value();
      std::int64_t now = 0;
      const auto tick = [&](std::int64_t gap_us, bool frame, double wanted_n) {
        now += gap_us;
        (void)guard.admit(now, {now, glm::dvec3(0.0), frame, true});
        return guard.force(now, {glm::dvec3(wanted_n, 0.0, 0.0), now, true}).force_n.x;
      };
      for (int i = 0; i < 10; ++i) (void)tick(period_us, true, 0.0);
      for (int i = 0; i < 10'000; ++i) (void)tick(period_us, true, 3.0);
      ASSERT_EQ(tick(period_us, true, 3.0), 3.0);
      const std::int64_t last_us = now;
      for (double force = tick(first_us, false, 3.0); force > 0.0;
           force = tick(period_us * 3 / 2, false, 3.0))
        ASSERT_LT(now - last_us, 10'000) << period_us << " us, first " << first_us;
      EXPECT_LE(now - last_us, 10'000) << period_us << " us, first " << first_us;
    }
}

/// A controller starts at zero inside the clay; the force may engage only outside.
TEST(ForceGuard, WaitsWhileTheContactRequestsAForce) {
  ForceGuard guard = ForceGuard::build({}).value();
  auto state = [&guard, now = std::int64_t{0}](double contact_n) mutable {
    GuardState last = GuardState::idle;
    for (int i = 0; i < 10; ++i) {
      now += 1000;
      (void)guard.admit(now, {now, glm::dvec3(0.0), true, true});
      last = guard.force(now, {.clay_time_us = now, .contact_n = contact_n}).state;
    }
    return last;
  };
  for (const double contact_n : {3.0, 0.2, std::nan(""), HUGE_VAL})
    EXPECT_EQ(state(contact_n), GuardState::waiting) << contact_n;
  EXPECT_EQ(state(0.19), GuardState::ramping);
  EXPECT_EQ(state(3.0), GuardState::ramping) << "once engaged, the contact is what it is for";
}

TEST(ForceGuard, RisesFromZeroAfterTheWatchdog) {
  ForceGuard guard = ForceGuard::build({}).value();
  std::int64_t now = 0;
  const auto tick = [&guard, &now](double wanted_n) {
    now += 1000;
    (void)guard.admit(now, {now, glm::dvec3(0.0), true, true});
    return guard.force(now, {glm::dvec3(wanted_n, 0.0, 0.0), now, true}).force_n.x;
  };
  for (int i = 0; i < 10; ++i) (void)tick(0.0);
  for (int i = 0; i < 2100; ++i) (void)tick(3.0);
  EXPECT_EQ(tick(3.0), 3.0);
  guard.was_zeroed();
  EXPECT_EQ(tick(3.0), 0.5);
}

}  // namespace
}  // namespace clay::falcon
