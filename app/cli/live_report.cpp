#include "app/cli/live_report.hpp"

#include "app/servo/words.hpp"

#include <fmt/format.h>

#include <array>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

constexpr double kUsPerNs = 1e-3;
// In the order of GuardFlag and SafeCause.
constexpr std::array<const char*, servo::GuardEvents::kFlags> kFlagNames = {
    "not_ready", "not_finite", "limited",  "slewed", "jump",
    "stale",     "late",       "old_clay", "hot",    "clock"};
constexpr std::array<const char*, servo::GuardEvents::kCauses> kCauseNames = {
    "none", "not_finite", "not_passive", "jumped", "overrun", "paused", "stopped"};

Json times_json(const Histogram& times) {
  const auto us = [](std::int64_t ns) { return kUsPerNs * static_cast<double>(ns); };
  return {{"p50", us(times.quantile_ns(0.5))},
          {"p99", us(times.quantile_ns(0.99))},
          {"max", us(times.most_ns())}};
}

Json events_json(const servo::GuardEvents& events) {
  Json json = Json::object();
  for (std::size_t bit = 0; bit < events.flags.size(); ++bit)
    if (events.flags[bit] > 0) json[kFlagNames[bit]] = events.flags[bit];
  Json safe = Json::object();
  for (std::size_t cause = 1; cause < events.safe.size(); ++cause)
    if (events.safe[cause] > 0) safe[kCauseNames[cause]] = events.safe[cause];
  json["safe"] = safe;
  json["damped_ticks"] = events.damped;
  json["watchdog"] = events.watchdog;
  return json;
}

/// "not_ready 12, safe after jumped 1", or "no events".
std::string events_in_words(const Json& events) {
  std::string words;
  const auto add = [&](const std::string& what, const Json& count) {
    if (count.get<std::uint64_t>() > 0)
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", what, count.get<std::uint64_t>());
  };
  for (const auto& [name, value] : events.items()) {
    if (value.is_number()) add(name, value);
    if (value.is_object())
      for (const auto& [cause, count] : value.items())
        add(std::string("safe after ").append(cause), count);
  }
  return words.empty() ? "no events" : words;
}

std::string spread(const Json& times) {
  return fmt::format("median {:.4g} us, 99 % within {:.4g}, at most {:.4g}",
                     times["p50"].get<double>(), times["p99"].get<double>(),
                     times["max"].get<double>());
}

}  // namespace

const char* name_of(servo::Ending ending) {
  switch (ending) {
    case servo::Ending::none:
      return "running";
    case servo::Ending::stopped:
      return "stopped";
    case servo::Ending::time_up:
      return "time_up";
    case servo::Ending::device_lost:
      return "device_lost";
    case servo::Ending::collapsed:
      return "collapsed";
  }
  return "";
}

std::string status_line(const servo::LiveStatus& status, double rate_hz) {
  return fmt::format("{:6.1f} s  {:4.0f} Hz  {:4.2f} N  volume error {:.0f} quanta  {:5.1f} mm  {}",
                     status.time_s, rate_hz, glm::length(status.force_n), status.volume_error,
                     status.height_mm, servo::words_of(status, kRearmKey));
}

Json servo_json(const servo::ServoTiming& timing, const servo::GuardEvents& events,
                const servo::Realtime& realtime) {
  const double mean_ns = timing.period.mean_ns();
  return {{"ticks", timing.ticks},
          {"rate_hz", mean_ns > 0.0 ? 1e9 / mean_ns : 0.0},
          {"lateness_us", times_json(timing.lateness)},
          {"oversleep_us", times_json(timing.oversleep)},
          {"period_us", times_json(timing.period)},
          {"work_us", times_json(timing.work)},
          {"sample_age_us", times_json(timing.age)},
          {"work_share_percent", 100.0 * timing.work_share()},
          {"missed_ticks", timing.missed},
          {"stale_ticks", timing.stale},
          {"realtime",
           {{"fifo", realtime.fifo},
            {"memory_locked", realtime.memory_locked},
            {"exact_sleep", realtime.exact_sleep},
            {"missing", realtime.missing}}},
          {"guard", events_json(events)}};
}

void print_servo(const Console& console, const Json& servo) {
  console.print(fmt::format(
      "servo: {} ticks at {:.1f} Hz, {:.2g} % load, {} missed, "
      "{} without a fresh sample",
      servo["ticks"].get<std::uint64_t>(), servo["rate_hz"].get<double>(),
      servo["work_share_percent"].get<double>(), servo["missed_ticks"].get<std::uint64_t>(),
      servo["stale_ticks"].get<std::uint64_t>()));
  console.print("lateness: " + spread(servo["lateness_us"]));
  console.print("wake-up delay of the system: " + spread(servo["oversleep_us"]));
  console.print("work: " + spread(servo["work_us"]));
  console.print("age of samples: " + spread(servo["sample_age_us"]));
  console.print("guard: " + events_in_words(servo["guard"]));
  const auto missing = servo["realtime"]["missing"].get<std::string>();
  if (!missing.empty()) console.print("real time: " + missing);
}

}  // namespace clay::cli
