#pragma once
// A host without window, screen or OpenGL, whose time passes in frames.

#include "app/studio/offscreen_host.hpp"

#include <string>

namespace clay::test {

inline constexpr double kFrameS = 1.0 / 60.0;

class TimedHost final : public studio::Host {
 public:
  [[nodiscard]] glm::ivec2 size_px() const override { return {1280, 800}; }
  [[nodiscard]] float content_scale() const override { return 1.0f; }
  [[nodiscard]] servo::Clock& clock() override { return clock_; }
  [[nodiscard]] bool real_time() const override { return false; }
  [[nodiscard]] std::int64_t frame_ns() override { return frame_ns_; }
  void advance() { frame_ns_ += static_cast<std::int64_t>(1e9 * kFrameS); }
  void set_title(const std::string&) override {}
  void set_clipboard(const std::string&) override {}
  [[nodiscard]] std::string clipboard() override { return {}; }

 private:
  studio::VirtualClock clock_;
  std::int64_t frame_ns_ = clock_.now_ns();
};

}  // namespace clay::test
