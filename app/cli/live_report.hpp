#pragma once
// What a live throw says of itself: in a line while it runs, in full when it is over.

#include "app/cli/console.hpp"
#include "app/servo/servo.hpp"

#include <string>

namespace clay::cli {

/// For scripts: "time_up".
[[nodiscard]] const char* name_of(servo::Ending ending);

/// In the terminal: lets force be earned again.
inline constexpr const char* kRearmKey = "r";

/// One line: rate, force, volume error, words.
[[nodiscard]] std::string status_line(const servo::LiveStatus& status, double rate_hz);

/// Times in us, events by name.
[[nodiscard]] Json servo_json(const servo::ServoTiming& timing, const servo::GuardEvents& events,
                              const servo::Realtime& realtime);

/// The same for people.
void tell_servo(const Console& console, const Json& servo);

}  // namespace clay::cli
