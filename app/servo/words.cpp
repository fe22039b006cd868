#include "app/servo/words.hpp"

#include <fmt/format.h>

#include <array>

namespace clay::servo {
namespace {

using falcon::DeviceState;
using falcon::GuardState;
using falcon::SafeCause;

std::string words_of_safe(SafeCause cause, std::string_view rearm_key) {
  const auto rearm_after = [&](const char* why) {
    return fmt::format("no force: {}; press {} or the clutch to continue", why, rearm_key);
  };
  switch (cause) {
    case SafeCause::not_finite:
      return rearm_after("invalid force (NaN)");
    case SafeCause::not_passive:
      return rearm_after("the contact was unstable");
    case SafeCause::jumped:
      return "no force: the position jumped";
    case SafeCause::overrun:
      return "no force: the servo was delayed";
    case SafeCause::paused:
      return rearm_after("it was set to zero");
    default:
      return "no force";
  }
}

std::string words_of_slow_device(const LiveStatus& status) {
  if (status.answer_ms > 0.0)
    return fmt::format("; it feels softer, because the device answers after {:.1f} ms",
                       status.answer_ms);
  if (status.slow_hz == 0.0) return {};
  return fmt::format("; it feels softer, because samples come at {:.0f} Hz", status.slow_hz);
}

std::string words_of_guard(const LiveStatus& status, std::string_view rearm_key) {
  switch (status.guard) {
    case GuardState::idle:
      return "waiting for the device";
    case GuardState::waiting:
      return status.contact ? "lift the tool off the clay to get force" : "ready";
    case GuardState::ramping:
      return fmt::format("force ramps up, {:.0f} %", 100.0 * status.force_gain);
    case GuardState::engaged:
      return (status.contact ? "throwing" : "ready") + words_of_slow_device(status);
    case GuardState::fading:
      return "force fades out: no samples, or warm motors";
    case GuardState::safe:
      return words_of_safe(status.cause, rearm_key);
  }
  return {};
}

}  // namespace

const char* name_of(GuardState state) noexcept {
  constexpr std::array kNames = {"idle", "waiting", "ramping", "engaged", "fading", "safe"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string words_of(const LiveStatus& status, std::string_view rearm_key) {
  if (status.device == DeviceState::needs_homing) return std::string("home it: ") + kHomingAdvice;
  if (status.device != DeviceState::ready) return std::string(falcon::name_of(status.device));
  if (status.paused) return "paused";
  if (status.clutched) return "clutch held: the tool does not move";
  // A force that is off is reported first: the ring limit, once reached, remains for the throw.
  if (status.ring_limit && status.guard != GuardState::safe)
    return "there is clay above the top ring: increase lump.max_rings";
  return words_of_guard(status, rearm_key);
}

bool waits_for_rearm(const LiveStatus& status) noexcept {
  if (status.guard != GuardState::safe || status.paused || status.clutched) return false;
  return falcon::needs_rearm(status.cause);
}

}  // namespace clay::servo
