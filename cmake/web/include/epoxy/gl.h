#pragma once
// In a page, OpenGL ES 3 stands for libepoxy: the browser loads it.

#include <GLES3/gl3.h>

inline bool epoxy_is_desktop_gl() { return false; }
inline int epoxy_gl_version() { return 30; }

// A browser's glFinish does not wait until a frame is drawn. Reading a pixel does.
inline void claystack_web_finish() {
  GLubyte pixel[4];
  glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
}
#define glFinish claystack_web_finish
