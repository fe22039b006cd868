#pragma once
// What the servo shows of itself to other threads: whole values, without a lock.

#include "claystack/engine/clay.hpp"
#include "claystack/falcon/device.hpp"
#include "claystack/falcon/guard.hpp"
#include "claystack/falcon/passivity.hpp"
#include "core/snapshot.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::servo {

/// Why the servo no longer ticks.
enum class Ending {
  none,         ///< it does
  stopped,      ///< asked to, by command or signal
  time_up,      ///< the seconds asked for are over, or no sample came to begin them
  device_lost,  ///< HapticDevice::problem tells
  collapsed,    ///< nothing is left to throw
};

/// A tick as it was.
struct LiveStatus {
  double time_s = 0.0;  ///< of throwing: since the first sample that was believed
  Ending ending = Ending::none;
  falcon::DeviceState device = falcon::DeviceState::closed;
  falcon::GuardState guard = falcon::GuardState::idle;
  falcon::SafeCause cause = falcon::SafeCause::none;
  falcon::PassivityState passivity = falcon::PassivityState::watching;
  bool clutched = false, paused = false, contact = false;
  bool ring_limit = false;    ///< clay waits above the top: raise lump.max_rings
  glm::dvec3 tool_mm{0.0};    ///< on the wheel
  double gap_mm = 0.0;        ///< of a pinch; 0: one tool, or the scene's own gap
  glm::dvec3 clay_n{0.0};     ///< of the clay on the tool, whatever the device can show of it
  glm::dvec3 force_n{0.0};    ///< sent, in the device's frame
  double force_gain = 0.0;    ///< part of it that is earned
  double volume_error = 0.0;  ///< clay unaccounted for [quanta]; exact below 2^53
  double imbalance = 0.0;     ///< the same with what is outside: Ledger::imbalance
  double stack_mm3 = 0.0, trimmed_mm3 = 0.0, outside_mm3 = 0.0;  ///< of the clay, as in Ledger
  double height_mm = 0.0;                                        ///< of the clay
  std::uint64_t ticks = 0, poses = 0, missed = 0;
  std::int64_t late_ns = 0;  ///< of this tick
};

/// The clay in outline, bottom to top: radii of at most kRows rings, evenly chosen where there are
/// more.
struct LiveProfile {
  static constexpr std::size_t kRows = 2048;
  struct Row {
    float outer_mm = 0.0f, inner_mm = 0.0f;
  };
  std::array<Row, kRows> rows{};
  std::size_t size = 0;    ///< rows in use
  double height_mm = 0.0;  ///< of the whole stack, crown and all
  double crown_mm = 0.0;   ///< of that, the height of the crown
  double time_s = 0.0;     ///< of the tick that it was seen in
};

/// Fills `profile`. Work and memory are bounded, whatever the stack's size.
void show(const ClayStack& stack, double time_s, LiveProfile& profile) noexcept;

/// One reader each.
struct LiveView {
  Snapshot<LiveStatus> status;
  Snapshot<LiveProfile> profile;
};

}  // namespace clay::servo
