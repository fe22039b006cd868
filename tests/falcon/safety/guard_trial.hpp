#pragma once
// A servo on a virtual clock, with a moving hand, a device, clay and a watchdog, that runs any
// sequence of faults. Each tick is logged and checked against bounds on the force. The bounds are
// computed from the faults alone, independently of the guard.

#include "claystack/falcon/guard.hpp"
#include "falcon/safety/basic_guard.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

namespace clay::falcon::inline safety {

/// The input of one tick. The defaults are a tick without a fault and without a requested force.
struct Tick {
  glm::dvec3 wanted_n{0.0};
  std::int64_t gap_us = 1000;      ///< true time since the last tick
  std::int64_t clock_jump_us = 0;  ///< added to the clock reading
  bool clock_stopped = false;      ///< the clock reads the same as before
  bool frame = true;               ///< a new frame arrived
  std::int64_t frame_age_us = 0;   ///< age of the frame
  bool ready = true;
  bool frozen = false;      ///< the hand does not move
  glm::dvec3 jump_mm{0.0};  ///< position error of the frame: 0, or at least 12 mm
  bool clay_new = true;
  bool passive = true;
  enum class Command { none, pause, stop, rearm } command = Command::none;
};

struct NamedGuardRule {
  GuardRule rule;
  const char* name;
};

inline constexpr NamedGuardRule kGuardRules[] = {
    {kRuleFinite, "finite force"},
    {kRuleNotFiniteLatch, "SAFE after three invalid values"},
    {kRuleLimit, "limit of the norm"},
    {kRuleSlew, "slew"},
    {kRuleSmallForce, "small force first"},
    {kRuleRamp, "ramp"},
    {kRuleReady, "ready or zero"},
    {kRuleStaleFrames, "stale frames fade"},
    {kRuleRecovery, "slow recovery"},
    {kRulePause, "re-engagement after a pause"},
    {kRuleJump, "jumps"},
    {kRuleStep, "step within bounds"},
    {kRuleLate, "late tick is zero"},
    {kRuleOverrun, "SAFE after an overrun"},
    {kRuleOldClay, "old clay fades"},
    {kRulePassive, "SAFE if not passive"},
    {kRuleHeat, "heat"},
    {kRuleLatch, "SAFE holds"},
    {kRuleStop, "stop is permanent"},
};

/// A guard from which one rule can be removed.
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
  double rise_n;  ///< rise of the force; see beyond()
  GuardedForce out;
  Admission admission;
};

/// The bounds after the faults so far. Never stricter than the rules: if rounding decides the
/// outcome, both outcomes are allowed.
class Allowance {
 public:
  struct Verdict {
    bool zero = false;    ///< the force must be 0 in this tick
    bool deform = true;   ///< the clay may be deformed
    double max_n = 0.0;   ///< the largest force of the ramp
    double rise_n = 0.0;  ///< the largest rise
  };
  /// `clock_s`: time since the last tick by the clock.
  Verdict after(const Tick& tick, double clock_s, const GuardSample& sample);

 private:
  void apply(Tick::Command command);
  bool accepts_position(const Tick& tick, const GuardSample& sample);
  void follow_ages(const Tick& tick, double clock_s, bool good);
  void follow_ramp(const Tick& tick, double growing_s);
  void follow_fade(double growing_s, bool ends);
  void reset_ramp() { small_ticks_ = 0, ramp_s_ = 0.0, ramping_ = false; }

  bool latched_ = false, stopped_ = false, zero_ = false;
  int odd_ticks_ = 0;
  bool position_known_ = false, suspected_ = false, any_frame_ = false;
  int unsure_frames_ = 0;
  std::int64_t stamp_us_ = 0;
  glm::dvec3 accepted_mm_{0.0};
  double frame_age_s_ = 0.0, clay_age_s_ = 0.0;
  int small_ticks_ = 0;
  bool ramping_ = false;
  double ramp_s_ = 0.0;
  double kept_ = 1.0;  ///< part of the force that the fades have left
};

class Trial {
 public:
  explicit Trial(std::uint32_t removed_rule = 0) : guard_(guard_without(removed_rule)) {}

  void tick(const Tick& tick);
  void run(double seconds, const Tick& tick);
  /// Approaches without force, then requests this force until the ramp is complete.
  void engage(const glm::dvec3& wanted_n);
  void rearm() { tick({.command = Tick::Command::rearm}); }

  /// Checks the last tick.
  void expect_force(const glm::dvec3& force_n);
  void expect_state(GuardState state);
  void expect(bool held, const std::string& what);

  [[nodiscard]] const std::vector<LogEntry>& log() const { return log_; }
  [[nodiscard]] const std::vector<std::string>& violations() const { return violations_; }

 private:
  GuardSample sample_of(const Tick& tick);
  void run_watchdog(std::int64_t beat_us);
  void check_bounds(const Allowance::Verdict& allowed, const LogEntry& entry);
  void check_heat(double sent_n, double clock_s);

  std::unique_ptr<TriedGuard> guard_;
  Allowance allowance_;
  std::int64_t true_us_ = 0, clock_us_ = 1'000'000, clay_us_ = 0;
  std::int64_t hand_us_ = 0;
  GuardSample last_sample_;
  glm::dvec3 sent_n_{0.0};
  double gain_ = 0.0, hot_s_ = 0.0;
  std::vector<LogEntry> log_;
  std::vector<std::string> violations_;
};

}  // namespace clay::falcon::inline safety
