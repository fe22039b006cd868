#pragma once
// Keys of the terminal while throwing: space pauses and goes on, z takes the force away, r lets it
// be earned again, q ends.

#include "app/servo/servo.hpp"

#include <chrono>

namespace clay::cli {

/// For as long as it lives each key of the terminal counts at once and is not shown, where standard
/// input is a terminal and ours to read. However it ends, signals included, the terminal is as
/// before. Within the life of a servo::ForceSignals; one at a time.
class LiveKeys {
 public:
  LiveKeys();
  ~LiveKeys();
  LiveKeys(const LiveKeys&) = delete;
  LiveKeys& operator=(const LiveKeys&) = delete;

  /// Whether there are any.
  [[nodiscard]] bool on() const noexcept { return on_; }

  /// Hands keys on to the servo, for so long or until a signal comes.
  void serve(servo::Servo& servo, std::chrono::milliseconds time);

 private:
  void press(char key, servo::Servo& servo);

  bool on_ = false;
  bool paused_ = false;
};

/// For the potter.
inline constexpr const char* kKeysInWords =
    "keys: space pauses and goes on, z takes the force away, r gives it back, q ends";

}  // namespace clay::cli
