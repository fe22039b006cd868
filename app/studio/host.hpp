#pragma once
// What a window gives, or the absence of one: a surface to draw on, time, a clipboard.

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
  /// Of the screen: 1 at 96 dots an inch.
  [[nodiscard]] virtual float content_scale() const = 0;
  /// The servo's.
  [[nodiscard]] virtual servo::Clock& clock() = 0;
  /// Whether that clock runs by itself. If not, the servo ticks within the frame until the clock
  /// has come to the frame's time, and all that happens is the same every time.
  [[nodiscard]] virtual bool real_time() const = 0;
  /// The time of this frame, of the same clock.
  [[nodiscard]] virtual std::int64_t frame_ns() = 0;
  virtual void set_title(const std::string& title) = 0;
  virtual void set_clipboard(const std::string& text) = 0;
  [[nodiscard]] virtual std::string clipboard() = 0;
};

}  // namespace clay::studio
