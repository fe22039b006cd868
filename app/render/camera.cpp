#include "app/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace clay::render {
namespace {

constexpr double kNearest = 0.02, kFarthest = 60.0;  // clip planes, per distance
// Of the zoom: from the clay, from the target, and the longest as a multiple of the pot.
constexpr double kClearMm = 5.0, kShortestMm = 10.0, kLongest = 20.0, kSmallestPotMm = 50.0;
constexpr double kNotch = 8.0 / 9.0;
constexpr double kGrazing = 1e-9;  // of a ray to the plane that it should intersect

/// The camera's axes; `back` points from the target to the camera.
struct Axes {
  glm::dvec3 right, up, back;
};

Axes axes_of(const Camera& camera) noexcept {
  const double lift = std::clamp(camera.elevation_rad, -kSteepest, kSteepest);
  const double sa = std::sin(camera.azimuth_rad), ca = std::cos(camera.azimuth_rad);
  const double se = std::sin(lift), ce = std::cos(lift);
  return {{ca, 0.0, -sa}, {-sa * se, ce, -ca * se}, {sa * ce, se, ca * ce}};
}

/// Of the part that is not covered.
double free_height_px(const Camera& camera, Viewport viewport) noexcept {
  return (1.0 - camera.covered) * viewport.height_px;
}

/// At the target's distance.
double mm_per_px(const Camera& camera, Viewport viewport) noexcept {
  return 2.0 * camera.distance_mm * std::tan(0.5 * camera.fov_rad) /
         free_height_px(camera, viewport);
}

/// The distance from the target beyond which a camera that moves back is outside the pot [mm].
double way_out_mm(const Camera& camera, const Extent& pot) noexcept {
  const glm::dvec3 from = camera.target_mm, back = axes_of(camera).back;
  const double radius = pot.radius_mm + kClearMm, top = pot.height_mm + kClearMm;
  const double a = back.x * back.x + back.z * back.z;  // above 0, as kSteepest is off the zenith
  const double b = from.x * back.x + from.z * back.z;
  const double c = from.x * from.x + from.z * from.z - radius * radius;
  const double root = b * b - a * c;
  if (root <= 0.0) return kShortestMm;  // past the pot
  double in = (-b - std::sqrt(root)) / a, out = (-b + std::sqrt(root)) / a;
  const double to_top = top - from.y, to_foot = -kClearMm - from.y;
  if (back.y != 0.0) {
    in = std::max(in, std::min(to_top / back.y, to_foot / back.y));
    out = std::min(out, std::max(to_top / back.y, to_foot / back.y));
  } else if (to_top < 0.0 || to_foot > 0.0) {
    return kShortestMm;
  }
  return in < out ? std::max(out, kShortestMm) : kShortestMm;
}

}  // namespace

glm::dvec3 eye_mm(const Camera& camera) noexcept {
  return camera.target_mm + camera.distance_mm * axes_of(camera).back;
}

glm::dmat4 view_matrix(const Camera& camera) noexcept {
  const Axes axes = axes_of(camera);
  const glm::dvec3 eye = eye_mm(camera);
  glm::dmat4 view(1.0);
  for (int i = 0; i < 3; ++i) {
    view[i][0] = axes.right[i];
    view[i][1] = axes.up[i];
    view[i][2] = axes.back[i];
  }
  view[3] = {-glm::dot(axes.right, eye), -glm::dot(axes.up, eye), -glm::dot(axes.back, eye), 1.0};
  return view;
}

glm::dmat4 projection_matrix(const Camera& camera, double aspect) noexcept {
  const double free = 1.0 - camera.covered;
  glm::dmat4 projection = glm::perspective(
      camera.fov_rad, aspect / free, kNearest * camera.distance_mm, kFarthest * camera.distance_mm);
  for (int i = 0; i < 4; ++i)
    projection[i][1] = free * projection[i][1] + camera.covered * projection[i][3];
  return projection;
}

Camera orbited(Camera camera, glm::dvec2 drag_px, Viewport viewport) noexcept {
  const double rad_per_px = std::numbers::pi / viewport.height_px;
  camera.azimuth_rad =
      std::remainder(camera.azimuth_rad - rad_per_px * drag_px.x, 2.0 * std::numbers::pi);
  camera.elevation_rad =
      std::clamp(camera.elevation_rad + rad_per_px * drag_px.y, -kSteepest, kSteepest);
  return camera;
}

Camera panned(Camera camera, glm::dvec2 drag_px, Viewport viewport) noexcept {
  const Axes axes = axes_of(camera);
  const double scale = mm_per_px(camera, viewport);
  camera.target_mm += scale * (drag_px.y * axes.up - drag_px.x * axes.right);
  return camera;
}

Camera zoomed(Camera camera, double notches, const Extent& pot) noexcept {
  const double wanted = camera.distance_mm * std::pow(kNotch, notches);
  const double size = std::max({2.0 * pot.radius_mm, pot.height_mm, kSmallestPotMm});
  // A camera beyond a limit, because the pot has changed, does not jump to it.
  if (notches < 0.0)
    camera.distance_mm = std::min(wanted, std::max(camera.distance_mm, kLongest * size));
  else
    camera.distance_mm = std::max(wanted, std::min(camera.distance_mm, way_out_mm(camera, pot)));
  return camera;
}

std::optional<glm::dvec2> pixel_of(const Camera& camera, Viewport viewport,
                                   const glm::dvec3& point_mm) noexcept {
  const Axes axes = axes_of(camera);
  const glm::dvec3 way = point_mm - eye_mm(camera);
  const double depth = -glm::dot(way, axes.back);
  if (!(depth > 0.0)) return std::nullopt;
  const double half_px = 0.5 * free_height_px(camera, viewport);
  const double px = half_px / (std::tan(0.5 * camera.fov_rad) * depth);
  return glm::dvec2{0.5 * viewport.width_px + px * glm::dot(way, axes.right),
                    half_px - px * glm::dot(way, axes.up)};
}

glm::dvec3 profile_direction(const Camera& camera) noexcept { return axes_of(camera).right; }

std::optional<glm::dvec2> profile_point(const Camera& camera, Viewport viewport,
                                        glm::dvec2 pixel) noexcept {
  const Axes axes = axes_of(camera);
  const glm::dvec3 eye = eye_mm(camera);
  const double half_px = 0.5 * free_height_px(camera, viewport);
  const double per_px = std::tan(0.5 * camera.fov_rad) / half_px;
  const glm::dvec3 ray = (pixel.x - 0.5 * viewport.width_px) * per_px * axes.right +
                         (half_px - pixel.y) * per_px * axes.up - axes.back;
  const glm::dvec3 normal = glm::normalize(glm::dvec3{axes.back.x, 0.0, axes.back.z});
  const double closing = glm::dot(ray, normal);
  if (std::abs(closing) < kGrazing * glm::length(ray)) return std::nullopt;
  const double along = -glm::dot(eye, normal) / closing;
  if (!(along > 0.0)) return std::nullopt;
  const glm::dvec3 hit = eye + along * ray;
  return glm::dvec2{glm::dot(hit, axes.right), hit.y};
}

}  // namespace clay::render
