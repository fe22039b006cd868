// `claystack studio`: a program of its own, so that no other command loads a window's libraries.

#include "app/cli/console.hpp"
#include "app/cli/device_choice.hpp"
#include "app/servo/signals.hpp"
#include "app/studio/glfw_host.hpp"
#include "app/studio/script.hpp"
#include "app/studio/servo_report.hpp"

#include "claystack/core/atomic_file.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>

namespace clay::studio {
namespace {

struct Options {
  std::string file, script, screenshot, theme;
  std::string device = "auto";
  falcon::FalconSettings falcon;
  std::string size = "1280x800";
  double scale = 0.0;  ///< 0: the screen's, or 1 without one
  bool log = false;
  double servo_report_s = 0.0;  ///< 0: none
  bool json = false;
};

Result<glm::ivec2> size_of(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 320 ||
      height < 240 || width > render::kMaxSidePx || height > render::kMaxSidePx)
    return failure(ErrorKind::bad_input,
                   fmt::format("--size: expected WIDTHxHEIGHT from 320x240 to {0}x{0}, found {1}",
                               render::kMaxSidePx, text));
  return glm::ivec2(width, height);
}

void apply(const Options& options, Settings& settings) {
  if (options.theme == "dark") settings.theme = Theme::dark;
  if (options.theme == "light") settings.theme = Theme::light;
}

Result<void> run_script(const Options& options, glm::ivec2 size,
                        const std::function<void(std::string_view)>& log) {
  std::vector<ScriptLine> lines;
  if (!options.script.empty()) {
    const auto text = read_file(options.script, 1 << 24);
    if (!text) return tl::make_unexpected(text.error());
    auto parsed = parse_script(*text, options.script);
    if (!parsed) return tl::make_unexpected(parsed.error());
    lines = std::move(*parsed);
  }
  auto host =
      OffscreenHost::create(size, options.scale > 0.0 ? static_cast<float>(options.scale) : 1.0f);
  if (!host) return tl::make_unexpected(host.error());
  // What one user has set changes no script's picture.
  Settings settings;
  settings.hints = false;
  apply(options, settings);
  auto studio = Studio::create(**host, settings, log);
  if (!studio) return tl::make_unexpected(studio.error());
  ScriptRunner runner(**host, **studio);
  if (!options.file.empty()) {
    open_file((*studio)->shop(), options.file);
    if ((*studio)->shop().notices.shown())
      return failure(ErrorKind::bad_input, (*studio)->shop().notices.shown()->text);
  }
  if (auto done = runner.run(lines, options.script); !done) return done;
  if (!options.screenshot.empty()) return runner.screenshot(options.screenshot);
  return {};
}

Result<void> run_window(const Options& options, glm::ivec2 size,
                        const std::function<void(std::string_view)>& log) {
  LoadedSettings loaded = load_settings(settings_path());
  apply(options, loaded.settings);
  if (options.scale > 0.0) loaded.settings.scale = static_cast<float>(options.scale);
  auto host = GlfwHost::create(size);
  if (!host) return tl::make_unexpected(host.error());
  auto studio = Studio::create(**host, loaded.settings, log);
  if (!studio) return tl::make_unexpected(studio.error());
  AppState& shop = (*studio)->shop();
  shop.potter.keep_journals();
  shop.left = history::recoverable();
  if (options.device != "none")
    shop.devices = std::make_unique<DeviceWatch>(look_for(options.device, options.falcon));
  if (!loaded.note.empty()) shop.notices.say(Grade::warning, loaded.note);
  if (!options.file.empty()) open_file(shop, options.file);
  if (!shop.left.empty()) {
    log(fmt::format("recovery offered: {}", shop.left.size()));
    if (shop.overlay != Overlay::gallery)
      shop.notices.say(Grade::note,
                       "A work that was not saved is still there: File, New offers to recover it");
  }
  log("window open");
  const servo::ForceSignals signals;
  (*host)->run(**studio);
  // After a signal nobody was asked: what was not saved can be recovered.
  if (shop.done) shop.potter.close();
  log("window closed");
  return save_settings(shop.settings, settings_path());
}

/// With the settings of no user, and leaving nothing behind.
Result<void> run_servo_report(const Options& options, glm::ivec2 size,
                              const std::function<void(std::string_view)>& log) {
  if (options.file.empty())
    return failure(ErrorKind::bad_input, "--servo-report: expected a scene to throw, found none");
  auto host = GlfwHost::create(size);
  if (!host) return tl::make_unexpected(host.error());
  Settings settings;
  apply(options, settings);
  if (options.scale > 0.0) settings.scale = static_cast<float>(options.scale);
  auto studio = Studio::create(**host, settings, log);
  if (!studio) return tl::make_unexpected(studio.error());
  AppState& shop = (*studio)->shop();
  open_file(shop, options.file);
  if (shop.notices.shown()) return failure(ErrorKind::bad_input, shop.notices.shown()->text);
  if (options.device == "auto") {
    if (auto seated = seat_simulated_hand(shop, options.file); !seated) return seated;
  } else if (options.device != "none") {
    shop.devices = std::make_unique<DeviceWatch>(look_for(options.device, options.falcon));
  }
  const servo::ForceSignals signals;
  (*host)->run(**studio, options.servo_report_s);
  return report_servo(**studio, options.json);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App parser("The window: throw by mouse or by hand, see and keep what becomes of it.",
                  "claystack studio");
  parser.add_option("file", options.file, "NAME.scene.json, a pot, or NAME.work");
  parser
      .add_option("--device", options.device,
                  "auto, none, or as `claystack throw` has it (default auto)")
      ->check([](const std::string& which) {
        return which == "none" ? std::string() : cli::check_device_name(which);
      });
  cli::add_falcon_options(parser, options.falcon);
  parser.add_option("--script", options.script, "Script that drives the window without a screen");
  parser.add_option("--screenshot", options.screenshot,
                    "File for a picture of the window at the end, .png (without a screen)");
  parser.add_option("--size", options.size, "Size of the window [px] (default 1280x800)");
  parser.add_option("--scale", options.scale, "Scale of text and controls")
      ->check(cli::in_range(kSmallestScale, kLargestScale));
  parser.add_option("--theme", options.theme, "Theme: dark or light")
      ->check(CLI::IsMember({"dark", "light"}));
  parser.add_flag("--log", options.log, "Print events on standard output, one per line");
  auto* report =
      parser
          .add_option("--servo-report", options.servo_report_s,
                      "Seconds for which a simulated hand (or --device) throws in the window; "
                      "then tells how servo and window kept their time")
          ->check(cli::in_range(1.0, 3600.0))
          ->excludes("--script")
          ->excludes("--screenshot");
  parser.add_flag("--json", options.json, "Print the servo report as JSON")->needs(report);
  parser.footer(
      "\nExamples:\n  claystack studio\n  claystack studio samples/bowl.scene.json\n"
      "  claystack studio vase.pot.json --script samples/window/throw.script");
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli::report(parser, error);
  }
  const auto size = size_of(options.size);
  if (!size) return cli::report(size.error());
  const auto log = [&](std::string_view line) {
    if (!options.log) return;
    cli::put_out(std::string(line) + "\n");
    (void)cli::flush_out();
  };
  const bool without_screen = !options.script.empty() || !options.screenshot.empty();
  const auto done = without_screen                 ? run_script(options, *size, log)
                    : options.servo_report_s > 0.0 ? run_servo_report(options, *size, log)
                                                   : run_window(options, *size, log);
  return done ? cli::kDone : cli::report(done.error());
}

}  // namespace
}  // namespace clay::studio

int main(int argc, char** argv) { return clay::cli::run_program(clay::studio::run, argc, argv); }
