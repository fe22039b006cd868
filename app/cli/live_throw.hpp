#pragma once
// Throwing by hand: `claystack throw SCENE --device ...`.

#include "app/cli/console.hpp"
#include "claystack/falcon/falcon_device.hpp"
#include "claystack/servo/servo.hpp"

#include <CLI/App.hpp>

#include <string>

namespace clay::cli {

struct LiveOptions {
  std::string device;  ///< empty: not live
  std::string record;  ///< session to write; empty: none
  falcon::FalconSettings falcon;
  bool wait = false;   ///< wait for a disconnected device to return
  bool soften = true;  ///< lower the scene's stiffness to the accepted limit
  servo::LiveSettings settings;
};

void add_live_options(CLI::App& command, LiveOptions& options);

/// An error that begins with the name of a setting of the servo begins with its option instead.
[[nodiscard]] Error by_option(Error error);

/// The workspace of the mapping: --scale, --side, --reach, --height, --flip.
void add_place_options(CLI::App& command, servo::MappingSettings& mapping);

/// Inputs and outputs of a live throw.
struct LiveJob {
  std::string scene_path;
  std::string stroke_path;  ///< session played by the simulated hand
  std::string pot_path;     ///< empty: not saved
  std::string model;        ///< empty: the model of the scene
  std::string from_path;    ///< pot to continue; empty: the scene's lump
};

/// Runs until the stroke ends, --seconds pass, SIGINT or SIGTERM arrives, the device fails, or the
/// pot collapses. In every case force is zero and pot and session are saved; a device failure is
/// then returned as the error.
Result<void> throw_live(const LiveJob& job, LiveOptions options, Console console);

}  // namespace clay::cli
