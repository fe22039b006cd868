#include "app/cli/device_choice.hpp"
#include "app/cli/live_throw.hpp"

#include <CLI/CLI.hpp>

namespace clay::cli {
namespace {

std::string check_flip(const std::string& axes) {
  if (axes.find_first_not_of("xyz") == std::string::npos) return {};
  return "expected axes out of x, y and z, as in xz, found " + axes;
}

}  // namespace

void add_place_options(CLI::App& command, servo::MappingSettings& mapping) {
  command.add_option("--scale", mapping.scale, "mm on the wheel to a mm of the hand")
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--side",
          [&mapping](const std::string& side) {
            mapping.side = side == "left"    ? servo::Side::left
                           : side == "front" ? servo::Side::front
                                             : servo::Side::right;
          },
          "Where the hand works: right, left or front")
      ->check(CLI::IsMember({"right", "left", "front"}))
      ->default_str("right");
  command.add_option("--reach", mapping.reach_mm, "Of the workspace's middle from the axis [mm]")
      ->capture_default_str();
  command.add_option("--height", mapping.height_mm, "And above the wheel head [mm]")
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--flip",
          [&mapping](const std::string& axes) {
            mapping.flip_x = axes.find('x') != std::string::npos;
            mapping.flip_y = axes.find('y') != std::string::npos;
            mapping.flip_z = axes.find('z') != std::string::npos;
          },
          "Axes to turn over, as in xz")
      ->check(CLI::Validator(check_flip, ""));
}

void add_live_options(CLI::App& command, LiveOptions& options) {
  servo::LiveSettings& settings = options.settings;
  command
      .add_option("--device", options.device,
                  "Throw by hand: auto, falcon, bridge, spacemouse, simulated, or a place")
      ->check(CLI::Validator(check_device_name, ""));
  command.add_option("--record", options.record, "Session to write while throwing");
  command.add_option("--seconds", settings.seconds,
                     "End after so long on the wheel (simulated: with its stroke)");
  command
      .add_option("--patience", settings.patience_s,
                  "With --seconds: how long to wait for the device to be homed [s]")
      ->capture_default_str();
  command.add_option("--rate", settings.rate_hz, "Of the servo [Hz]")->capture_default_str();
  command.add_option("--clay-rate", settings.clay_rate_hz,
                     "Deform the clay less often than the force is computed [Hz]");
  command.add_option("--force-limit", settings.guard.force_limit_n, "Most force on the hand [N]")
      ->check(CLI::Validator(in_range(0.5, falcon::kMostForceN), ""))
      ->capture_default_str();
  command.add_option("--gap", settings.gap_mm, "Of a pinch [mm]; plus and minus change it");
  command.add_option("--damping", settings.arm.damping_ns_per_m, "Of the arm itself [N s/m]")
      ->capture_default_str();
  command.add_flag("--soften", options.soften,
                   "Lower force.stiffness_n_per_mm2 to what the arm can render");
  command.add_flag("--wait", options.wait, "When unplugged wait for it to come back");
  add_falcon_options(command, options.falcon);
  add_place_options(command, settings.mapping);
  command.add_option("--force-gain", settings.mapping.force_gain,
                     "N at the hand to a N at the tool (default: 1 / scale, so that the clay feels "
                     "as stiff as it is; = scale: the hand does the tool's work)");
}

}  // namespace clay::cli
