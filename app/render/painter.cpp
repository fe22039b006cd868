#include "app/render/painter.hpp"

#include "app/render/look.hpp"
#include "app/render/scene_painter.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <optional>

namespace clay::render {
namespace {

constexpr int kOldest = 33, kOldestES = 30;  // OpenGL 3.3, OpenGL ES 3.0 (a web page's WebGL 2)

GLuint bound_framebuffer() {
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  return static_cast<GLuint>(bound);
}

/// Small pictures that use every program, one after the other.
std::array<Picture, 4> rehearsal() {
  Picture clay;
  clay.pot = {{{10.0f, 0.0f}, {10.0f, 8.0f}}, 10.0, {}, {}};
  clay.camera = framed(clay.pot, 1.0);
  Picture cut = clay, coated = clay, tool = clay;
  cut.cut = Cut::quarter;
  coated.material = kWet;
  tool.tool = ToolView{.half_profile_mm = {{0.0f, -5.0f}, {5.0f, 0.0f}, {0.0f, 5.0f}},
                       .place_mm = {12.0, 5.0, 0.0},
                       .gap_mm = {},
                       .force_n = {1.0, 0.0, 0.0}};
  return {clay, tool, cut, coated};
}

}  // namespace

struct Painter::State {
  ScenePainter scene;
  std::optional<Canvas> canvas;  ///< multisampled, of the last requested size
  std::size_t warm = 0;          ///< number of pictures that warm_up has drawn

  /// `buffer`: the rows of the picture that the bound framebuffer holds, among them `rows`.
  void paint(const Picture& picture, Viewport viewport, int samples, PixelRows buffer,
             PixelRows rows);
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
    return Painter(std::make_unique<State>(State{std::move(scene), std::nullopt, 0}));
  });
}

void Painter::paint(const Picture& picture, int width_px, int height_px, int samples) noexcept {
  paint_rows(picture, width_px, height_px, samples, {0, height_px});
}

void Painter::paint_rows(const Picture& picture, int width_px, int height_px, int samples,
                         PixelRows rows) noexcept {
  state_->paint(picture, {width_px, height_px}, samples, {0, height_px}, rows);
}

void Painter::paint_strip(const Picture& picture, int width_px, int height_px, int samples,
                          PixelRows strip) noexcept {
  state_->paint(picture, {width_px, height_px}, samples, strip, strip);
}

void Painter::State::paint(const Picture& picture, Viewport viewport, int samples, PixelRows buffer,
                           PixelRows rows) {
  const int width = viewport.width_px;
  if (width < 1 || buffer.count < 1 || rows.count < 1) return;
  if (samples > 1 && !(canvas && canvas->is(width, buffer.count, samples))) {
    canvas.reset();
    // If a driver lacks memory for samples, draw without antialiasing.
    if (auto made = Canvas::create(width, buffer.count, samples)) canvas.emplace(std::move(*made));
  }
  if (samples <= 1 || !canvas) {
    scene.paint(picture, viewport, rows, buffer.first);
    return;
  }
  const GLuint target = bound_framebuffer();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas->framebuffer());
  scene.paint(picture, viewport, rows, buffer.first);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  const int low = rows.first - buffer.first, high = low + rows.count;
  glBlitFramebuffer(0, low, width, high, 0, low, width, high, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target);
}

bool Painter::warm_up() noexcept {
  constexpr int kSidePx = 16, kSamples[] = {1, 4};
  const std::array<Picture, 4> pictures = rehearsal();
  const std::size_t count = pictures.size() * std::size(kSamples);
  if (state_->warm >= count) return false;
  const std::size_t next = state_->warm++;
  const GLuint target = bound_framebuffer();
  // With samples and without, as the window draws.
  if (const auto canvas = Canvas::create(kSidePx, kSidePx, kSamples[next / pictures.size()])) {
    glBindFramebuffer(GL_FRAMEBUFFER, canvas->framebuffer());
    state_->scene.paint(pictures[next % pictures.size()], {kSidePx, kSidePx}, {0, kSidePx}, 0);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  return state_->warm < count;
}

}  // namespace clay::render
