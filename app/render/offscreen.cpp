#include "app/render/offscreen.hpp"

#include "app/render/gl_objects.hpp"
#include "app/render/painter.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>

namespace clay::render {
namespace {

/// The display without a surface. EGL returns the same display to every context and does not count
/// them: the last context terminates it.
class EglDisplay {
 public:
  static EGLDisplay acquire() {
    const std::scoped_lock lock(mutex_);
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
      return EGL_NO_DISPLAY;
    ++users_;
    return display;
  }
  static void release(EGLDisplay display) {
    const std::scoped_lock lock(mutex_);
    if (--users_ == 0) eglTerminate(display);
  }

 private:
  static inline std::mutex mutex_;
  static inline int users_ = 0;
};

/// A context on the display; ends with the object.
class EglContext {
 public:
  static Result<EglContext> create();
  EglContext(EglContext&& other) noexcept
      : display_(std::exchange(other.display_, EGL_NO_DISPLAY)), context_(other.context_) {}
  EglContext& operator=(EglContext&&) = delete;
  ~EglContext() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    EglDisplay::release(display_);
  }
  bool make_current() const {
    return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }

 private:
  explicit EglContext(EGLDisplay display) : display_(display) {}
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

tl::unexpected<Error> no_context(const std::string& what) {
  return failure(ErrorKind::device,
                 fmt::format("drawing without a screen: expected {} (Debian: libegl1, "
                             "libgl1-mesa-dri), found none",
                             what));
}

Result<EglContext> EglContext::create() {
  // libepoxy aborts if the library is missing.
  void* library = dlopen("libEGL.so.1", RTLD_LAZY);
  if (library == nullptr) return no_context("the library libEGL.so.1");
  dlclose(library);
  for (const char* extension : {"EGL_EXT_platform_base", "EGL_MESA_platform_surfaceless"})
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, extension)) return no_context(extension);
  const EGLDisplay display = EglDisplay::acquire();
  if (display == EGL_NO_DISPLAY) return no_context("an EGL display without a surface");
  EglContext made(display);
  constexpr std::array<EGLint, 5> kConfig{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                          EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE ||
      eglChooseConfig(display, kConfig.data(), &config, 1, &found) != EGL_TRUE || found < 1)
    return no_context("an EGL configuration for OpenGL");
  constexpr std::array<EGLint, 7> kContext{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
  made.context_ = eglCreateContext(display, config, EGL_NO_CONTEXT, kContext.data());
  if (made.context_ == EGL_NO_CONTEXT || !made.make_current())
    return no_context("an OpenGL 3.3 core context without a surface");
  return made;
}

/// Rows of a picture that are drawn at a time: all of them, or equal parts of a picture that is
/// larger than a full HD screen. Four samples of a pixel take 40 bytes of the driver's memory.
int strip_rows(Viewport viewport) {
  constexpr int kMostPixels = 1 << 21;
  const int height = viewport.height_px, most = std::max(1, kMostPixels / viewport.width_px);
  const int strips = (height + most - 1) / most;
  return (height + strips - 1) / strips;
}

/// Reads the rows that the bound framebuffer holds.
void read_rows(PixelRows rows, Image& image) {
  const int width = image.width_px, last = image.height_px - 1;
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, rows.count, GL_RGBA, GL_UNSIGNED_BYTE,
               image.at(0, image.height_px - rows.first - rows.count));
  for (int k = 0; k < rows.count / 2; ++k) {  // OpenGL's rows start at the bottom
    std::uint8_t* const lower = image.at(0, last - rows.first - k);
    std::uint8_t* const upper = image.at(0, last - rows.first - (rows.count - 1 - k));
    std::swap_ranges(lower, lower + 4 * static_cast<std::ptrdiff_t>(width), upper);
  }
}

/// From colours weighted by their coverage, as anti-aliasing leaves them, to plain ones.
void undo_coverage(Image& image) {
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const unsigned alpha = image.rgba[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t k = i; k < i + 3; ++k)
      image.rgba[k] =
          static_cast<std::uint8_t>(std::min(255u, (255u * image.rgba[k] + alpha / 2) / alpha));
  }
}

}  // namespace

struct Offscreen::State {
  EglContext context;  ///< destroyed after the objects made in it
  std::string renderer;
  std::optional<Canvas> target;
  std::optional<Painter> painter;

  ~State() { context.make_current(); }  // for the names that are deleted now

  /// Calls `painted` after each strip of the picture, which the bound framebuffer holds.
  Result<void> paint(const Picture& picture, Viewport viewport, int samples,
                     const std::function<void(PixelRows)>& painted) {
    if (!context.make_current()) return no_context("the OpenGL context of this program");
    const int height = viewport.height_px, count = strip_rows(viewport);
    if (!(target && target->is(viewport.width_px, count, 0))) {
      target.reset();
      auto made = Canvas::create(viewport.width_px, count, 0);
      if (!made) return tl::make_unexpected(made.error());
      target.emplace(std::move(*made));
    }
    for (int first = 0; first < height; first += count) {
      // The last strip may overlap the one below it, so that all have the same size.
      const PixelRows strip{std::min(first, height - count), count};
      glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer());
      painter->paint_strip(picture, viewport.width_px, height, samples, strip);
      painted(strip);
    }
    return {};
  }
};

Offscreen::Offscreen(std::unique_ptr<State> state) : state_(std::move(state)) {}
Offscreen::Offscreen(Offscreen&&) noexcept = default;
Offscreen& Offscreen::operator=(Offscreen&&) noexcept = default;
Offscreen::~Offscreen() = default;

Result<Offscreen> Offscreen::create() {
  auto context = EglContext::create();
  if (!context) return tl::make_unexpected(context.error());
  std::unique_ptr<State> state(new State{std::move(*context), {}, std::nullopt, std::nullopt});
  auto painter = Painter::create();
  if (!painter) return tl::make_unexpected(painter.error());
  state->painter.emplace(std::move(*painter));
  state->renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return Offscreen(std::move(state));
}

Result<Image> Offscreen::draw(const Picture& picture, Viewport viewport) {
  Image image{viewport.width_px, viewport.height_px, {}};
  image.rgba.resize(4 * static_cast<std::size_t>(viewport.width_px) *
                    static_cast<std::size_t>(viewport.height_px));
  return state_
      ->paint(picture, viewport, kSamples, [&](PixelRows strip) { read_rows(strip, image); })
      .map([&] {
        if (picture.alone) undo_coverage(image);
        return std::move(image);
      });
}

Result<double> Offscreen::time_ms(const Picture& picture, Viewport viewport, int samples) {
  const auto begin = std::chrono::steady_clock::now();
  return state_->paint(picture, viewport, samples, [](PixelRows) { glFinish(); }).map([&] {
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    return took.count();
  });
}

const std::string& Offscreen::renderer() const noexcept { return state_->renderer; }

}  // namespace clay::render
