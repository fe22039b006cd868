#include "app/studio/view_canvas.hpp"

#include <utility>

namespace clay::studio {

ViewCanvas::ViewCanvas(render::Painter painter, render::EdgeSmoother smoother)
    : painter_(std::move(painter)), smoother_(std::move(smoother)) {}

Result<ViewCanvas> ViewCanvas::create() {
  auto painter = render::Painter::create();
  if (!painter) return tl::make_unexpected(painter.error());
  auto smoother = render::EdgeSmoother::create();
  if (!smoother) return tl::make_unexpected(smoother.error());
  return ViewCanvas(std::move(*painter), std::move(*smoother));
}

bool ViewCanvas::show(render::Picture picture, render::Viewport size, double now_s,
                      bool real_time) {
  const bool changed = picture != picture_ || size != size_;
  if (changed) {
    picture_ = std::move(picture);
    size_ = size;
    changed_s_ = now_s;
  }
  changing_ = real_time && now_s - changed_s_ < kSettledS;
  const Fineness fine = quality_.fineness(changing_);
  if (changed || fine != fine_) {
    redraw_ = true;
    next_part_ = 0;
  }
  fine_ = fine;
  return redraw_;
}

double ViewCanvas::samples() const noexcept {
  const int width_px = size_.width_px / fine_.divisor, height_px = size_.height_px / fine_.divisor;
  return std::max(1.0, static_cast<double>(fine_.samples) * width_px * height_px);
}

Result<void> ViewCanvas::fit(std::optional<render::Canvas>& canvas, int divisor) {
  const int width_px = std::max(1, size_.width_px / divisor);
  const int height_px = std::max(1, size_.height_px / divisor);
  if (canvas && canvas->is(width_px, height_px, 0)) return {};
  canvas.reset();
  auto made = render::Canvas::create(width_px, height_px, 0);
  if (!made) return tl::make_unexpected(made.error());
  canvas.emplace(std::move(*made));
  return {};
}

Result<bool> ViewCanvas::draw() {
  if (!redraw_) return false;
  auto drawn = fine_.divisor > 1 ? draw_reduced() : draw_rows();
  if (!drawn) redraw_ = false;  // not again in every frame
  return drawn.map([] { return true; });
}

Result<void> ViewCanvas::draw_reduced() {
  if (auto fits = fit(reduced_, fine_.divisor); !fits) return fits;
  if (auto fits = fit(smoothed_, fine_.divisor); !fits) return fits;
  glBindFramebuffer(GL_FRAMEBUFFER, reduced_->framebuffer());
  painter_.paint(picture_, reduced_->width_px(), reduced_->height_px(), fine_.samples);
  smoother_.draw(*reduced_, *smoothed_);
  shows_whole_ = redraw_ = false;
  return {};
}

/// At rest, a part of the rows in each frame; meanwhile the coarser picture remains.
Result<void> ViewCanvas::draw_rows() {
  const bool fits_already = whole_ && whole_->is(size_.width_px, size_.height_px, 0);
  if (auto fits = fit(whole_, 1); !fits) return fits;
  const bool coarser = !shows_whole_ || fits_already;
  const int parts = changing_ || !coarser ? 1 : quality_.frames(samples());
  const int height_px = whole_->height_px();
  const auto row = [&](int part) { return part * height_px / parts; };
  const int next = std::min(next_part_, parts - 1);
  glBindFramebuffer(GL_FRAMEBUFFER, whole_->framebuffer());
  painter_.paint_rows(picture_, whole_->width_px(), height_px, fine_.samples,
                      {row(next), row(next + 1) - row(next)});
  next_part_ = next + 1;
  if (next_part_ < parts) return {};
  shows_whole_ = true;
  redraw_ = false;
  return {};
}

void ViewCanvas::copy_to(unsigned framebuffer, glm::ivec2 corner_px) const {
  const auto& canvas = shows_whole_ ? whole_ : smoothed_;
  if (!canvas) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas->framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, canvas->width_px(), canvas->height_px(), corner_px.x, corner_px.y,
                    corner_px.x + size_.width_px, corner_px.y + size_.height_px,
                    GL_COLOR_BUFFER_BIT, shows_whole_ ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

}  // namespace clay::studio
