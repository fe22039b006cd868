#pragma once
#include "app/servo/controls.hpp"
#include "app/servo/mapping.hpp"
#include "claystack/core/result.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/falcon/passivity.hpp"

namespace clay::servo {

/// What a servo is made of beside the wheel and the device.
struct LiveSettings {
  double rate_hz = 1000.0;  ///< of device and force: 400, where frames grow stale, to 4000
  double clay_rate_hz =
      0.0;               ///< 20, as the engine counts no step for longer, to the rate; 0: the rate
  double seconds = 0.0;  ///< from the first sample believed, pauses and all; 0: until asked to end
  /// Where `seconds` are set: how long that sample is waited for, as of a device that nobody homes;
  /// or `seconds`, where that is longer.
  double patience_s = 60.0;
  double gap_mm = 0.0;  ///< of poses, where the scene lets them pinch, to kWidestGapMm
  MappingSettings mapping;
  ButtonMap buttons = kFalconButtons;
  falcon::GuardSettings guard;  ///< its period follows from the rate
  /// The arm as the passivity controller counts on it; its rate follows from ours.
  falcon::SampledLoop arm{1000.0, 0.1, 2.0, 1};
  double encoder_step_m = 5e-5;  ///< the Falcon's, in the middle of its workspace
};

/// Errors name the option of the command line. Mapping, guard and arm are checked by their own.
Result<void> check(const LiveSettings& settings);

}  // namespace clay::servo
