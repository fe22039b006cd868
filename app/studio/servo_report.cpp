#include "app/studio/servo_report.hpp"

#include "app/cli/console.hpp"
#include "app/cli/device_choice.hpp"
#include "app/cli/live_report.hpp"
#include "app/cli/replay.hpp"
#include "app/servo/scene_hand.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace clay::studio {
namespace {

constexpr double kMsPerNs = 1e-6, kUsPerNs = 1e-3;

cli::Json window_json(const Drawn& drawn) {
  const auto ms = [&](double part) {
    return kMsPerNs * static_cast<double>(drawn.took.quantile_ns(part));
  };
  return {{"frames", drawn.took.count()},
          {"fps", drawn.fps()},
          {"frame_ms", {{"p50", ms(0.5)}, {"p99", ms(0.99)}, {"max", ms(1.0)}}}};
}

void tell_window(const cli::Console& console, const cli::Json& window) {
  const cli::Json& frame = window["frame_ms"];
  console.say(fmt::format(
      "window: {} frames, {:.1f} a second; each: median {:.3g} ms, 99 % within {:.3g}, "
      "at most {:.3g}",
      window["frames"].get<std::uint64_t>(), window["fps"].get<double>(),
      frame["p50"].get<double>(), frame["p99"].get<double>(), frame["max"].get<double>()));
}

/// Against what is promised.
Result<void> judge(double late_p99_us, double fps, bool fifo) {
  const auto missed = [](std::string what) {
    return failure(ErrorKind::unsound, "servo report: expected " + std::move(what));
  };
  if (!fifo) return missed("SCHED_FIFO, which the system does not give");
  if (fps < kFewestFps)
    return missed(fmt::format("{:g} frames a second or more, found {:.1f}", kFewestFps, fps));
  if (late_p99_us > kLatestP99Us)
    return missed(
        fmt::format("99 % of ticks woken within {:g} us, found {:.1f}", kLatestP99Us, late_p99_us));
  return {};
}

}  // namespace

Result<void> seat_simulated_hand(AppState& shop, const std::string& scene_path) {
  const auto session = cli::load_session(cli::session_beside(scene_path));
  if (!session) return tl::make_unexpected(session.error());
  servo::LiveSettings settings;
  settings.mapping = servo::fitted(settings.mapping, session->poses, servo::kSimulatedReachMm);
  const auto mapping = servo::Mapping::build(settings.mapping);
  if (!mapping) return tl::make_unexpected(mapping.error());
  auto device =
      cli::open_chosen("simulated", {}, servo::simulated_potter(session->poses, *mapping));
  if (!device) return tl::make_unexpected(device.error());
  shop.potter.take(std::move(*device), settings);
  return {};
}

Result<void> report_servo(Studio& studio, bool json) {
  StrokeController& potter = studio.shop().potter;
  potter.release();
  const ServoRecord& servo = potter.servo();
  if (servo.timing.ticks == 0)
    return failure(ErrorKind::device, "servo report: expected an arm that throws, found none");
  const cli::Console console{.json = json, .quiet = false};
  const cli::Json report = {{"servo", cli::servo_json(servo.timing, servo.events, servo.realtime)},
                            {"window", window_json(studio.drawn())}};
  if (json) console.print(report);
  cli::tell_servo(console, report["servo"]);
  console.say(std::string("scheduling: ") +
              (servo.realtime.fifo ? "SCHED_FIFO" : "that of every other program"));
  tell_window(console, report["window"]);
  return judge(kUsPerNs * static_cast<double>(servo.timing.lateness.quantile_ns(0.99)),
               studio.drawn().fps(), servo.realtime.fifo);
}

}  // namespace clay::studio
