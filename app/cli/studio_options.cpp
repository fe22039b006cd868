#include "app/cli/studio_options.hpp"

#include "app/cli/console.hpp"
#include "app/cli/device_choice.hpp"
#include "app/cli/usage.hpp"
#include "app/render/offscreen.hpp"
#include "core/number_parsing.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace clay::cli {
namespace {

Result<glm::ivec2> size_of(const std::string& text) {
  const auto size = two_numbers<int>(text, 'x');
  if (!size || size->first < 320 || size->second < 240 || size->first > render::kMaxSidePx ||
      size->second > render::kMaxSidePx)
    return failure(ErrorKind::bad_input,
                   fmt::format("--size: expected WIDTHxHEIGHT from 320x240 to {0}x{0}, found {1}",
                               render::kMaxSidePx, text));
  return glm::ivec2(size->first, size->second);
}

void add_device_options(CLI::App& parser, StudioOptions& options) {
  parser
      .add_option("--device", options.device,
                  "Device: none (mouse only), or a device as for claystack throw (default: auto)")
      ->type_name("DEVICE")
      ->check([](const std::string& which) {
        return which == "none" ? std::string() : check_device_name(which);
      });
  add_falcon_options(parser, options.falcon);
}

void add_report_options(CLI::App& parser, StudioOptions& options) {
  auto* report =
      parser
          .add_option("--servo-report", options.servo_report_s,
                      "Duration of a measurement [s]: a simulated hand (or the device of --device) "
                      "throws in the window; then the timings of servo and window are printed")
          ->check(in_range(1.0, 3600.0))
          ->excludes("--script")
          ->excludes("--screenshot");
  parser.add_flag("--json", options.json, "Print the servo report as JSON")->needs(report);
}

}  // namespace

void add_studio_options(CLI::App& parser, double smallest_scale, double largest_scale,
                        StudioOptions& options) {
  add_file(parser, "file", options.file,
           "A scene, a pot (also a 3MF that has one), a work, or a drawing (.svg, .dxf, .csv)");
  add_device_options(parser, options);
  add_file(parser, "--script", options.script, "Script that drives the window without a screen");
  add_file(parser, "--screenshot", options.screenshot,
           "Picture of the window at the end, a .png file (without a screen)");
  parser.add_option("--size", options.size, "Size of the window [px] (default: 1280x800)")
      ->type_name("WIDTHxHEIGHT");
  parser.add_option("--scale", options.scale, "Scale of text and controls (default: as stored)")
      ->check(in_range(smallest_scale, largest_scale));
  parser.add_option("--theme", options.theme, "Theme: dark or light (default: as stored)")
      ->check(one_of({"dark", "light"}));
  parser.add_flag("--log", options.log, "Print events on standard output, one per line");
  add_report_options(parser, options);
  parser.footer(
      "\nExamples:\n  claystack studio\n  claystack studio samples/bowl.scene.json\n"
      "  claystack throw samples/vase.scene.json -o vase.pot.json\n"
      "  claystack studio vase.pot.json --script samples/window/throw.script");
}

std::optional<int> parse(int argc, char** argv, double smallest_scale, double largest_scale,
                         StudioOptions& options) {
  CLI::App parser("Open the window: throw by mouse or with a haptic device", "claystack studio");
  parser.formatter(help_format());
  add_studio_options(parser, smallest_scale, largest_scale, options);
  refuse_empty_values(parser);
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report(parser, error);
  }
  const auto size_px = size_of(options.size);
  if (!size_px) return report(size_px.error());
  options.size_px = *size_px;
  return std::nullopt;
}

}  // namespace clay::cli
