#pragma once
// Reports of a live throw: one line while it runs, a summary at the end.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "app/servo/tick_trace.hpp"
#include "claystack/servo/servo.hpp"

#include <string>

namespace clay::cli {

/// For scripts, for example "time_up".
[[nodiscard]] const char* name_of(servo::Ending ending);

/// The key that lets force ramp up again.
inline constexpr const char* kRearmKey = "r";

/// One line: rate, force, volume error, state.
[[nodiscard]] std::string status_line(const servo::LiveStatus& status, double rate_hz);

/// Times in us, events by name.
[[nodiscard]] Json servo_json(const servo::ServoTiming& timing, const servo::GuardEvents& events,
                              const servo::Realtime& realtime);

/// The same for people.
void print_servo(const Console& console, const Json& servo);

}  // namespace clay::cli
