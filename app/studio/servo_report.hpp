#pragma once
// How the servo keeps its time while the window draws: `claystack studio SCENE --servo-report S`.

#include "app/studio/studio.hpp"
#include "claystack/core/result.hpp"

#include <string>

namespace clay::studio {

/// What is promised of both together.
inline constexpr double kLatestP99Us = 100.0, kFewestFps = 30.0;

/// In place of a hand at an arm: a simulated one that plays the session beside the scene, as
/// `claystack throw --device simulated` has it.
Result<void> seat_simulated_hand(AppState& shop, const std::string& scene_path);

/// Lets go, and prints what servo and window did. `device`: nothing was thrown. `unsound`: it is
/// not what is promised, or not known to be, as the system gave no SCHED_FIFO.
Result<void> report_servo(Studio& studio, bool json);

}  // namespace clay::studio
