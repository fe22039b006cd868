#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/servo/servo.hpp"

#include <limits>
#include <optional>

namespace clay::servo {

/// The loop of arm and servo: sampled at the rate of the slower one.
[[nodiscard]] falcon::SampledLoop loop_of(const LiveSettings& settings) noexcept;
/// The same loop with the delay of this device, if its answers take longer than `loop` states.
[[nodiscard]] falcon::SampledLoop with_delay_of(const falcon::DeviceInfo& device,
                                                falcon::SampledLoop loop) noexcept;

/// Stiffness of a scene's contact as seen by an arm.
struct ServoContact {
  double height_mm = 0.0;           ///< maximum height of contact, in whole rings
  double stiffness_n_per_mm = 0.0;  ///< radial: K' times that height
  double accepted_n_per_mm = 0.0;   ///< half of the passive limit at the arm's rate and damping
};

/// The contact that an arm would have to render. `stiffness_gain`: of the mapping between tool and
/// hand. A pinch has two tools, one on each side of the wall; where one presses deeper the other
/// presses less, so their stiffnesses add up. Refuses a `loop` out of range.
Result<ServoContact> servo_contact(const SceneSpec& scene, const StepPlan& plan,
                                   const falcon::SampledLoop& loop, double stiffness_gain = 1.0);

/// Checks that this arm can render the scene. The error for a contact that is too stiff names the
/// setting and both values that would be accepted: the stiffness at this rate, and the rate at this
/// stiffness, unless it is above `highest_rate_hz`.
Result<ServoContact> check_servo(const SceneSpec& scene, const StepPlan& plan,
                                 const falcon::SampledLoop& loop, double stiffness_gain = 1.0,
                                 double highest_rate_hz = std::numeric_limits<double>::infinity());

/// Lowers the scene's stiffness to the accepted value. Returns the remaining fraction, 1 if it was
/// low enough. The clay does not depend on it: a softened scene replays to the same pot.
double soften(SceneSpec& scene, const ServoContact& contact);

/// A pot thrown in a `softened` scene: it remembers the force of the scene, not that of one throw.
[[nodiscard]] Pot with_force_of_scene(Pot pot, const ThrowSettings& softened,
                                      const std::optional<ForceSpec>& force);

}  // namespace clay::servo
