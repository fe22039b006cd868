#include "app/render/scene_frame.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace clay::render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kThickness = 0.07;  // of the wheel head, in radii
constexpr double kStraightPx = 0.2;  // levels that chords miss by less are omitted
constexpr double kChordPx = 0.2;     // between a sector's chord and its arc

/// A rotation about y that maps the camera's right, up and horizontal backward directions to x, y,
/// z.
glm::vec3 beside_camera(const Camera& camera, const glm::dvec3& direction) {
  const double s = std::sin(camera.azimuth_rad), c = std::cos(camera.azimuth_rad);
  return {direction.x * c + direction.z * s, direction.y, direction.z * c - direction.x * s};
}

double opening_of(Cut cut) { return cut == Cut::half ? kPi : cut == Cut::quarter ? kPi / 2 : 0.0; }

std::vector<Body> bodies_of(const PotView& pot, double tolerance_mm) {
  const auto tolerance = static_cast<float>(tolerance_mm);
  const std::size_t split =
      pot.fallen ? std::min(pot.fallen->first_row, pot.rows.size()) : pot.rows.size();
  std::vector<Body> bodies;
  if (split > 0) bodies.push_back({levels_of(pot, 0, split, tolerance), glm::mat4(1.0f)});
  if (split < pot.rows.size())
    bodies.push_back(
        {levels_of(pot, split, pot.rows.size(), tolerance), glm::mat4(pot.fallen->place)});
  return bodies;
}

float size_of(const PotView& pot) {
  float radius = 0.0f;
  for (const Row& row : pot.rows) radius = std::max(radius, row.outer_mm);
  return std::max(radius, static_cast<float>(pot.height_mm));
}

}  // namespace

SceneFrame::SceneFrame(const Picture& shown, Viewport viewport)
    : picture(shown),
      look(look_of(shown.theme)),
      wheel_radius(shown.wheel_radius_mm.value_or(wheel_radius_mm(shown.pot))) {
  const Camera& camera = picture.camera;
  const double opening = opening_of(picture.cut);
  const double middle = picture.cut_azimuth_rad.value_or(camera.azimuth_rad);
  sweep = {middle + 0.5 * opening, middle + 2.0 * kPi - 0.5 * opening};
  px_per_mm = 0.5 * viewport.height_px / (std::tan(0.5 * camera.fov_rad) * camera.distance_mm);
  bodies = bodies_of(picture.pot, kStraightPx / px_per_mm);
  fill_block(viewport);
}

void SceneFrame::fill_block(Viewport viewport) {
  const Camera& camera = picture.camera;
  block.view_projection =
      glm::mat4(projection_matrix(camera, viewport.aspect()) * view_matrix(camera));
  block.eye = glm::vec4(glm::vec3(eye_mm(camera)), 1.0f);
  const auto turn = static_cast<float>(picture.wheel_turn_rad);
  block.to_lamp = glm::vec4(beside_camera(camera, lamp_direction()), std::cos(turn));
  block.to_rim_lamp = glm::vec4(beside_camera(camera, rim_lamp_direction()), std::sin(turn));
  const auto sides = [](const glm::vec4& axis, glm::vec4& across, glm::vec4& upward) {
    const glm::vec3 to(axis), side = glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), to));
    across = glm::vec4(side, 0.0f);
    upward = glm::vec4(glm::cross(to, side), 0.0f);
  };
  sides(block.to_lamp, block.lamp_across, block.lamp_upward);
  sides(block.to_rim_lamp, block.strip_across, block.strip_upward);
  block.lamp = glm::vec4(look.lamp, 0.0f);
  block.sky = glm::vec4(look.sky, 0.0f);
  block.bounce = glm::vec4(look.bounce, 0.0f);
  block.rim = glm::vec4(look.rim, 0.0f);
  block.low = glm::vec4(look.low, 0.0f);
  block.high = glm::vec4(look.high, 0.0f);
  block.viewport = {viewport.width_px, viewport.height_px, 1.0f, 0.0f};
  if (picture.wall_map && !picture.pot.wall_mm.empty())
    block.wall_map = {picture.wall_map->limit_mm, picture.wall_map->top_mm, 1.0f, 0.0f};
  block.wheel = {picture.wheel_turn_rad, wheel_radius, kThickness * wheel_radius,
                 size_of(picture.pot)};
}

int SceneFrame::sectors_for(double radius_mm) const {
  const double radius_px = std::max(1.0, radius_mm * px_per_mm);
  const double wanted = kPi / std::acos(1.0 - std::min(1.0, kChordPx / radius_px));
  return std::clamp(16 * static_cast<int>(std::ceil(wanted / 16.0)), 48, 320);
}

}  // namespace clay::render
