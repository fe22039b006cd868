#include "app/studio/offscreen_host.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace clay::studio {

Result<std::unique_ptr<OffscreenHost>> OffscreenHost::create(glm::ivec2 size_px,
                                                             float content_scale) {
  auto gl = render::Offscreen::create();
  if (!gl) return tl::make_unexpected(gl.error());
  auto canvas = render::Canvas::create(size_px.x, size_px.y, 0);
  if (!canvas) return tl::make_unexpected(canvas.error());
  return std::unique_ptr<OffscreenHost>(
      new OffscreenHost(std::move(*gl), std::move(*canvas), content_scale));
}

void OffscreenHost::bind() { glBindFramebuffer(GL_FRAMEBUFFER, canvas_.framebuffer()); }

render::Image OffscreenHost::read() const {
  const glm::ivec2 size = size_px();
  render::Image image{size.x, size.y, {}};
  const std::size_t row = 4 * static_cast<std::size_t>(size.x);
  image.rgba.resize(row * static_cast<std::size_t>(size.y));
  glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  for (int y = 0; y < size.y / 2; ++y) {  // OpenGL begins with the lowest row
    const auto upper = image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y;
    const auto lower = image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (size.y - 1 - y);
    std::swap_ranges(upper, upper + static_cast<std::ptrdiff_t>(row), lower);
  }
  // A window has no transparency, so its picture has none either.
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace clay::studio
