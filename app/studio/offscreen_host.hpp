#pragma once
// A host without a window: a picture in memory, and a virtual clock.

#include "app/render/gl_objects.hpp"
#include "app/render/image.hpp"
#include "app/render/offscreen.hpp"
#include "app/studio/host.hpp"
#include "app/studio/virtual_clock.hpp"
#include "claystack/core/result.hpp"

#include <memory>

namespace clay::studio {

class OffscreenHost final : public Host {
 public:
  /// Makes its OpenGL context current. Errors as render::Offscreen::create.
  static Result<std::unique_ptr<OffscreenHost>> create(glm::ivec2 size_px, float content_scale);

  /// Redirects drawing into the picture.
  void bind();
  [[nodiscard]] render::Image read() const;

  [[nodiscard]] glm::ivec2 size_px() const override {
    return {canvas_.width_px(), canvas_.height_px()};
  }
  [[nodiscard]] float content_scale() const override { return scale_; }
  [[nodiscard]] servo::Clock& clock() override { return clock_; }
  [[nodiscard]] bool real_time() const override { return false; }
  [[nodiscard]] std::int64_t frame_ns() override { return frame_ns_; }
  /// Sets the time of the next frame.
  void advance(std::int64_t ns) noexcept { frame_ns_ += ns; }
  void set_title(const std::string&) override {}
  void set_clipboard(const std::string& text) override { clipboard_ = text; }
  [[nodiscard]] std::string clipboard() override { return clipboard_; }

 private:
  OffscreenHost(render::Offscreen gl, render::Canvas canvas, float scale)
      : gl_(std::move(gl)), canvas_(std::move(canvas)), scale_(scale) {}

  render::Offscreen gl_;  // owns the current context
  render::Canvas canvas_;
  float scale_;
  VirtualClock clock_;
  std::int64_t frame_ns_ = clock_.now_ns();
  std::string clipboard_;
};

}  // namespace clay::studio
