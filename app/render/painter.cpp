#include "app/render/painter.hpp"

#include "app/render/look.hpp"
#include "app/render/scene_painter.hpp"

#include <fmt/format.h>

#include <optional>

namespace clay::render {
namespace {

constexpr int kOldest = 33, kOldestES = 30;  // OpenGL 3.3, OpenGL ES 3.0 (a web page's WebGL 2)

GLuint bound_framebuffer() {
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  return static_cast<GLuint>(bound);
}

}  // namespace

struct Painter::State {
  ScenePainter scene;
  std::optional<Canvas> canvas;  ///< multisampled, of the last requested size
};

Painter::Painter(std::unique_ptr<State> state) : state_(std::move(state)) {}
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;
Painter::~Painter() = default;

Result<Painter> Painter::create() {
  const int version = epoxy_gl_version();
  if (version < (epoxy_is_desktop_gl() ? kOldest : kOldestES))
    return failure(ErrorKind::device, fmt::format("expected OpenGL 3.3 or later, found {}.{}",
                                                  version / 10, version % 10));
  return ScenePainter::create().map([](ScenePainter scene) {
    return Painter(std::make_unique<State>(State{std::move(scene), std::nullopt}));
  });
}

void Painter::paint(const Picture& picture, int width_px, int height_px, int samples) noexcept {
  if (width_px < 1 || height_px < 1) return;
  const Viewport viewport{width_px, height_px};
  auto& canvas = state_->canvas;
  if (samples > 1 && !(canvas && canvas->is(width_px, height_px, samples))) {
    canvas.reset();
    // If a driver lacks memory for samples, draw without antialiasing.
    if (auto made = Canvas::create(width_px, height_px, samples)) canvas.emplace(std::move(*made));
  }
  if (samples <= 1 || !canvas) {
    state_->scene.paint(picture, viewport);
    return;
  }
  const GLuint target = bound_framebuffer();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas->framebuffer());
  state_->scene.paint(picture, viewport);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  glBlitFramebuffer(0, 0, width_px, height_px, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target);
}

}  // namespace clay::render
