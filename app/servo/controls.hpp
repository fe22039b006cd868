#pragma once
// Controls beside the motion of the hand: buttons of the device, or commands from another thread.

#include "claystack/servo/servo.hpp"
#include "core/spsc_queue.hpp"

#include <cstdint>
#include <optional>

namespace clay::servo {

/// One thread sends the commands; the servo receives them.
using Commands = SpscQueue<Command, 64>;

/// A button that is held repeats after a delay: 36 mm in four seconds.
inline constexpr std::int64_t kGapWaitUs = 400'000, kGapEveryUs = 50'000;

class Controls {
 public:
  /// `pinches`: the scene permits poses with a gap.
  Controls(const ButtonMap& buttons, bool pinches, double gap_mm) noexcept
      : map_(buttons), pinches_(pinches), gap_mm_(pinches ? gap_mm : 0.0) {}

  /// Call once per tick. If the device measures a grip, the grip sets the gap.
  void update(std::int64_t now_us, unsigned buttons, Commands& commands,
              std::optional<double> grip_mm = std::nullopt) noexcept;

  [[nodiscard]] bool clutched() const noexcept { return clutch_held_ || clutch_requested_; }
  [[nodiscard]] bool paused() const noexcept { return paused_; }
  [[nodiscard]] bool trim() const noexcept { return trim_held_ || trim_requested_; }
  [[nodiscard]] double gap_mm() const noexcept { return gap_mm_; }
  [[nodiscard]] bool stopped() const noexcept { return stopped_; }
  /// In this tick, the most recent request.
  [[nodiscard]] bool zero() const noexcept { return zero_; }
  [[nodiscard]] bool rearm() const noexcept { return rearm_; }

 private:
  void apply(const Command& command) noexcept;
  void step_gap(std::int64_t now_us, unsigned buttons) noexcept;
  void set_gap(double mm) noexcept;

  ButtonMap map_;
  bool pinches_;
  double gap_mm_;
  unsigned before_ = 0;          // buttons of the previous tick
  std::int64_t gap_due_us_ = 0;  // time at which a held button repeats
  bool clutch_held_ = false, clutch_requested_ = false;
  bool trim_held_ = false, trim_requested_ = false;
  bool paused_ = false, stopped_ = false, zero_ = false, rearm_ = false;
};

}  // namespace clay::servo
