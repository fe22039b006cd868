#pragma once
// Keys of the terminal while throwing: space pauses and resumes, z sets the force to zero, r lets
// it ramp up again, q ends.

#include "claystack/servo/servo.hpp"

#include <chrono>

namespace clay::cli {

/// During its scope each key acts immediately and is not echoed, if standard input is a terminal in
/// the foreground. The terminal is always restored, also on signals. Use within the scope of a
/// servo::ForceSignals; one at a time.
class LiveKeys {
 public:
  LiveKeys();
  ~LiveKeys();
  LiveKeys(const LiveKeys&) = delete;
  LiveKeys& operator=(const LiveKeys&) = delete;

  /// Whether keys are available.
  [[nodiscard]] bool on() const noexcept { return on_; }

  /// Passes keys to the servo for the given time, or until a signal arrives.
  void serve(servo::LiveThrow& live, std::chrono::milliseconds time);

 private:
  void press(char key, servo::LiveThrow& live);

  bool on_ = false;
  bool paused_ = false;
};

/// Help text for the user.
inline constexpr const char* kKeysInWords =
    "keys: space pauses and resumes, z sets the force to zero, r restores it, q ends";

}  // namespace clay::cli
