#pragma once
// The clay's side of a tick: where a pose is played, recorded, or only felt.

#include "app/servo/recorder.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstdint>

namespace clay::servo {

/// With a clay rate below the servo's, the clay is deformed at the first believable sample of each
/// of its own periods, and that pose alone is recorded. In the ticks between, the force is computed
/// anew at the tool's place from the clay as it was left: contact and spring, no removal, no flow.
class LiveClay {
 public:
  /// Both outlive this. `period_us`: of the clay; 0: every sample deforms it. No recorder: nothing
  /// is recorded.
  LiveClay(Wheel& wheel, Recorder* recorder, std::int64_t period_us) noexcept
      : wheel_(wheel), recorder_(recorder), period_us_(period_us) {}

  /// The clay's force [N] on the tool at `pose`, of a sample that may deform it. Poses that the
  /// wheel refuses, or whose time does not advance, are neither played nor recorded.
  [[nodiscard]] StepReport meet(const Pose& pose) noexcept;

  [[nodiscard]] const Wheel& wheel() const noexcept { return wheel_; }
  [[nodiscard]] std::uint64_t poses() const noexcept { return poses_; }  ///< played

 private:
  Wheel& wheel_;
  Recorder* recorder_;
  std::int64_t period_us_;
  std::int64_t due_us_ = 0, last_us_ = -1;
  std::uint64_t poses_ = 0;
};

}  // namespace clay::servo
