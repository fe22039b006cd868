#include "app/servo/controls.hpp"

#include <algorithm>

namespace clay::servo {

void Controls::update(std::int64_t now_us, unsigned buttons, Commands& commands,
                      std::optional<double> grip_mm) noexcept {
  zero_ = rearm_ = false;
  while (const auto command = commands.pop()) apply(*command);
  clutch_held_ = (buttons & map_.clutch) != 0;
  trim_held_ = (buttons & map_.trim) != 0;
  step_gap(now_us, buttons);
  if (grip_mm) set_gap(*grip_mm);
}

/// At each press, and repeatedly while the button is held.
void Controls::step_gap(std::int64_t now_us, unsigned buttons) noexcept {
  const unsigned either = map_.wider | map_.narrower;
  const unsigned pressed = buttons & ~before_ & either;
  const unsigned held = buttons & before_ & either;
  before_ = buttons;
  if (pressed == 0 && (held == 0 || now_us < gap_due_us_)) return;
  // Missed steps are not repeated.
  gap_due_us_ = pressed != 0 ? now_us + kGapWaitUs : std::max(gap_due_us_ + kGapEveryUs, now_us);
  const unsigned moves = pressed != 0 ? pressed : held;
  if ((moves & map_.wider) != 0) set_gap(gap_mm_ + kGapStepMm);
  if ((moves & map_.narrower) != 0) set_gap(gap_mm_ - kGapStepMm);
}

void Controls::apply(const Command& command) noexcept {
  const bool on = command.value != 0.0;
  switch (command.kind) {
    case CommandKind::clutch:
      clutch_requested_ = on;
      break;
    case CommandKind::trim:
      trim_requested_ = on;
      break;
    case CommandKind::pause:
      paused_ = on;
      break;
    case CommandKind::gap:
      set_gap(command.value);
      break;
    case CommandKind::zero:
      zero_ = true;
      rearm_ = false;
      break;
    case CommandKind::rearm:
      rearm_ = true;
      zero_ = false;
      break;
    case CommandKind::stop:
      stopped_ = true;
      break;
  }
}

void Controls::set_gap(double mm) noexcept {
  // Not (mm < 0): a NaN changes nothing.
  if (pinches_ && mm >= -kGapStepMm) gap_mm_ = std::clamp(mm, 0.0, kWidestGapMm);
}

}  // namespace clay::servo
