#pragma once
// A servo on a virtual clock, with a hand that moves, a device, clay and a watchdog, that goes
// through any sequence of faults. Each tick is logged and held against what must be true of the
// force whatever the guard thinks: the bounds are counted here anew from the faults alone.

#include "claystack/falcon/guard.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace clay::falcon::inline safety {

/// All that can happen in a tick; as it stands, all is well and nothing is wanted.
struct Tick {
  glm::dvec3 wanted_n{0.0};
  std::int64_t gap_us = 1000;      ///< since the last tick, in truth
  std::int64_t clock_leap_us = 0;  ///< the clock says so much more
  bool clock_stands = false;       ///< or the same as before
  bool frame = true;               ///< a new frame came
  std::int64_t frame_age_us = 0;   ///< so long ago
  bool ready = true;
  bool frozen = false;      ///< the hand does not move
  glm::dvec3 leap_mm{0.0};  ///< the frame puts the hand so far off: 0, or 12 mm or more
  bool clay_new = true;
  bool passive = true;
  enum class Command { none, pause, stop, rearm } command = Command::none;
};

/// A guard of which rules may be left out.
class TriedGuard {
 public:
  virtual ~TriedGuard() = default;
  virtual Admission admit(std::int64_t now_us, const GuardSample& sample) = 0;
  virtual GuardedForce force(std::int64_t now_us, const WantedForce& wanted) = 0;
  virtual void apply(Tick::Command command) = 0;
};

/// One of kGuardRules, or 0 for the guard that programs use.
[[nodiscard]] std::unique_ptr<TriedGuard> guard_without(std::uint32_t rule);

struct LogEntry {
  double time_s;
  glm::dvec3 sent_n;
  double rise_n;  ///< how far the force went beyond letting go
  GuardedForce out;
  Admission admission;
};

/// What the faults so far allow. Never stricter than the rules are: where a fault makes their
/// outcome depend on rounding, it allows both.
class Allowance {
 public:
  struct Verdict {
    bool zero = false;    ///< the force must be 0 in this tick
    bool deform = true;   ///< the clay may be deformed
    double most_n = 0.0;  ///< what can have been earned
    double rise_n = 0.0;  ///< what it may grow by
  };
  /// `told_s`: how much later the clock is than before.
  Verdict after(const Tick& tick, double told_s, const GuardSample& sample);

 private:
  void apply(Tick::Command command);
  bool believable(const Tick& tick, const GuardSample& sample);
  void follow_ages(const Tick& tick, double told_s, bool good);
  void earn(const Tick& tick, double growing_s);
  void lose() { small_ticks_ = 0, earned_s_ = 0.0, ramping_ = false; }

  bool latched_ = false, stopped_ = false, zero_ = false;
  int odd_ticks_ = 0;
  bool place_known_ = false, suspected_ = false, any_frame_ = false;
  int unsure_frames_ = 0;
  std::int64_t stamp_us_ = 0;
  glm::dvec3 believed_mm_{0.0};
  double frame_age_s_ = 0.0, clay_age_s_ = 0.0;
  int small_ticks_ = 0;
  bool ramping_ = false;
  double earned_s_ = 0.0;
};

class Trial {
 public:
  explicit Trial(std::uint32_t removed_rule = 0) : guard_(guard_without(removed_rule)) {}

  void tick(const Tick& tick);
  void run(double seconds, const Tick& tick);
  /// The hand comes with nothing in its way, then this is wanted until it is all earned.
  void engage(const glm::dvec3& wanted_n);
  void rearm() { tick({.command = Tick::Command::rearm}); }

  /// Holds the last tick against this.
  void expect_force(const glm::dvec3& force_n);
  void expect_state(GuardState state);
  void expect(bool held, const std::string& what);

  [[nodiscard]] const std::vector<LogEntry>& log() const { return log_; }
  [[nodiscard]] const std::vector<std::string>& violations() const { return violations_; }

 private:
  GuardSample sample_of(const Tick& tick);
  void watchdog_looks(std::int64_t beat_us);
  void hold_against(const Allowance::Verdict& allowed, const LogEntry& entry);
  void hold_heat(double sent_n, double told_s);

  std::unique_ptr<TriedGuard> guard_;
  Allowance allowance_;
  std::int64_t true_us_ = 0, told_us_ = 1'000'000, clay_us_ = 0;
  std::int64_t hand_us_ = 0;
  GuardSample last_sample_;
  glm::dvec3 sent_n_{0.0};
  double gain_ = 0.0, hot_s_ = 0.0;
  std::vector<LogEntry> log_;
  std::vector<std::string> violations_;
};

}  // namespace clay::falcon::inline safety
