// Random settings, motions, clocks and commands. In any order of events the force stays within the
// bounds that the settings state. force_guard_test.cpp has sharper bounds, for the default
// settings.

#include "claystack/falcon/guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace clay::falcon {
namespace {

constexpr double kRoundingN = 1e-12;

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  bool one_in(unsigned n) { return engine_() % n == 0; }
  unsigned below(unsigned n) { return static_cast<unsigned>(engine_() % n); }
  /// Of any magnitude up to 10^most.
  double any_magnitude(double most) { return std::pow(10.0, between(0.0, most)); }
  glm::dvec3 any_direction() {
    const glm::dvec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
    return glm::length(v) > 0.1 ? glm::normalize(v) : glm::dvec3(1.0, 0.0, 0.0);
  }
  double any_extreme_number() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    constexpr double kNumbers[] = {
        std::numeric_limits<double>::quiet_NaN(), kInf, -kInf, 1e308, -1e308, 5e-324};
    return kNumbers[below(std::size(kNumbers))];
  }

 private:
  std::mt19937_64 engine_;
};

GuardSettings any_settings(Dice& dice) {
  GuardSettings s;
  do {
    s.period_s = 1e-4 * dice.between(1.0, 25.0);
    s.force_limit_n = dice.between(0.3, kMostForceN);
    s.slew_n_per_s = dice.any_magnitude(3.6);
    s.ramp_s = dice.between(0.1, 2.0);
    s.hot_force_n = s.force_limit_n * dice.between(0.5, 1.0);
    s.hot_time_s = dice.between(0.1, 2.0);
    s.small_force_ticks = 1 + static_cast<int>(dice.below(8));
    s.stale_fade_s = dice.between(2.0 * s.period_s, 0.008);
    s.stale_zero_s = dice.between(s.stale_fade_s, kLongestToZeroS);
    s.late_zero_s = dice.between(2.0 * s.period_s, kLongestToZeroS);
    s.not_finite_ticks = 1 + static_cast<int>(dice.below(5));
  } while (!check(s));
  return s;
}

/// The distance to the nearest fraction of the last force.
double rise(const glm::dvec3& now, const glm::dvec3& before) {
  const double square = glm::dot(before, before);
  const double part = square > 0.0 ? std::clamp(glm::dot(now, before) / square, 0.0, 1.0) : 0.0;
  return glm::distance(now, part * before);
}

bool within(const glm::dvec3& force, double limit) {
  const auto square = [](double x) { return static_cast<long double>(x) * x; };
  return square(force.x) + square(force.y) + square(force.z) <= square(limit);
}

class Attack {
 public:
  explicit Attack(unsigned seed)
      : dice_(seed), settings_(any_settings(dice_)), guard_(ForceGuard::build(settings_).value()) {}

  void run(int ticks) {
    for (int i = 0; i < ticks && !testing::Test::HasFailure(); ++i) tick();
  }
  [[nodiscard]] int forced() const { return forced_; }

