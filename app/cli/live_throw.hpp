#pragma once
// Throwing by hand: `claystack throw SCENE --device ...`.

#include "app/cli/console.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/servo/servo.hpp"

#include <CLI/App.hpp>

#include <string>

namespace clay::cli {

struct LiveOptions {
  std::string device;  ///< empty: nothing is live
  std::string record;  ///< session to write; empty: none
  falcon::FalconSettings falcon;
  bool wait = false;    ///< for a device that was unplugged to come back
  bool soften = false;  ///< lower the scene's stiffness to what is accepted
  servo::LiveSettings settings;
};

void add_live_options(CLI::App& command, LiveOptions& options);

/// An error that begins with the name of a setting of the servo begins with its option instead.
[[nodiscard]] Error by_option(Error error);

/// Where the hand works, of the mapping: --scale, --side, --reach, --height, --flip.
void add_place_options(CLI::App& command, servo::MappingSettings& mapping);

/// What is thrown, and where it goes.
struct LiveJob {
  std::string scene_path;
  std::string stroke_path;  ///< session that the simulated hand plays
  std::string pot_path;     ///< empty: not kept
  std::string model;        ///< empty: the scene's own
  std::string from_path;    ///< pot to throw on; empty: the scene's lump
};

/// Until it is over: the stroke's end, --seconds, SIGINT or SIGTERM, the device's failure, a
/// collapse. In every case the hand is free of force and pot and session are kept; a failed device
/// is then the error.
Result<void> throw_live(const LiveJob& job, LiveOptions options, Console console);

}  // namespace clay::cli
