#pragma once
// The window as a canvas of a web page.

#include "app/studio/host.hpp"
#include "app/studio/virtual_clock.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

namespace clay::web {

/// Has no threads: the servo advances within a frame. Its time is that of the page while the page
/// is visible, and never advances by more than kLongestFrameMs between two frames: after a pause
/// the page does not press on into the clay.
class WebHost final : public studio::Host {
 public:
  static constexpr double kLongestFrameMs = 100.0;

  /// `fingers`: the main pointer is coarse, as on a phone.
  explicit WebHost(bool fingers) : fingers_(fingers) {}
  void resize(glm::ivec2 size_px, float scale) noexcept {
    size_px_ = size_px;
    scale_ = scale;
  }
  /// Begins a frame at this time of the page [ms].
  void begin_frame(double page_ms) noexcept;
  void paste(std::string text) { clipboard_ = std::move(text); }

  [[nodiscard]] glm::ivec2 size_px() const override { return size_px_; }
  [[nodiscard]] float content_scale() const override { return scale_; }
  [[nodiscard]] bool fingers() const override { return fingers_; }
  [[nodiscard]] servo::Clock& clock() override { return clock_; }
  [[nodiscard]] bool real_time() const override { return true; }
  [[nodiscard]] bool threads() const override { return false; }
  [[nodiscard]] std::int64_t frame_ns() override { return frame_ns_; }
  void set_title(const std::string& title) override;
  void set_clipboard(const std::string& text) override;
  [[nodiscard]] std::string clipboard() override { return clipboard_; }
  void file_written(const std::string& path) override;

 private:
  bool fingers_;
  glm::ivec2 size_px_{1, 1};
  float scale_ = 1.0f;
  studio::VirtualClock clock_;
  std::int64_t frame_ns_ = clock_.now_ns();
  double last_ms_ = -1.0;
  std::string clipboard_;
};

}  // namespace clay::web
