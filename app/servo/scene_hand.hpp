#pragma once
// A hand for the simulated arm that follows a recorded session. Where the clay resists, it lags
// behind, like a human hand.

#include "app/servo/mapping.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/falcon/sim.hpp"

#include <vector>

namespace clay::servo {

/// Time before the stroke begins, for homing and for the guard to find the tool clear of the clay.
inline constexpr double kHandLeadS = 0.5;
/// Maximum distance of the hand from the middle of the workspace; the Falcon permits 48 mm.
inline constexpr double kSimulatedReachMm = 46.0;

/// The poses in the device's frame, interpolated linearly and delayed by kHandLeadS; before and
/// after the stroke, the first and the last pose. Times of the poses ascend. The function owns its
/// data and does not allocate when called.
[[nodiscard]] falcon::HandPath hand_path(const std::vector<Pose>& poses, const Mapping& mapping);

/// The controls of the recorded hand: the trim button, and the gap of a pinch, as in the latest
/// pose. An empty function without poses.
[[nodiscard]] falcon::HandFingers hand_fingers(const std::vector<Pose>& poses);

/// A mapping that keeps the whole stroke within `reach_mm` of the middle of the workspace: the
/// scale of `settings`, or a larger one if needed, with its own side, reach and height. Returns
/// `settings` without poses.
[[nodiscard]] MappingSettings fitted(MappingSettings settings, const std::vector<Pose>& poses,
                                     double reach_mm);

/// End of the stroke [s]; 0 without poses.
[[nodiscard]] double seconds_of(const std::vector<Pose>& poses) noexcept;

/// A Falcon with loaded firmware, held by a hand that is stiff enough to follow the path: 200 N/mm,
/// damped so that it does not oscillate.
[[nodiscard]] falcon::SimulatedSettings simulated_potter(const std::vector<Pose>& poses,
                                                         const Mapping& mapping);

}  // namespace clay::servo
