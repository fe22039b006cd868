#include "studio/gl_canvas.hpp"

#include <epoxy/gl.h>

namespace clay::studio {

GlCanvas::GlCanvas() {
  glGenFramebuffers(1, &framebuffer_);
  glGenRenderbuffers(1, &colour_);
  glGenRenderbuffers(1, &depth_);
}

GlCanvas::~GlCanvas() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(1, &colour_);
  glDeleteRenderbuffers(1, &depth_);
}

void GlCanvas::bind(glm::ivec2 size_px) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  if (size_px == size_px_) return;
  size_px_ = size_px;
  glBindRenderbuffer(GL_RENDERBUFFER, colour_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size_px.x, size_px.y);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size_px.x, size_px.y);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
}

void GlCanvas::copy_to(unsigned target, int target_height_px, glm::ivec2 corner_px) const {
  // OpenGL counts rows from below.
  const int top = target_height_px - corner_px.y;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  glBlitFramebuffer(0, 0, size_px_.x, size_px_.y, corner_px.x, top - size_px_.y,
                    corner_px.x + size_px_.x, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, target);
}

}  // namespace clay::studio
