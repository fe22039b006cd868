#pragma once
// Before a live throw: scene, wheel, device and files, each checked before the force is on.

#include "app/cli/live_throw.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace clay::cli {

/// The parts of a live throw, in the order of their construction.
struct LiveStage {
  std::vector<Pose> stroke;  // of the simulated hand
  SceneSpec scene;
  std::optional<ForceSpec> force;  // of the scene, before it was softened
  std::uint64_t scene_hash = 0;
  std::optional<Wheel> wheel;
  std::optional<AtomicFile> pot_file;
  std::unique_ptr<falcon::HapticDevice> device;
  std::optional<servo::LiveThrow> live;
};

/// Fills the stage, and completes the options by those that the stroke and the device require.
/// Errors name the option or the file.
Result<void> build(const LiveJob& job, LiveOptions& options, const Console& console,
                   LiveStage& stage);

/// The bytes of the pot's file.
[[nodiscard]] std::string written_pot(const LiveJob& job, const Pot& pot);

}  // namespace clay::cli
