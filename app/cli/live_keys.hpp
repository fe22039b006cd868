#pragma once
// Keys of the terminal while throwing: space pauses and resumes, z sets the force to zero, r lets
// it ramp up again, q ends.

#include "claystack/servo/servo.hpp"

#include <chrono>
#include <optional>
#include <string>

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

  /// Passes keys to the servo for the given time, or until a signal arrives; first those of wait().
  void serve(servo::LiveThrow& live, std::chrono::milliseconds time);
  /// Waits for the given time, or until a key is pressed or a signal arrives, while no servo runs.
  /// False: q was pressed. Other keys are kept for serve().
  bool wait(std::chrono::milliseconds time);

 private:
  /// Empty: no key was pressed.
  std::optional<char> key_within(std::chrono::milliseconds time);
  static void press(char key, servo::LiveThrow& live);

  bool on_ = false;
  std::string kept_;
};

/// Help text for the user.
inline constexpr const char* kKeysInWords =
    "keys: space pauses and resumes, z sets the force to zero, r restores it, q ends";

}  // namespace clay::cli
