#pragma once
// The environment of the window, on screen or off screen: size, time, clipboard.

#include "app/servo/clock.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

namespace clay::studio {

class Host {
 public:
  Host() = default;
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  virtual ~Host() = default;

  [[nodiscard]] virtual glm::ivec2 size_px() const = 0;
  /// Scale of the screen: 1 at 96 dots per inch.
  [[nodiscard]] virtual float content_scale() const = 0;
  /// True if fingers touch the screen: controls need room.
  [[nodiscard]] virtual bool fingers() const { return false; }
  /// Clock of the servo.
  [[nodiscard]] virtual servo::Clock& clock() = 0;
  /// True if that clock runs in real time. Otherwise every run gives the same result: background
  /// jobs are waited for.
  [[nodiscard]] virtual bool real_time() const = 0;
  /// True if the servo and the planner of the guide run in separate threads. Otherwise the servo
  /// advances within each frame up to the time of the frame.
  [[nodiscard]] virtual bool threads() const { return real_time(); }
  /// Time of this frame on the same clock.
  [[nodiscard]] virtual std::int64_t frame_ns() = 0;
  virtual void set_title(const std::string& title) = 0;
  virtual void set_clipboard(const std::string& text) = 0;
  [[nodiscard]] virtual std::string clipboard() = 0;
  /// The user has saved or exported this file. A web page offers it as a download.
  virtual void file_written(const std::string&) {}
};

}  // namespace clay::studio
