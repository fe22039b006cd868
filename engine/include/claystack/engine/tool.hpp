#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

namespace clay {

// ---- pose ----------------------------------------------------------------------------

/// One sample of the tool: the HIP at a time. A pinch has two tools, one on each side of a wall;
/// the HIP is then the middle of the gap between them.
struct Pose {
  std::int64_t time_us = 0;     ///< since the session began
  glm::dvec3 position_mm{0.0};  ///< y up, the wheel head at y = 0, the axis at x = z = 0
  bool trim = false;            ///< button: cut clay off instead of pressing it aside
  double gap_mm = 0.0;  ///< above 0: the distance of two tools where they are widest; 0: one tool
  friend bool operator==(const Pose&, const Pose&) = default;
};

// ---- tool ----------------------------------------------------------------------------
// The tool: a body of revolution about a vertical axis through the HIP (paper, section 3).

/// The orientation of a part of the tool's surface. With theta its slope against the axis, tan
/// theta = f', the depth along the normal is cos theta times the radial depth.
struct Facing {
  double normal2 = 1.0;  ///< cos^2 theta, 1 / (1 + f'^2)
  double lean = 0.0;     ///< cos^2 theta f'; at most 1/2
  double turn = 0.0;     ///< derivative of cos^2 theta by t [1/mm]
};

/// A part of the surface, evaluated at its middle.
struct Surface {
  double radius = 0.0;  ///< f [mm]
  Facing facing = {};
};

/// f(t) = b sqrt(1 - t^2/a^2); a sphere has a = b.
struct EllipseProfile {
  static constexpr double kSlopeLimit = 127.0 / 128.0;  ///< of |t| / a
  double a = 1.0, b = 1.0;
  double per_a = 1.0 / a;
  [[nodiscard]] double radius(double t) const noexcept {
    const double u = t * per_a, s = 1.0 - u * u;
    return b * std::sqrt(s > 0.0 ? s : 0.0);
  }
  /// f' = -b t / (a^2 sqrt(1 - t^2/a^2)), clamped to its value at 127/128 of the way to the poles,
  /// where the formula diverges.
  [[nodiscard]] double slope(double t) const noexcept {
    const double u = std::clamp(t / a, -kSlopeLimit, kSlopeLimit);
    return -(b / a) * u / std::sqrt(1.0 - u * u);
  }
  /// Around t; independent of the height, because the terms are bounded up to the poles.
  [[nodiscard]] Surface surface(double t, double /*height*/) const noexcept {
    return a == b ? surface_as<true>(t) : surface_as<false>(t);
  }
  /// The same for a profile known to be a sphere, or known not to be.
  template <bool sphere>
  [[nodiscard]] Surface surface_as(double t) const noexcept {
    const double u = t * per_a, s = 1.0 - u * u, flat = s > 0.0 ? s : 0.0, root = std::sqrt(flat);
    if constexpr (sphere) return {b * root, {flat, -u * root, -2.0 * u * per_a}};
    const double ratio = b * per_a, g = 1.0 / (flat + ratio * ratio * u * u);
    return {b * root,
            {flat * g, -ratio * u * root * g, -2.0 * u * per_a * (ratio * g) * (ratio * g)}};
  }
};

struct RibProfile {
  double b = 1.0;
  [[nodiscard]] double radius(double) const noexcept { return b; }
  [[nodiscard]] double slope(double) const noexcept { return 0.0; }
  [[nodiscard]] Surface surface(double, double) const noexcept { return {b, {}}; }
};

/// Monotone cubic (Fritsch and Carlson, SIAM J. Numer. Anal. 17(2) 1980): no overshoot, so f stays
/// between its samples.
struct SampledProfile {
  std::vector<double> t, f, slopes;  ///< samples [mm], and f' at each of them
  [[nodiscard]] double radius(double at) const noexcept;
  [[nodiscard]] double slope(double at) const noexcept;
  /// Around t; the turn is the mean over the height, because f'' jumps at each sample.
  [[nodiscard]] Surface surface(double at, double height) const noexcept;
};

/// Half-profile f(t) [mm] for t in [low, high] [mm] from the HIP. Outside, f = 0.
class Tool {
 public:
  using Profile = std::variant<EllipseProfile, RibProfile, SampledProfile>;

  /// Refuses sizes that are not finite and positive (at most 5000 mm), and samples out of order.
  static Result<Tool> build(const ToolShapeSpec& spec);

  [[nodiscard]] double low() const noexcept { return low_; }
  [[nodiscard]] double high() const noexcept { return high_; }
  [[nodiscard]] double widest() const noexcept { return widest_; }  ///< greatest f(t) [mm]
  [[nodiscard]] double radius(double t) const noexcept;             ///< f(t) [mm]
  [[nodiscard]] double slope(double t) const noexcept;              ///< f'(t)
  [[nodiscard]] const Profile& profile() const noexcept { return profile_; }

 private:
  Profile profile_;
  double low_ = 0.0;
  double high_ = 0.0;
  double widest_ = 0.0;
};

}  // namespace clay
