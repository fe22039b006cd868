#pragma once
// The picture of the view in a separate canvas, because the painter fills its whole target.

#include "app/render/edge_smoother.hpp"
#include "app/render/gl_objects.hpp"
#include "app/render/painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>

namespace clay::studio {

struct Fineness {
  int samples;  ///< samples per pixel
  int divisor;  ///< divisor of width and height
  friend bool operator==(const Fineness&, const Fineness&) = default;
};
inline constexpr std::array<Fineness, 4> kFineness = {{{4, 1}, {1, 1}, {1, 2}, {1, 3}}};

/// Resolution of the view. Without a graphics card a view that changes, because the pot or the
/// pointer moves, is drawn with fewer pixels, and with all of them at rest: then in several frames,
/// each a part of the rows, so that the window keeps responding.
class Quality {
 public:
  [[nodiscard]] Fineness fineness(bool changing) const noexcept {
    return kFineness[changing ? level_ : 0];
  }
  /// The number of frames over which a picture at rest with this many samples is drawn.
  [[nodiscard]] int frames(double samples) const noexcept {
    return static_cast<int>(
        std::clamp(std::ceil(sample_s_ * samples / kPartS), 1.0, double{kMostFrames}));
  }
  /// Reports the drawing time of a frame of a changing view, and its number of samples.
  void took(double seconds, double samples) noexcept {
    sample_s_ = seconds / samples;
    if (frames_ < 2) return begin(seconds);
    smooth_s_ = smooth_s_ > 0.0 ? 0.7 * smooth_s_ + 0.3 * seconds : seconds;
    // A pot that lags behind the hand is worse than a coarse one, so the resolution falls at once
    // and rises slowly.
    if (smooth_s_ > kSlowS && level_ + 1 < kFineness.size())
      change(level_ + 1);
    else if (++since_ >= kFramesBetween && smooth_s_ < kFastS && level_ > 0)
      change(level_ - 1);
  }

 private:
  // The next finer level costs up to three times as much.
  static constexpr double kSlowS = 0.033, kFastS = 0.010;
  static constexpr int kFramesBetween = 30;
  static constexpr double kPartS = 0.040;
  static constexpr int kMostFrames = 12;  // each draws all corners again
  /// Samples of a frame, for each pixel of the view.
  static double density(const Fineness& fine) noexcept {
    return static_cast<double>(fine.samples) / (fine.divisor * fine.divisor);
  }
  /// The first frames are the coarsest, so that they are quick on any machine. Drivers compile in
  /// the first one; from the time of the second follows the finest level that is not too slow.
  void begin(double coarsest_s) noexcept {
    if (++frames_ < 2) return;
    const double pixel_s = coarsest_s / density(kFineness.back());
    while (level_ > 0 && pixel_s * density(kFineness[level_ - 1]) <= kSlowS) --level_;
  }
  void change(std::size_t level) noexcept {
    level_ = level;
    since_ = 0;
    smooth_s_ = 0.0;
  }

  std::size_t level_ = kFineness.size() - 1;
  double smooth_s_ = 0.0, sample_s_ = 0.0;
  int since_ = 0, frames_ = 0;
};

class ViewCanvas {
 public:
  /// Requires an OpenGL context to be current, here and in every call.
  static Result<ViewCanvas> create();

  /// Sets the picture and the size of the view. Without `real_time` the resolution is never
  /// reduced. Returns whether the picture is not drawn yet.
  bool show(render::Picture picture, render::Viewport size, double now_s, bool real_time);
  /// Draws it, or a part of it. False: it was drawn before. `device`: the driver refuses this size.
  Result<bool> draw();
  /// Copies it to a framebuffer; its lower left corner there [px].
  void copy_to(unsigned framebuffer, glm::ivec2 corner_px) const;
  /// The picture changes, or did a moment ago: it is drawn at a reduced resolution.
  [[nodiscard]] bool changing() const noexcept { return changing_; }
  /// True if it will be drawn finer without another change.
  [[nodiscard]] bool unfinished() const noexcept { return redraw_ || fine_ != kFineness[0]; }
  /// The time that `draw` took in a changing view.
  void took(double seconds) noexcept { quality_.took(seconds, samples()); }
  /// Prepares the driver; returns whether more is left to do.
  bool warm_up() noexcept { return painter_.warm_up(); }

 private:
  ViewCanvas(render::Painter painter, render::EdgeSmoother smoother);
  Result<void> fit(std::optional<render::Canvas>& canvas, int divisor);
  Result<void> draw_reduced();
  Result<void> draw_rows();
  [[nodiscard]] double samples() const noexcept;

  static constexpr double kSettledS = 0.15;  // after this time without a change it is at rest

  render::Painter painter_;
  render::EdgeSmoother smoother_;
  render::Picture picture_;
  render::Viewport size_{0, 0};
  /// With fewer pixels than the view: `reduced_`, and `smoothed_` of it. `whole_` has all pixels.
  std::optional<render::Canvas> reduced_, smoothed_, whole_;
  bool shows_whole_ = true;
  Quality quality_;
  Fineness fine_ = kFineness[0];
  double changed_s_ = -1.0;
  bool changing_ = false;
  bool redraw_ = true;  // the canvas does not show picture_
  int next_part_ = 0;   // of `whole_` at rest
};

}  // namespace clay::studio
