// The camera of the view: its place, and the pixel of a point.

#include "app/studio/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::studio {
namespace {

constexpr double kRoomForTool = 1.35;                 // size of the view relative to the whole pot
constexpr double kAboveMm = 40.0, kPulledPart = 0.5;  // room above the rim
constexpr double kLessonRad = 0.22, kGrowth = 2.4;    // a pot that is pulled grows to that

/// A pinch pulls the wall up.
double room_above_mm(const render::PotView& pot, ToolMode mode) {
  return std::max(kAboveMm, mode == ToolMode::pinch ? kPulledPart * pot.height_mm : 0.0);
}

}  // namespace

render::Viewport SceneView::viewport() const noexcept {
  return {std::max(1, static_cast<int>(rect_.size_px.x)),
          std::max(1, static_cast<int>(rect_.size_px.y))};
}

void SceneView::place(const ViewRect& rect, float covered_px) {
  const auto before = drag_ == Drag::shape ? pointed_mm() : std::nullopt;
  rect_ = rect;
  camera_.covered = covered_px / rect.size_px.y;
  const auto now = before ? pointed_mm() : std::nullopt;
  if (now) offset_mm_ += *before - *now;
}

float SceneView::free_height_px() const noexcept {
  return static_cast<float>(1.0 - camera_.covered) * rect_.size_px.y;
}

void SceneView::look(const render::PotView& pot, ViewFrom from) {
  constexpr double kRight = std::numbers::pi / 2.0;
  render::Camera camera = camera_;
  switch (from) {
    case ViewFrom::home:
      wheel_radius_mm_ = 0.0;
      camera_ = render::framed(pot, viewport().aspect(), camera.covered);
      camera_.distance_mm *= kRoomForTool;
      return;
    case ViewFrom::lesson: {
      camera.azimuth_rad = 0.0;
      camera.elevation_rad = kLessonRad;
      render::PotView grown = pot;
      grown.height_mm *= kGrowth;
      camera_ = render::framed(grown, viewport().aspect(), camera);
      return;
    }
    case ViewFrom::front:
      camera.azimuth_rad = camera.elevation_rad = 0.0;
      break;
    case ViewFrom::right:
      camera.azimuth_rad = kRight;
      camera.elevation_rad = 0.0;
      break;
    case ViewFrom::top:
      camera.azimuth_rad = 0.0;
      camera.elevation_rad = render::kSteepest;
      break;
  }
  camera_ = render::framed(pot, viewport().aspect(), camera);
  camera_.distance_mm *= kRoomForTool;
}

bool SceneView::shows(const render::Extent& pot, double above_mm) const noexcept {
  const auto rim = pixel_of({0.0, pot.height_mm + above_mm});
  // The edge of the foot that is nearest to the camera, in the view alone.
  const glm::dvec3 toward =
      glm::cross(render::profile_direction(camera_), glm::dvec3(0.0, 1.0, 0.0));
  const auto foot = render::pixel_of(camera_, viewport(), pot.foot_mm * toward);
  // Parts of the pot that are nearer than the section plane look wider.
  const double side_mm = 1.1 * pot.radius_mm;
  const auto left = pixel_of({-side_mm, 0.5 * pot.height_mm});
  const auto right = pixel_of({side_mm, 0.5 * pot.height_mm});
  return rim && foot && left && right && rim->y >= rect_.corner_px.y &&
         foot->y <= static_cast<double>(free_height_px()) && left->x >= rect_.corner_px.x &&
         right->x <= rect_.corner_px.x + rect_.size_px.x;
}

void SceneView::back_off(const render::Extent& pot, double above_mm) {
  constexpr double kBack = 1.03;
  constexpr int kMostSteps = 60;
  if (shows(pot, above_mm)) return;
  camera_.target_mm.y = std::max(camera_.target_mm.y, 0.5 * (pot.height_mm + above_mm));
  for (int step = 0; step < kMostSteps && !shows(pot, above_mm); ++step)
    camera_.distance_mm *= kBack;
}

void SceneView::make_room(const render::PotView& pot, ToolMode mode) {
  back_off(render::extent_of(pot), room_above_mm(pot, mode));
}

void SceneView::follow(const render::PotView& pot, const render::Extent& before, ToolMode mode) {
  if (!shows(before, 0.0)) return;
  back_off(render::extent_of(pot), shows(before, kAboveMm) ? room_above_mm(pot, mode) : 0.0);
}

/// The wheel head only grows, so that it does not change with every stroke; showing the whole pot
/// fits it again.
void SceneView::turn_wheel(const render::PotView& pot, double rad) {
  wheel_radius_mm_ = std::max(wheel_radius_mm_, render::wheel_radius_mm(pot));
  extent_ = render::extent_of(pot);
  turn_rad_ = std::fmod(turn_rad_ + rad, 2.0 * std::numbers::pi);
}

glm::dvec3 SceneView::on_wheel(glm::dvec2 place_mm) const {
  return place_mm.x * render::profile_direction(camera_) + glm::dvec3(0.0, place_mm.y, 0.0);
}

glm::dvec3 SceneView::in_stroke(glm::dvec2 place_mm) const {
  return place_mm.x * outward_ + glm::dvec3(0.0, place_mm.y, 0.0);
}

glm::dvec2 SceneView::in_section(const glm::dvec3& place_mm) const noexcept {
  return {glm::dot(place_mm, render::profile_direction(camera_)), place_mm.y};
}

void SceneView::turn(glm::dvec2 by_rad) {
  const double px_per_rad = viewport().height_px / std::numbers::pi;
  camera_ = render::orbited(camera_, px_per_rad * by_rad, viewport());
}

std::optional<glm::vec2> SceneView::pixel_of(glm::dvec2 place_mm) const noexcept {
  const auto pixel = render::pixel_of(camera_, viewport(), on_wheel(place_mm));
  if (!pixel) return std::nullopt;
  return glm::vec2(*pixel) + rect_.corner_px;
}

float SceneView::px_per_mm() const noexcept {
  const auto foot = pixel_of({0.0, 0.0}), above = pixel_of({10.0, 0.0});
  return foot && above ? 0.1f * glm::distance(*foot, *above) : 1.0f;
}

}  // namespace clay::studio
