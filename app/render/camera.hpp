#pragma once
// Where a picture is seen from. Heights along y, the axis of the wheel at x = z = 0, all in mm.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace clay::render {

/// Looks at `target_mm` from `distance_mm` away. Perspective.
struct Camera {
  double azimuth_rad = 0.0;    ///< of the eye about the y axis, from +z towards +x
  double elevation_rad = 0.0;  ///< of the eye above the target; within +-kSteepest
  double distance_mm = 400.0;
  glm::dvec3 target_mm{0.0};
  double fov_rad = 0.5;  ///< from the lower to the upper edge of the picture
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// 1 degree off the zenith: a camera that looks straight down has no upright.
inline constexpr double kSteepest = 1.553343034274953;

/// Size of a picture [px]. Pixel (0, 0) is the upper left one; its centre is (0.5, 0.5).
struct Viewport {
  int width_px = 1280, height_px = 720;
  [[nodiscard]] double aspect() const noexcept {
    return static_cast<double>(width_px) / static_cast<double>(height_px);
  }
  friend bool operator==(const Viewport&, const Viewport&) = default;
};

[[nodiscard]] glm::dvec3 eye_mm(const Camera& camera) noexcept;
/// From the wheel's coordinates to those of the eye, which looks along -z.
[[nodiscard]] glm::dmat4 view_matrix(const Camera& camera) noexcept;
/// OpenGL's clip space. Near and far planes go with the distance, and leave the precision of 24
/// bits of depth at 1e-5 of it.
[[nodiscard]] glm::dmat4 projection_matrix(const Camera& camera, double aspect) noexcept;

/// By drags of the mouse [px], the way the hand would turn or shift the pot.
[[nodiscard]] Camera orbited(Camera camera, glm::dvec2 drag_px, Viewport viewport) noexcept;
/// The point under the mouse stays under it, as far as it is as near as the target.
[[nodiscard]] Camera panned(Camera camera, glm::dvec2 drag_px, Viewport viewport) noexcept;
/// Notches of the mouse wheel: above 0 nearer. A notch is a ninth of the way.
[[nodiscard]] Camera zoomed(Camera camera, double notches) noexcept;

/// Where a point [mm] is in the picture [px]; nothing for points behind the eye.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const Camera& camera, Viewport viewport,
                                                 const glm::dvec3& point_mm) noexcept;

/// The half-plane of the profile that faces the camera: through the axis, across the line of
/// sight. A unit vector, to the right of the picture: rho along it, y up.
[[nodiscard]] glm::dvec3 profile_direction(const Camera& camera) noexcept;
/// Where the ray through a point of the picture [px] meets that plane: (rho, y) [mm], rho below 0
/// to the left of the axis. The exact inverse of `pixel_of`. Nothing where the ray misses it.
[[nodiscard]] std::optional<glm::dvec2> profile_point(const Camera& camera, Viewport viewport,
                                                      glm::dvec2 pixel) noexcept;

}  // namespace clay::render
