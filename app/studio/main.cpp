// `claystack studio` is a separate program, so that the other commands do not load the libraries of
// the window.

#include "app/cli/console.hpp"
#include "app/cli/device_choice.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/studio_options.hpp"
#include "app/cli/window_report.hpp"
#include "app/servo/scene_hand.hpp"
#include "app/servo/signals.hpp"
#include "app/studio/glfw_host.hpp"
#include "app/studio/script_runner.hpp"
#include "claystack/core/atomic_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>

namespace clay::studio {
namespace {

using cli::StudioOptions;
using LogLine = std::function<void(std::string_view)>;

/// Limits of `--servo-report`.
constexpr double kLatestP99Us = 100.0, kFewestFps = 30.0;

void apply(const StudioOptions& options, Settings& settings) {
  if (options.theme == "dark") settings.theme = Theme::dark;
  if (options.theme == "light") settings.theme = Theme::light;
}

Result<void> run_script(const StudioOptions& options, const LogLine& log) {
  std::vector<ScriptLine> lines;
  if (!options.script.empty()) {
    const auto text = read_file(options.script, 1 << 24);
    if (!text) return tl::make_unexpected(text.error());
    auto parsed = parse_script(*text, options.script);
    if (!parsed) return tl::make_unexpected(parsed.error());
    lines = std::move(*parsed);
  }
  if (auto free =
          cli::check_outputs({{options.screenshot, {".png"}}}, {options.file, options.script}, {});
      !free)
    return free;
  const auto pixels =
      static_cast<std::uint64_t>(options.size_px.x) * static_cast<std::uint64_t>(options.size_px.y);
  if (auto room = cli::expect_room_to_draw(pixels); !room) return room;
  auto host = OffscreenHost::create(options.size_px,
                                    options.scale > 0.0 ? static_cast<float>(options.scale) : 1.0f);
  if (!host) return tl::make_unexpected(host.error());
  // Scripts ignore the settings of the user.
  Settings settings;
  settings.hints = false;
  apply(options, settings);
  auto studio = Studio::create(**host, settings, log);
  if (!studio) return tl::make_unexpected(studio.error());
  ScriptRunner runner(**host, **studio);
  if (!options.file.empty()) {
    AppState& state = (*studio)->state();
    apply(state, OpenFile{options.file});
    if (state.last_error) return tl::make_unexpected(*state.last_error);
  }
  if (auto done = runner.run(lines, options.script); !done) return done;
  if (!options.screenshot.empty()) return runner.screenshot(options.screenshot);
  return {};
}

/// Checked before the window opens, so that a missing file is reported even without a screen.
Result<void> expect_file(const std::string& file) {
  std::error_code unknown;
  if (file.empty() || std::filesystem::exists(file, unknown) || unknown) return {};
  return failure(ErrorKind::io,
                 file + ": could not open: " + std::generic_category().message(ENOENT));
}

/// Logs the delay from a motion of the mouse to its picture, and the rate of frames.
void log_motion(const FrameTimes& times, const LogLine& log) {
  const auto text = [](const Histogram& motion) {
    return fmt::format("median {:.1f} ms, 99 % {:.1f} ms, of {}",
                       1e-6 * static_cast<double>(motion.quantile_ns(0.5)),
                       1e-6 * static_cast<double>(motion.quantile_ns(0.99)), motion.count());
  };
  if (times.hover.count() > 0) log("motion to picture, hovering: " + text(times.hover));
  if (times.stroke.count() > 0) log("motion to picture, in a stroke: " + text(times.stroke));
  if (times.intervals > 0)
    log(fmt::format("frames while moving: {:.1f} per second, of {}; drawing: median {:.1f} ms",
                    times.fps(), times.drawing.count(),
                    1e-6 * static_cast<double>(times.drawing.quantile_ns(0.5))));
}

Result<void> run_window(const StudioOptions& options, const LogLine& log) {
  if (auto exists = expect_file(options.file); !exists) return exists;
  LoadedSettings loaded = load_settings(settings_path());
  const Settings stored = loaded.settings;
  apply(options, loaded.settings);
  if (options.scale > 0.0) loaded.settings.scale = static_cast<float>(options.scale);
  auto host = GlfwHost::create(options.size_px);
  if (!host) return tl::make_unexpected(host.error());
  auto studio = Studio::create(**host, loaded.settings, log);
  if (!studio) return tl::make_unexpected(studio.error());
  AppState& state = (*studio)->state();
  if (loaded.may_save) state.settings_file = SettingsFile(settings_path(), stored, state.settings);
  state.document.keep_journals();
  state.recoverable = history::recoverable();
  if (options.device != "none")
    state.devices = std::make_unique<DeviceWatch>(look_for(options.device, options.falcon));
  if (!loaded.note.empty()) state.ui.notices.show_state(Grade::warning, loaded.note);
  if (!options.file.empty()) apply(state, OpenFile{options.file});
  if (!state.recoverable.empty()) {
    log(fmt::format("recovery offered: {}", state.recoverable.size()));
    if (!state.ui.shows<GalleryDialog>() && !state.ui.notices.answer())
      state.ui.notices.show(Grade::note,
                            "A work was not saved when the program ended. New (Ctrl+N) lists it.",
                            0.0, "recover.take");
  }
  log("window open");
  const servo::ForceSignals signals;
  (*host)->run(**studio);
  // After a signal the user could not decide, so the journal stays and the work can be recovered.
  state.stroke.release();
  if (state.done) state.document.close();
  log_motion((*studio)->frame_times(), log);
  log("window closed");
  return state.settings_file.save(state.settings);
}

/// A simulated hand plays the session beside the scene, as for `claystack throw --device
/// simulated`.
Result<void> take_simulated_hand(AppState& state, const std::string& scene_path) {
  const auto session = cli::load_session(cli::session_beside(scene_path));
  if (!session) return tl::make_unexpected(session.error());
  servo::LiveSettings settings;
  settings.mapping = servo::fitted(settings.mapping, session->poses, servo::kSimulatedReachMm);
  const auto mapping = servo::Mapping::build(settings.mapping);
  if (!mapping) return tl::make_unexpected(mapping.error());
  auto device =
      cli::open_chosen("simulated", {}, servo::simulated_potter(session->poses, *mapping));
  if (!device) return tl::make_unexpected(device.error());
  state.stroke.take(std::move(*device), settings);
  return {};
}

/// Compares the timings with the limits stated in docs/studio.md.
Result<void> judge(double late_p99_us, double fps, bool fifo) {
  const auto missed = [](std::string what) {
    return failure(ErrorKind::unsound, "servo report: expected " + std::move(what));
  };
  if (!fifo) return missed("SCHED_FIFO, which the system does not permit");
  if (fps < kFewestFps)
    return missed(fmt::format("{:g} frames a second or more, found {:.1f}", kFewestFps, fps));
  if (late_p99_us > kLatestP99Us)
    return missed(
        fmt::format("99 % of ticks woken within {:g} us, found {:.1f}", kLatestP99Us, late_p99_us));
  return {};
}

/// Ends the stroke, prints the timings and compares them with the limits.
Result<void> report_servo(Studio& studio, bool json) {
  StrokeController& stroke = studio.state().stroke;
  stroke.release();
  const ServoRecord& servo = stroke.servo();
  if (servo.timing.ticks == 0)
    return failure(ErrorKind::device, "servo report: expected a device in use, found none");
  const FrameTimes& times = studio.frame_times();
  const auto ms = [&](double part) {
    return 1e-6 * static_cast<double>(times.drawing.quantile_ns(part));
  };
  cli::print_window_report(servo.timing, servo.events, servo.realtime,
                           {.frames = times.drawing.count(),
                            .fps = times.fps(),
                            .median_ms = ms(0.5),
                            .p99_ms = ms(0.99),
                            .longest_ms = ms(1.0)},
                           json);
  return judge(1e-3 * static_cast<double>(servo.timing.lateness.quantile_ns(0.99)), times.fps(),
               servo.realtime.fifo);
}

/// With default settings, which are not stored.
Result<void> run_servo_report(const StudioOptions& options, const LogLine& log) {
  if (options.file.empty())
    return failure(ErrorKind::bad_input, "--servo-report: expected a scene to throw, found none");
  auto host = GlfwHost::create(options.size_px);
  if (!host) return tl::make_unexpected(host.error());
  Settings settings;
  apply(options, settings);
  if (options.scale > 0.0) settings.scale = static_cast<float>(options.scale);
  auto studio = Studio::create(**host, settings, log);
  if (!studio) return tl::make_unexpected(studio.error());
  AppState& state = (*studio)->state();
  apply(state, OpenFile{options.file});
  if (state.last_error) return tl::make_unexpected(*state.last_error);
  if (options.device == "auto") {
    if (auto seated = take_simulated_hand(state, options.file); !seated) return seated;
  } else if (options.device != "none") {
    state.devices = std::make_unique<DeviceWatch>(look_for(options.device, options.falcon));
  }
  const servo::ForceSignals signals;
  (*host)->run(**studio, options.servo_report_s);
  return report_servo(**studio, options.json);
}

int run(int argc, char** argv) {
  StudioOptions options;
  if (const auto ended = cli::parse(argc, argv, kSmallestScale, kLargestScale, options))
    return *ended;
  const auto log = [&](std::string_view line) {
    if (!options.log) return;
    cli::put_out(std::string(line) + "\n");
    (void)cli::flush_out();
  };
  const bool without_screen = !options.script.empty() || !options.screenshot.empty();
  const auto done = without_screen                 ? run_script(options, log)
                    : options.servo_report_s > 0.0 ? run_servo_report(options, log)
                                                   : run_window(options, log);
  return done ? cli::kDone : cli::report(done.error());
}

}  // namespace
}  // namespace clay::studio

int main(int argc, char** argv) { return clay::cli::run_program(clay::studio::run, argc, argv); }
