#include "app/cli/window_report.hpp"
#include "app/cli/json_output.hpp"

#include "app/cli/live_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

namespace clay::cli {

void print_window_report(const servo::ServoTiming& timing, const servo::GuardEvents& events,
                         const servo::Realtime& realtime, const FrameTiming& frames, bool json) {
  const Console console{.json = json, .quiet = false};
  const Json servo = servo_json(timing, events, realtime);
  if (json) {
    const Json frame_ms = {
        {"p50", frames.median_ms}, {"p99", frames.p99_ms}, {"max", frames.longest_ms}};
    const Json window = {{"frames", frames.frames}, {"fps", frames.fps}, {"frame_ms", frame_ms}};
    print_json({{"servo", servo}, {"window", window}});
  }
  print_servo(console, servo);
  console.print(std::string("scheduling: ") +
                (realtime.fifo ? "SCHED_FIFO" : "that of every other program"));
  console.print(fmt::format(
      "window: {} frames, {:.1f} per second; each: median {:.3g} ms, 99 % within {:.3g}, "
      "at most {:.3g}",
      frames.frames, frames.fps, frames.median_ms, frames.p99_ms, frames.longest_ms));
}

}  // namespace clay::cli
