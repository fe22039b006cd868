#pragma once
// The gamepad as a hand: its left stick moves the tool, its right trigger presses, its left trigger
// pinches, its right stick turns the view. It acts on the wheel as the mouse does.

#include "app/studio/gamepad.hpp"

#include <string>
#include <utility>

namespace clay::studio {

struct AppState;

/// At full deflection: speed of the tool [mm/s], and turn of the view [rad/s].
inline constexpr double kStickMmPerS = 150.0, kStickRadPerS = 2.0;
/// Part of the deflection of a stick that is ignored.
inline constexpr double kStickDeadZone = 0.15;
/// A press begins at this part of the way of a trigger, and ends at that one.
inline constexpr double kPressFrom = 0.1, kPressUntil = 0.05;
/// The target of the tool is at most this far ahead of the tool [mm].
inline constexpr double kLeashMm = 15.0;

class GamepadHand {
 public:
  /// `name` empty: unplugged.
  void plug(std::string name) {
    name_ = std::move(name);
    pad_ = {};
  }
  /// Empty: none.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  void take(const GamepadState& pad) noexcept { pad_ = pad; }
  [[nodiscard]] const GamepadState& pad() const noexcept { return pad_; }
  /// Once a frame.
  void advance(AppState& state);
  /// A stick is off its rest.
  [[nodiscard]] bool moving() const noexcept;

 private:
  void press(AppState& state);
  void begin(AppState& state);
  void end(AppState& state);
  void lead(AppState& state, glm::dvec2 step_mm) const;
  void shape(AppState& state, glm::dvec2 step_mm) const;
  [[nodiscard]] double strength() const noexcept;

  std::string name_;
  GamepadState pad_;
  bool pressing_ = false;  // its own stroke is in progress
  bool pinching_ = false;  // with both triggers
  bool ready_ = true;      // the right trigger has been released since the last press
  double last_s_ = 0.0;    // of the previous frame, on the host's clock
};

}  // namespace clay::studio
