#include "app/cli/device_choice.hpp"
#include "app/cli/live_throw.hpp"
#include "app/cli/quantity.hpp"
#include "app/cli/usage.hpp"

#include <CLI/CLI.hpp>

#include <string_view>
#include <utility>

namespace clay::cli {
namespace {

std::string check_flip(const std::string& axes) {
  if (axes.find_first_not_of("xyz") == std::string::npos) return {};
  return "expected axes out of x, y and z, as in xz, found " + axes;
}

/// Settings of the servo, of the force and of the wait for a disconnected device.
void add_servo_options(CLI::App& command, LiveOptions& options) {
  servo::LiveSettings& settings = options.settings;
  command.add_option("--rate", settings.rate_hz, "Servo rate [Hz]")->capture_default_str();
  command
      .add_option("--clay-rate", settings.clay_rate_hz,
                  "Update rate of the clay [Hz] (default: the servo rate)")
      ->check(above_zero());
  command.add_option("--force-limit", settings.guard.force_limit_n, "Force limit [N]")
      ->check(in_range(0.5, falcon::kMostForceN))
      ->capture_default_str();
  add_length(command, "--gap", settings.gap_mm, "Gap of a pinch [mm] (default: that of the scene)");
  command.add_option("--damping", settings.arm.damping_ns_per_mm, "Damping of the arm [N s/mm]")
      ->capture_default_str();
  // A flag "!--no-soften" is shown as --no-soften{false} in the help.
  command.add_flag_callback(
      "--no-soften", [&options] { options.soften = false; },
      "Refuse a scene that is stiffer than the arm can render (default: lower its "
      "force.stiffness_n_per_mm2, with a warning)");
  command.add_flag("--wait", options.wait, "Wait for a disconnected device to return");
}

}  // namespace

void add_place_options(CLI::App& command, servo::MappingSettings& mapping) {
  command
      .add_option("--scale", mapping.scale, "Scale of motion: mm at the wheel per mm of the hand")
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--side",
          [&mapping](const std::string& side) {
            mapping.side = side == "left"    ? servo::Side::left
                           : side == "front" ? servo::Side::front
                                             : servo::Side::right;
          },
          "Side of the pot on which the hand works: right, left or front")
      ->check(one_of({"right", "left", "front"}))
      ->default_str("right");
  add_length(command, "--reach", mapping.reach_mm,
             "Distance of the workspace centre from the axis [mm]")
      ->capture_default_str();
  add_length(command, "--height", mapping.height_mm,
             "Height of the workspace centre above the wheel head [mm]")
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--flip",
          [&mapping](const std::string& axes) {
            mapping.flip_x = axes.find('x') != std::string::npos;
            mapping.flip_y = axes.find('y') != std::string::npos;
            mapping.flip_z = axes.find('z') != std::string::npos;
          },
          "Axes to invert, for example xz (default: none)")
      ->type_name("AXES")
      ->check(check_flip);
}

void add_live_options(CLI::App& command, LiveOptions& options) {
  servo::LiveSettings& settings = options.settings;
  begin_group(command, "Throw by hand");
  command
      .add_option("--device", options.device,
                  "Device to throw with: auto, falcon, bridge, spacemouse, simulated, or a place "
                  "from claystack devices, such as usb:1-2 or /dev/hidraw0")
      ->type_name("DEVICE")
      ->check(check_device_name);
  add_file(command, "--record", options.record, "File in which to record the session");
  command
      .add_option(
          "--seconds", settings.seconds,
          "Duration of the throw [s] (default: until ended; simulated: until its stroke ends)")
      ->check(above_zero());
  command
      .add_option(
          "--patience", settings.patience_s,
          "With --seconds: maximum time to wait for homing [s]; --seconds, if that is longer")
      ->capture_default_str();
  add_servo_options(command, options);
  begin_group(command, "Device and workspace");
  add_falcon_options(command, options.falcon);
  add_place_options(command, settings.mapping);
  command
      .add_option("--force-gain", settings.mapping.force_gain,
                  "Scale of force: N at the hand per N at the tool (default: 1 / --scale, so that "
                  "the clay feels as stiff as in the scene; equal to --scale: the hand does the "
                  "same work as the tool)")
      ->check(above_zero());
}

Error by_option(Error error) {
  constexpr std::pair<std::string_view, std::string_view> kOptions[] = {
      {"rate_hz", "--rate"},    {"clay_rate_hz", "--clay-rate"},
      {"seconds", "--seconds"}, {"patience_s", "--patience"},
      {"gap_mm", "--gap"},      {"damping_ns_per_mm", "--damping"},
      {"scale", "--scale"},     {"force_gain", "--force-gain"},
      {"reach_mm", "--reach"},  {"height_mm", "--height"}};
  for (const auto& [setting, option] : kOptions)
    if (error.message.starts_with(std::string(setting) + ":"))
      error.message.replace(0, setting.size(), option);
  return error;
}

}  // namespace clay::cli
