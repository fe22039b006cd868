#include "live/controls.hpp"

#include <algorithm>

namespace clay::live {

void Controls::update(unsigned buttons, Commands& commands,
                      std::optional<double> grip_mm) noexcept {
  zero_ = rearm_ = false;
  while (const auto command = commands.pop()) obey(*command);
  clutch_held_ = (buttons & map_.clutch) != 0;
  trim_held_ = (buttons & map_.trim) != 0;
  const unsigned pressed = buttons & ~before_;
  if ((pressed & map_.wider) != 0) set_gap(gap_mm_ + kGapStepMm);
  if ((pressed & map_.narrower) != 0) set_gap(gap_mm_ - kGapStepMm);
  before_ = buttons;
  if (grip_mm) set_gap(*grip_mm);
}

void Controls::obey(const Command& command) noexcept {
  const bool on = command.value != 0.0;
  switch (command.kind) {
    case CommandKind::clutch:
      clutch_asked_ = on;
      break;
    case CommandKind::trim:
      trim_asked_ = on;
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

}  // namespace clay::live
