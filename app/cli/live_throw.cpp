#include "app/cli/live_throw.hpp"

#include "app/cli/clay_summary.hpp"
#include "app/cli/live_keys.hpp"
#include "app/cli/live_report.hpp"
#include "app/cli/live_stage.hpp"
#include "app/cli/rescue.hpp"
#include "app/servo/servo_check.hpp"
#include "app/servo/signals.hpp"
#include "app/servo/tick_trace.hpp"
#include "app/servo/words.hpp"
#include "claystack/engine/files.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

namespace clay::cli {
namespace {

using namespace std::chrono_literals;
using servo::Ending;

constexpr auto kLook = 20ms;  // polling period for the servo's end
constexpr auto kReopen = 500ms;

Pot thrown_pot(const LiveStage& stage) {
  return servo::with_force_of_scene(stage.wheel->pot(), settings_of(stage.scene), stage.force);
}

/// Shows the servo's state until it ends. `ticks`: of the servo before it was started.
void watch(servo::LiveThrow& live, std::uint64_t ticks, LiveKeys& keys, StatusLine& line) {
  auto since = std::chrono::steady_clock::now();
  double rate_hz = 0.0;
  while (live.running()) {
    keys.serve(live, kLook);
    if (!line.due()) continue;
    const servo::LiveStatus& status = live.status();
    const auto now = std::chrono::steady_clock::now();
    rate_hz = static_cast<double>(status.ticks - ticks) /
              std::chrono::duration<double>(now - since).count();
    ticks = status.ticks;
    since = now;
    line.show(status_line(status, rate_hz));
  }
}

/// Tries to reopen the device until it succeeds (`none`), until a signal or the key q ends the
/// wait, or until a fault that waiting cannot remove. Reports each fault, except that the device is
/// absent.
Ending comes_back(falcon::HapticDevice& device, LiveKeys& keys, const Console& console) {
  using falcon::DeviceFault;
  auto reported = DeviceFault::unplugged;
  while (servo::ForceSignals::asked_to_stop() == 0) {
    const auto opened = device.open();
    if (opened) return Ending::none;
    const DeviceFault fault = opened.error().fault;
    if (fault == DeviceFault::bad_firmware || fault == DeviceFault::unreadable_firmware ||
        fault == DeviceFault::bad_setting)
      return Ending::device_lost;
    const bool absent = fault == DeviceFault::unplugged || fault == DeviceFault::not_found;
    if (!absent && fault != reported) console.warn(opened.error().message + "; still waiting");
    reported = fault;
    if (!keys.wait(kReopen)) break;
  }
  return Ending::stopped;
}

/// Ends with zero force. Use within the scope of a servo::ForceSignals.
Result<Ending> run(LiveStage& stage, const LiveOptions& options, const Console& console) {
  LiveKeys keys;
  if (keys.on()) console.print(kKeysInWords);
  StatusLine line(console);
  for (;;) {
    const std::uint64_t ticks = stage.live->status().ticks;
    if (auto started = stage.live->start(); !started) return tl::make_unexpected(started.error());
    // An earlier signal found no servo to stop.
    if (servo::ForceSignals::asked_to_stop() != 0)
      stage.live->command({servo::CommandKind::stop, 0.0});
    watch(*stage.live, ticks, keys, line);
    const Ending ending = stage.live->join();
    if (ending != Ending::device_lost || !options.wait) return ending;
    line.clear();
    console.warn(stage.device->problem().message + "; waiting for it");
    if (const Ending end = comes_back(*stage.device, keys, console); end != Ending::none)
      return end;
  }
}

Json frames_json(const falcon::DeviceCounters& counters) {
  return {{"taken", counters.frames},
          {"bytes_discarded", counters.bytes_discarded},
          {"without_pose", counters.without_pose},
          {"writes_dropped", counters.writes_dropped}};
}

Json recording_json(const LiveOptions& options, const LiveStage& stage) {
  if (options.record.empty()) return nullptr;
  const servo::Recorded recorded = stage.live->recorded();
  return {{"path", options.record}, {"poses", recorded.poses}, {"lost", recorded.lost}};
}

struct Kept {
  Result<void> session, pot;
};

Result<void> keep_session(const LiveOptions& options, const Console& console, LiveStage& stage) {
  auto kept = stage.live->finish_recording();
  const servo::Recorded recorded = stage.live->recorded();
  if (kept && recorded.lost > 0)
    console.warn(fmt::format(
        "{}: {}: the last {} poses are missing, and the session replays to the pot before them",
        options.record,
        recorded.poses < kMaxPoses ? std::string("the disk was too slow")
                                   : fmt::format("a session holds at most {} poses", kMaxPoses),
        recorded.lost));
  return kept;
}

Result<void> keep_pot(const LiveJob& job, LiveStage& stage, const Pot& pot) {
  if (!stage.pot_file) return {};
  const std::string bytes = written_pot(job, pot);
  const auto written =
      stage.pot_file->write(bytes).and_then([&] { return stage.pot_file->commit(); });
  if (written) return written;
  const auto rescued = rescue(job.pot_path, stage.pot_file->rereadable(), bytes);
  return failure(
      written.error().kind,
      written.error().message +
          (rescued ? "; the pot is in " + rescued->string()
                   : "; the pot could not be saved elsewhere either: " + rescued.error().message));
}

/// The first error: the servo, files that were not kept, the device, or a throw without a pose.
/// Prints other errors of files.
Result<void> outcome_of(LiveStage& stage, const Result<Ending>& ended, const Kept& kept,
                        const Console& console) {
  if (!ended) {
    for (const auto* file : {&kept.session, &kept.pot})
      if (!*file) console.error(file->error().message);
    return tl::make_unexpected(ended.error());
  }
  const Ending ending = *ended;
  if (!kept.session && !kept.pot) console.error(kept.pot.error().message);
  if (auto all = kept.session ? kept.pot : kept.session; !all) return all;
  if (ending == Ending::device_lost) return tl::make_unexpected(stage.device->problem());
  const servo::LiveStatus& status = stage.live->status();
  if (ending == Ending::time_up && status.poses == 0)
    return failure(ErrorKind::device, stage.device->info().place + ": nothing was thrown; " +
                                          servo::words_of(status, kRearmKey));
  return {};
}

void print_result(const LiveJob& job, const LiveOptions& options, const Console& console,
                  const Json& json, const Kept& kept) {
  console.print(fmt::format("{:.1f} s on the wheel, {} poses, ended: {}",
                            json["seconds"].get<double>(), json["poses"].get<std::uint64_t>(),
                            words_of_name(json["ended"].get<std::string>())));
  print_clay(console, json);
  if (console.verbose) print_servo(console, json["servo"]);
  if (job.pot_path.empty())
    console.print(kPotNotWritten);
  else if (kept.pot)
    console.print("pot: " + job.pot_path);
  if (options.record.empty() || !kept.session) return;
  const bool empty = json["recording"]["poses"].get<std::uint64_t>() == 0;
  console.print("session: " + (empty ? "not written, since no pose was recorded" : options.record));
}

}  // namespace

Result<void> throw_live(const LiveJob& job, LiveOptions options, Console console) {
  if (job.pot_path == "-" || options.record == "-") console.quiet = true;
  LiveStage stage;
  if (auto built = build(job, options, console, stage); !built) return built;
  if (job.pot_path.empty() && options.record.empty())
    console.warn("neither the pot nor the session is kept: -o and --record write them");
  // Until pot and session are saved: a closing terminal may send its signal twice.
  std::optional<servo::ForceSignals> signals(std::in_place);
  const Result<Ending> ended = run(stage, options, console);
  const Pot pot = thrown_pot(stage);
  const Kept kept = {keep_session(options, console, stage), keep_pot(job, stage, pot)};
  signals.reset();

  servo::LiveThrow& live = *stage.live;
  const servo::LiveStatus& status = live.status();
  Json json = {{"scene", stage.scene.name},
               {"device", stage.device->info().name},
               {"ended", ended ? name_of(*ended) : "not_started"},
               {"seconds", status.time_s},
               {"poses", status.poses},
               {"frames", frames_json(stage.device->counters())},
               {"recording", recording_json(options, stage)},
               {"servo", servo_json(servo::LiveMeasures::timing(live),
                                    servo::LiveMeasures::events(live), live.realtime())}};
  json.update(clay_json(pot));
  const Result<void> outcome = outcome_of(stage, ended, kept, console);
  if (!outcome) json.update(error_json(outcome.error()));
  if (console.json) print_json(json);
  print_result(job, options, console, json, kept);
  return outcome;
}

}  // namespace clay::cli