 private:
  void command() {
    if (dice_.one_in(700)) guard_.pause(), held_ = true;
    if (dice_.one_in(held_ ? 80 : 300)) held_ = !guard_.rearm();
    if (dice_.one_in(20'000)) guard_.stop(), held_ = true;
    if (dice_.one_in(300)) guard_.was_zeroed(), sent_n_ = glm::dvec3(0.0);
    if (dice_.one_in(ready_ ? 500 : 20)) ready_ = !ready_;
  }

  /// Moves at a hand's speed, and changes the requested force from time to time.
  void move() {
    if (dice_.one_in(200)) speed_mm_s_ = dice_.between(0.0, 300.0) * dice_.any_direction();
    if (glm::length(hand_mm_) > 50.0) hand_mm_ = glm::dvec3(0.0);
    hand_mm_ += settings_.period_s * speed_mm_s_;
    if (dice_.one_in(100))
      wanted_n_ = (dice_.one_in(2) ? 0.1 : dice_.any_magnitude(12.0)) * dice_.any_direction();
  }

  /// One of the faults that a tick can have; often none.
  void disturb(GuardSample& sample, WantedForce& wanted, double& gap_us) {
    if (dice_.one_in(500)) storm_ticks_ = dice_.below(60);
    if (storm_ticks_ == 0) return;
    --storm_ticks_;
    switch (dice_.below(12)) {
      case 0:
        wanted.force_n[static_cast<int>(dice_.below(3))] = dice_.any_extreme_number();
        break;
      case 1:
        sample.position_mm[static_cast<int>(dice_.below(3))] = dice_.any_extreme_number();
        break;
      case 2:
        gap_us = dice_.any_magnitude(9.0);
        break;
      case 3:
        gap_us = -dice_.any_magnitude(9.0);
        break;
      case 4:
        sample.fresh = false;
        break;
      case 5:
        sample.time_us -= static_cast<std::int64_t>(dice_.between(-60e3, 60e3));
        break;
      case 6:
        sample.position_mm += dice_.between(0.0, 100.0) * dice_.any_direction();
        break;
      case 7:
        wanted.passive = !dice_.one_in(8);
        break;
      case 8:
        wanted.clay_time_us -= static_cast<std::int64_t>(dice_.between(0.0, 300e3));
        break;
      default:
        break;
    }
  }

  void tick() {
    command();
    move();
    GuardSample sample{0, hand_mm_, true, ready_};
    WantedForce wanted{wanted_n_, 0, true};
    double gap_us = 1e6 * settings_.period_s;
    disturb(sample, wanted, gap_us);
    now_us_ += static_cast<std::int64_t>(gap_us);
    sample.time_us += now_us_;
    wanted.clay_time_us += now_us_;
    (void)guard_.admit(now_us_, sample);
    const GuardedForce out = guard_.force(now_us_, wanted);
    const double real_s = gap_us > 0.0 && ticks_ > 0 ? 1e-6 * std::floor(gap_us) : 0.0;
    check_bounds(out, sample, wanted, real_s);
    sent_n_ = out.force_n;
    ++ticks_;
  }

  void check_bounds(const GuardedForce& out, const GuardSample& sample, const WantedForce& wanted,
                    double real_s) {
    const double n = glm::length(out.force_n), growing_s = std::min(real_s, settings_.period_s);
    forced_ += n > 0.01 ? 1 : 0;
    EXPECT_TRUE(within(out.force_n, settings_.force_limit_n)) << ticks_;
    EXPECT_LE(rise(out.force_n, sent_n_), settings_.slew_n_per_s * growing_s + kRoundingN)
        << ticks_;
    const bool finite = std::isfinite(glm::length(wanted.force_n / 1e308)) &&
                        std::isfinite(glm::length(sample.position_mm / 1e308));
    const bool before_the_ramp = out.state == GuardState::safe || out.state == GuardState::idle ||
                                 out.state == GuardState::waiting;
    const bool zero = before_the_ramp || !ready_ || held_ || !wanted.passive || !finite ||
                      real_s >= settings_.late_zero_s;
    EXPECT_TRUE(n == 0.0 || !zero) << ticks_ << ": " << n << " N";
    // The ramp may begin in the last tick that waits.
    ramp_s_ = before_the_ramp ? settings_.period_s : ramp_s_ + growing_s;
    EXPECT_LE(n, settings_.force_limit_n * ramp_s_ / settings_.ramp_s + 1e-9) << ticks_;
  }

  Dice dice_;
  GuardSettings settings_;
  ForceGuard guard_;
  std::int64_t now_us_ = 1'000'000'000'000;
  glm::dvec3 hand_mm_{0.0}, speed_mm_s_{0.0}, wanted_n_{0.0}, sent_n_{0.0};
  bool ready_ = true, held_ = false;
  unsigned storm_ticks_ = 0;
  double ramp_s_ = 0.0;
  int ticks_ = 0, forced_ = 0;
};

TEST(ForceGuardAttack, NoOrderOfEventsExceedsTheBounds) {
  int forced = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Attack attack(seed);
    attack.run(6000);
    forced += attack.forced();
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  EXPECT_GT(forced, 20'000) << "of 240,000 ticks";
}

}  // namespace
}  // namespace clay::falcon
