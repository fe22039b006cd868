#include "tests/falcon/safety/guard_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <utility>

namespace clay::falcon::inline safety {
namespace {

constexpr double kLimitN = 5.0, kSlewNPerS = 500.0, kSmallN = 0.2, kRampS = 2.0, kPeriodS = 0.001;
constexpr double kZeroS = 0.010, kPauseS = 0.050, kClayZeroS = 0.150, kOldFrameS = 0.005;
constexpr double kFrameZeroS = 0.0085;  // a tick later, 1.5 periods, is not after 10 ms
constexpr double kRecoveryS = 0.5;
constexpr double kHotN = 4.0, kHotS = 11.0;  // 10 s and the fade
constexpr int kSmallTicks = 5, kOddTicks = 3;
constexpr double kRoundingN = 1e-12, kRoundingS = 1e-9;

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Squares of doubles of 53 bits, summed in 64: exact enough to detect one ulp.
bool within_limit(const glm::dvec3& v) {
  const auto square = [](double x) { return static_cast<long double>(x) * x; };
  return square(v.x) + square(v.y) + square(v.z) <= square(kLimitN);
}

/// Distance from `force` to the segment from 0 to `before`.
double beyond(const glm::dvec3& force, const glm::dvec3& before) {
  const double length = glm::length(before);
  if (length == 0.0) return glm::length(force);
  const double along = glm::dot(force, before / length);
  if (along <= 0.0) return glm::length(force);
  if (along >= length) return glm::length(force - before);
  return glm::length(force - along * (before / length));
}

std::int64_t sum(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}

template <std::uint32_t rules>
class GuardOf final : public TriedGuard {
 public:
  Admission admit(std::int64_t now_us, const GuardSample& sample) override {
    return guard_.admit(now_us, sample);
  }
  GuardedForce force(std::int64_t now_us, const WantedForce& wanted) override {
    return guard_.force(now_us, wanted);
  }
  void apply(Tick::Command command) override {
    if (command == Tick::Command::pause) guard_.pause();
    if (command == Tick::Command::stop) guard_.stop();
    if (command == Tick::Command::rearm) guard_.rearm();
  }

