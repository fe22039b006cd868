#pragma once
// The report of `claystack studio --servo-report`: timings of the servo and of the window.

#include "app/servo/tick_trace.hpp"
#include "claystack/servo/servo.hpp"

#include <cstdint>

namespace clay::cli {

/// Frames with a moving pot.
struct FrameTiming {
  std::uint64_t frames = 0;
  double fps = 0.0;
  double median_ms = 0.0, p99_ms = 0.0, longest_ms = 0.0;
};

/// Prints to standard output, for people or as JSON.
void print_window_report(const servo::ServoTiming& timing, const servo::GuardEvents& events,
                         const servo::Realtime& realtime, const FrameTiming& frames, bool json);

}  // namespace clay::cli
