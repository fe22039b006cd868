#include "studio/offscreen_host.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace clay::studio {

Result<std::unique_ptr<OffscreenHost>> OffscreenHost::create(glm::ivec2 size_px,
                                                             float content_scale) {
  auto gl = draw::Offscreen::create();
  if (!gl) return tl::make_unexpected(gl.error());
  return std::unique_ptr<OffscreenHost>(new OffscreenHost(std::move(*gl), size_px, content_scale));
}

void OffscreenHost::bind() { canvas_->bind(size_px_); }

draw::Image OffscreenHost::read() const {
  draw::Image image{size_px_.x, size_px_.y, {}};
  const std::size_t row = 4 * static_cast<std::size_t>(size_px_.x);
  image.rgba.resize(row * static_cast<std::size_t>(size_px_.y));
  glReadPixels(0, 0, size_px_.x, size_px_.y, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  for (int y = 0; y < size_px_.y / 2; ++y) {  // OpenGL begins below
    const auto upper = image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y;
    const auto lower = image.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (size_px_.y - 1 - y);
    std::swap_ranges(upper, upper + static_cast<std::ptrdiff_t>(row), lower);
  }
  // A window's own alpha is of no use in a picture of it.
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace clay::studio