 private:
  BasicForceGuard<rules> guard_{GuardSettings{}};
};

template <std::uint32_t rules>
std::unique_ptr<TriedGuard> make_guard() {
  return std::make_unique<GuardOf<rules>>();
}

template <std::size_t... k>
constexpr auto makers(std::index_sequence<k...>) {
  return std::array{&make_guard<kAllGuardRules & ~kGuardRules[k].rule>...};
}

}  // namespace

std::unique_ptr<TriedGuard> guard_without(std::uint32_t rule) {
  if (rule == 0) return std::make_unique<GuardOf<kAllGuardRules>>();
  static constexpr auto kMakers = makers(std::make_index_sequence<std::size(kGuardRules)>{});
  for (std::size_t k = 0; k < kMakers.size(); ++k)
    if (kGuardRules[k].rule == rule) return kMakers[k]();
  return nullptr;
}

void Allowance::apply(Tick::Command command) {
  if (command == Tick::Command::rearm) {
    latched_ = stopped_;
    reset_ramp();
  } else if (command != Tick::Command::none) {
    latched_ = true;
    stopped_ = stopped_ || command == Tick::Command::stop;
  }
}

/// Whether the position of the frame is accepted; two rejected jumps in a row are a lasting one.
bool Allowance::accepts_position(const Tick& tick, const GuardSample& sample) {
  const bool again = sample.time_us == stamp_us_;
  stamp_us_ = sample.time_us;
  if (!tick.ready) position_known_ = suspected_ = any_frame_ = false;
  if (!tick.ready || !tick.frame || again || !finite(sample.position_mm)) return false;
  if (position_known_ && unsure_frames_ == 0 && tick.jump_mm != accepted_mm_) {
    if (suspected_) {
      zero_ = true;
      position_known_ = false;
      reset_ramp();
    }
    suspected_ = !suspected_;
    return false;
  }
  // After three frames in one place the guard has accepted that position in any case.
  if (unsure_frames_ > 0) unsure_frames_ = (tick.jump_mm != accepted_mm_ ? 3 : unsure_frames_) - 1;
  position_known_ = any_frame_ = true;
  accepted_mm_ = tick.jump_mm;
  suspected_ = false;
  return true;
}

void Allowance::follow_ages(const Tick& tick, double clock_s, bool good) {
  const double passed = std::max(clock_s, kShortestStepS);
  frame_age_s_ = good ? static_cast<double>(tick.frame_age_us) / 1e6 : frame_age_s_ + passed;
  clay_age_s_ = tick.clay_new ? 0.0 : clay_age_s_ + passed;
  if (frame_age_s_ >= kFrameZeroS + kRoundingS || clay_age_s_ >= kClayZeroS + kRoundingS)
    zero_ = true;
  if (frame_age_s_ > 0.8 * kPauseS) unsure_frames_ = 3;  // the guard may have dropped the position
  if (frame_age_s_ > kPauseS + kRoundingS || clay_age_s_ >= kClayZeroS + kRoundingS) reset_ramp();
  if (clock_s >= kZeroS) zero_ = true;
  if (clock_s > kPauseS) reset_ramp();
}

void Allowance::follow_ramp(const Tick& tick, double growing_s) {
  if (latched_ || !tick.ready || !any_frame_) return reset_ramp();
  const bool small = finite(tick.wanted_n) && glm::length(tick.wanted_n) < kSmallN;
  if (!ramping_) small_ticks_ = small ? small_ticks_ + 1 : 0;
  ramping_ = ramping_ || small_ticks_ >= kSmallTicks;
  if (ramping_) ramp_s_ += growing_s;
}

/// A force that was reduced by old frames, a late tick or an invalid value returns slowly. After a
/// pause the ramp decides. A frame whose position is unsure may not have been accepted, so its age
/// decides nothing.
void Allowance::follow_fade(double growing_s, bool ends) {
  const double end_s = kFrameZeroS + kRoundingS;
  const bool fades = any_frame_ && unsure_frames_ == 0 && frame_age_s_ < 0.8 * kPauseS;
  const double left = fades ? (end_s - frame_age_s_) / (end_s - kOldFrameS) : 1.0;
  kept_ = ends ? 0.0 : std::clamp(left, 0.0, std::min(1.0, kept_ + growing_s / kRecoveryS));
}

Allowance::Verdict Allowance::after(const Tick& tick, double clock_s, const GuardSample& sample) {
  zero_ = false;
  apply(tick.command);
  const bool was_latched = latched_;
  const bool odd = !finite(tick.wanted_n) || (tick.ready && !finite(sample.position_mm));
  odd_ticks_ = odd ? odd_ticks_ + 1 : 0;
  if (odd_ticks_ >= kOddTicks || !tick.passive) latched_ = true;
  const bool good = accepts_position(tick, sample);
  follow_ages(tick, clock_s, good);
  const double growing = std::clamp(clock_s, 0.0, kPeriodS);
  follow_ramp(tick, growing);
  follow_fade(growing, odd || clock_s >= kZeroS);
  return {zero_ || odd || latched_ || !tick.ready,
          good && !was_latched && frame_age_s_ < kOldFrameS,
          kLimitN * kept_ * std::min(1.0, ramp_s_ / kRampS), kSlewNPerS * growing};
}

GuardSample Trial::sample_of(const Tick& tick) {
  if (!tick.frozen) hand_us_ += tick.gap_us;
  const double angle = std::numbers::pi * static_cast<double>(hand_us_) / 1e6;
  if (tick.frame)
    last_sample_ = {sum(clock_us_, -tick.frame_age_us),
                    glm::dvec3(0.0, 0.0, 10.0 * std::sin(angle)) + tick.jump_mm, true, tick.ready};
  GuardSample sample = last_sample_;
  sample.fresh = tick.frame;
  sample.ready = tick.ready;
  return sample;
}

void Trial::tick(const Tick& tick) {
  const std::int64_t before_us = clock_us_;
  true_us_ += tick.gap_us;
  clock_us_ = sum(clock_us_, sum(tick.clock_stopped ? 0 : tick.gap_us, tick.clock_jump_us));
  if (tick.clay_new) clay_us_ = clock_us_;
  guard_->apply(tick.command);

  const GuardSample sample = sample_of(tick);
  const double clock_s = clock_us_ > before_us
                             ? static_cast<double>(static_cast<std::uint64_t>(clock_us_) -
                                                   static_cast<std::uint64_t>(before_us)) /
                                   1e6
                             : 0.0;
  const auto allowed = allowance_.after(tick, log_.empty() ? 0.0 : clock_s, sample);

  run_watchdog(before_us);
  LogEntry entry{};
  entry.time_s = static_cast<double>(true_us_) / 1e6;
  entry.admission = guard_->admit(clock_us_, sample);
  entry.out = guard_->force(clock_us_, {tick.wanted_n, clay_us_, tick.passive});
  entry.sent_n = entry.out.force_n;
  entry.rise_n = beyond(entry.sent_n, sent_n_);
  check_bounds(allowed, entry);
  check_heat(glm::length(entry.sent_n), clock_s);
  sent_n_ = entry.sent_n;
  gain_ = entry.out.gain;
  log_.push_back(entry);
}

/// Between two ticks the device holds the last force, unless the watchdog zeroes it.
void Trial::run_watchdog(std::int64_t beat_us) {
  const std::int64_t look_us = Watchdog::next_look_us(beat_us);
  const bool fires = look_us <= clock_us_ && Watchdog::must_zero(beat_us, look_us);
  if (fires) sent_n_ = glm::dvec3(0.0);
  expect(fires || clock_us_ < beat_us || clock_us_ - beat_us < 10'000, "held longer than 10 ms");
}

void Trial::check_bounds(const Allowance::Verdict& allowed, const LogEntry& entry) {
  const double sent = glm::length(entry.sent_n), gain = entry.out.gain;
  expect(finite(entry.sent_n), "force is not finite");
  expect(within_limit(entry.sent_n), "force above the limit");
  expect(entry.rise_n <= allowed.rise_n + kRoundingN, "force rises too fast");
  expect(sent <= allowed.max_n + kRoundingN, "force above the ramp");
  expect(!allowed.zero || sent == 0.0, "force must be zero");
  expect(allowed.deform || !entry.admission.may_deform,
         "clay deformed without a valid hand position");
  const double step = entry.admission.step_s;
  expect(step >= kShortestStepS && step <= kLongestStepS, "step out of bounds");
  const bool fading = entry.out.state == GuardState::fading;
  expect(gain >= gain_ || gain == 0.0 || fading, "ramp falls");
  expect(gain - gain_ <= allowed.rise_n / kSlewNPerS / kRecoveryS + kRoundingN,
         "ramp rises too fast");
  const bool resting = entry.out.state == GuardState::idle || entry.out.state == GuardState::safe ||
                       entry.out.state == GuardState::waiting;
  expect(!resting || sent == 0.0, "force in a resting state");
}

void Trial::check_heat(double sent_n, double clock_s) {
  hot_s_ = sent_n > kHotN ? hot_s_ + std::clamp(clock_s, 0.0, kPeriodS) : 0.0;
  expect(hot_s_ <= kHotS, "motors hot for too long");
}

void Trial::run(double seconds, const Tick& tick) {
  const auto end_us = true_us_ + static_cast<std::int64_t>(std::llround(seconds * 1e6));
  while (true_us_ < end_us) this->tick(tick);
}

void Trial::engage(const glm::dvec3& wanted_n) {
  run(0.15, {});
  run(kRampS + 0.01, {.wanted_n = wanted_n});
  expect_force(wanted_n);
}

void Trial::expect_force(const glm::dvec3& force_n) {
  expect(glm::length(sent_n_ - force_n) <= 1e-9, "unexpected force");
}

void Trial::expect_state(GuardState state) {
  expect(log_.back().out.state == state, "unexpected state");
}

void Trial::expect(bool held, const std::string& what) {
  if (held) return;
  violations_.push_back(std::to_string(static_cast<double>(true_us_) / 1e6) + " s: " + what);
}

}  // namespace clay::falcon::inline safety
