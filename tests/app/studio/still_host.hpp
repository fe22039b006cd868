#pragma once
// A host without window, screen or OpenGL, for tests of the state and the panels.

#include "app/studio/offscreen_host.hpp"

#include <string>

namespace clay::studio {

class StillHost final : public Host {
 public:
  [[nodiscard]] glm::ivec2 size_px() const override { return {1000, 700}; }
  [[nodiscard]] float content_scale() const override { return 1.0f; }
  [[nodiscard]] bool fingers() const override { return touched; }
  [[nodiscard]] servo::Clock& clock() override { return clock_; }
  [[nodiscard]] bool real_time() const override { return real; }
  [[nodiscard]] std::int64_t frame_ns() override { return clock_.now_ns(); }
  void set_title(const std::string&) override {}
  void set_clipboard(const std::string&) override {}
  [[nodiscard]] std::string clipboard() override { return {}; }

  bool touched = false;  ///< by fingers
  bool real = false;     ///< time passes

 private:
  VirtualClock clock_;
};

}  // namespace clay::studio
