#pragma once
// A hand for the simulated arm: it means to do what a recorded session did. Where the clay pushes
// back it gets a little less far, as a hand does.

#include "app/servo/mapping.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/falcon/sim.hpp"

#include <vector>

namespace clay::servo {

/// Time before the stroke begins, for homing and for the guard to see that nothing is in the way.
inline constexpr double kHandLeadS = 0.5;
/// How far from the middle of its workspace it goes: a Falcon's hand could go 48 mm.
inline constexpr double kSimulatedReachMm = 46.0;

/// The poses in the device's frame, linear between them, kHandLeadS late; before and after, the
/// first and the last. Times of the poses rise. Copies what it needs; called, it allocates nothing.
[[nodiscard]] falcon::HandPath hand_path(const std::vector<Pose>& poses, const Mapping& mapping);

/// What the hand does beside: the trim button held down, the gap of a pinch between its fingers, as
/// of the last pose. No function without poses.
[[nodiscard]] falcon::HandFingers hand_fingers(const std::vector<Pose>& poses);

/// A mapping by which the whole stroke lies within `reach_mm` of the middle of the workspace: the
/// usual scale, or as much more as it takes; `settings` otherwise. Themselves without poses.
[[nodiscard]] MappingSettings fitted(MappingSettings settings, const std::vector<Pose>& poses,
                                     double reach_mm);

/// When the stroke is over [s]; 0 without poses.
[[nodiscard]] double seconds_of(const std::vector<Pose>& poses) noexcept;

/// A Falcon that has its firmware, held by a hand that is stiff enough to keep to the path: 200
/// N/mm and damped so that it does not swing.
[[nodiscard]] falcon::SimulatedSettings simulated_potter(const std::vector<Pose>& poses,
                                                         const Mapping& mapping);

}  // namespace clay::servo
