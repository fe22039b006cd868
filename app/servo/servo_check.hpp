#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tick.hpp"
#include "claystack/falcon/passivity.hpp"

namespace clay::servo {

/// A scene's contact as an arm feels it.
struct ServoContact {
  double height_mm = 0.0;           ///< most that the tool can touch at once, in whole rings
  double stiffness_n_per_mm = 0.0;  ///< radial: K' times that height
  double accepted_n_per_mm = 0.0;   ///< half of what is passive at the arm's rate and damping
};

/// What an arm would have to render. `stiffness_gain`: of the mapping between tool and hand. A
/// pinch has two tools, one on each side of the wall: where one presses deeper the other presses
/// less, so their stiffnesses add up. Refuses what `check` of the loop refuses.
Result<ServoContact> servo_contact(const SceneSpec& scene, const StepPlan& plan,
                                   const falcon::SampledLoop& loop, double stiffness_gain = 1.0);

/// Can this arm render the scene? Refuses a contact stiffer than is accepted, and names the setting
/// to change and both numbers that would do: the stiffness at this rate, the rate at this
/// stiffness.
Result<ServoContact> check_servo(const SceneSpec& scene, const StepPlan& plan,
                                 const falcon::SampledLoop& loop, double stiffness_gain = 1.0);

/// Lowers the scene's stiffness to what is accepted; what part of it is left, 1 where it was soft
/// enough. It has no part in what becomes of the clay: a softened scene replays to the same pot.
double soften(SceneSpec& scene, const ServoContact& contact);

}  // namespace clay::servo
