#pragma once
// The viewpoint of a picture. Heights along y, the axis of the wheel at x = z = 0, all in mm.

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace clay::render {

/// Looks at `target_mm` from `distance_mm` away. Perspective.
struct Camera {
  double azimuth_rad = 0.0;    ///< of the camera about the y axis, from +z towards +x
  double elevation_rad = 0.0;  ///< of the camera above the target; within +-kSteepest
  double distance_mm = 400.0;
  glm::dvec3 target_mm{0.0};
  double fov_rad = 0.5;  ///< vertical field of view, of the free part of the picture
  /// The fraction of the height of the picture, from its lower edge, that something else covers.
  /// The rest equals a picture of its size, and the covered part continues it.
  double covered = 0.0;
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// 1 degree off the zenith: the up direction is undefined there.
inline constexpr double kSteepest = 1.553343034274953;

/// Size of a picture [px]. Pixel (0, 0) is the upper left one; its centre is (0.5, 0.5).
struct Viewport {
  int width_px = 1280, height_px = 720;
  [[nodiscard]] double aspect() const noexcept {
    return static_cast<double>(width_px) / static_cast<double>(height_px);
  }
  friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// Some rows of a picture [px], counted from the bottom, as OpenGL does.
struct PixelRows {
  int first = 0, count = 0;
};

[[nodiscard]] glm::dvec3 eye_mm(const Camera& camera) noexcept;
/// From the wheel's coordinates to the camera's, which looks along -z.
[[nodiscard]] glm::dmat4 view_matrix(const Camera& camera) noexcept;
/// To OpenGL's clip space. The near and far planes scale with the distance; 24 bits of depth
/// resolve 1e-5 of it.
[[nodiscard]] glm::dmat4 projection_matrix(const Camera& camera, double aspect) noexcept;

/// Camera after a mouse drag [px] that rotates or moves the pot with the hand.
[[nodiscard]] Camera orbited(Camera camera, glm::dvec2 drag_px, Viewport viewport) noexcept;
/// Keeps the point under the mouse there, for points at the target's distance.
[[nodiscard]] Camera panned(Camera camera, glm::dvec2 drag_px, Viewport viewport) noexcept;
/// A cylinder on the wheel that contains the pot.
struct Extent {
  double radius_mm = 0.0, height_mm = 0.0;
  double foot_mm = 0.0;  ///< radius of the foot
};
/// Steps of the mouse wheel: positive zooms in, by a ninth of the distance each, until the camera
/// is at the pot; negative zooms out, as long as the pot is in sight.
[[nodiscard]] Camera zoomed(Camera camera, double notches, const Extent& pot) noexcept;

/// Position of a point [mm] in the picture [px]; empty for points behind the camera.
[[nodiscard]] std::optional<glm::dvec2> pixel_of(const Camera& camera, Viewport viewport,
                                                 const glm::dvec3& point_mm) noexcept;

/// The half-plane of the profile that faces the camera: through the axis, perpendicular to the line
/// of sight. A unit vector to the right of the picture: rho along it, y up.
[[nodiscard]] glm::dvec3 profile_direction(const Camera& camera) noexcept;
/// The intersection of the ray through a point of the picture [px] with that plane: (rho, y) [mm],
/// rho negative left of the axis. The exact inverse of `pixel_of`. Empty if the ray misses it.
[[nodiscard]] std::optional<glm::dvec2> profile_point(const Camera& camera, Viewport viewport,
                                                      glm::dvec2 pixel) noexcept;

}  // namespace clay::render
