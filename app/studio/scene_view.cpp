#include "app/studio/scene_view.hpp"

#include "app/render/pot_view.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/free_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::studio {
namespace {

constexpr double kRoomForTool = 1.35;                 // around the pot, in the picture of it all
constexpr double kSizingPerPx = 0.006;                // of a drag: the logarithm of the size
constexpr double kWeakest = 1e-4, kStrongest = 10.0;  // N/mm^2

std::optional<Tool> chosen_tool(const AppState& shop) {
  auto tool = Tool::build(tool_of(shop.settings.tool).shape);
  if (!tool) return std::nullopt;
  return std::move(*tool);
}

double stiffness(const AppState& shop) {
  return shop.potter.has_work() && shop.potter.scene().force
             ? shop.potter.scene().force->stiffness_n_per_mm2
             : 0.0;
}

}  // namespace

render::Viewport SceneView::viewport() const noexcept {
  return {std::max(1, static_cast<int>(rect_.size_px.x)),
          std::max(1, static_cast<int>(rect_.size_px.y))};
}

void SceneView::look(const AppState& shop, Seen from) {
  constexpr double kRight = std::numbers::pi / 2.0;
  const render::PotView& pot = shop.potter.view();
  render::Camera camera = camera_;
  switch (from) {
    case Seen::home:
      wheel_radius_mm_ = 0.0;
      camera_ = render::framed(pot, viewport().aspect());
      camera_.distance_mm *= kRoomForTool;
      return;
    case Seen::front:
      camera.azimuth_rad = camera.elevation_rad = 0.0;
      break;
    case Seen::right:
      camera.azimuth_rad = kRight;
      camera.elevation_rad = 0.0;
      break;
    case Seen::top:
      camera.azimuth_rad = 0.0;
      camera.elevation_rad = render::kSteepest;
      break;
  }
  camera_ = render::framed(pot, viewport().aspect(), camera);
  camera_.distance_mm *= kRoomForTool;
}

/// The head does not change under a pot that grows and shrinks: it is as large as it ever had to
/// be, until a pot is looked at as a whole.
void SceneView::turn_wheel(const AppState& shop, double rad) {
  wheel_radius_mm_ = std::max(wheel_radius_mm_, render::wheel_radius_mm(shop.potter.view()));
  turn_rad_ = std::fmod(turn_rad_ + rad, 2.0 * std::numbers::pi);
}

glm::dvec3 SceneView::on_wheel(glm::dvec2 place_mm) const {
  return place_mm.x * render::profile_direction(camera_) + glm::dvec3(0.0, place_mm.y, 0.0);
}

std::optional<glm::dvec2> SceneView::pointed_mm() const {
  return render::profile_point(camera_, viewport(), glm::dvec2(pointer_px_ - rect_.corner_px));
}

std::optional<glm::vec2> SceneView::pixel_of(glm::dvec2 place_mm) const noexcept {
  const auto pixel = render::pixel_of(camera_, viewport(), on_wheel(place_mm));
  if (!pixel) return std::nullopt;
  return glm::vec2(*pixel) + rect_.corner_px;
}

bool SceneView::pointer_moved(AppState& shop, glm::vec2 place_px) {
  const glm::vec2 by = place_px - pointer_px_;
  pointer_px_ = place_px;
  if (drag_ == Drag::none) return rect_.holds(place_px);
  drag(shop, by);
  return true;
}

void SceneView::drag(AppState& shop, glm::vec2 by_px) {
  ToolChoice& tool = shop.settings.tool;
  switch (drag_) {
    case Drag::orbit:
      camera_ = render::orbited(camera_, glm::dvec2(by_px), viewport());
      break;
    case Drag::pan:
      camera_ = render::panned(camera_, glm::dvec2(by_px), viewport());
      break;
    case Drag::size:
      resize(tool, std::exp(kSizingPerPx * static_cast<double>(by_px.x)));
      break;
    case Drag::strength:
      shop.potter.set_stiffness(
          std::clamp(stiffness(shop) * std::exp(kSizingPerPx * static_cast<double>(by_px.x)),
                     kWeakest, kStrongest));
      break;
    case Drag::shape:
      if (const auto place = pointed_mm()) {
        glm::dvec2 aim = *place + offset_mm_;
        aim.y = std::max(0.0, aim.y);
        shop.potter.aim({on_wheel(aim), shop.potter.status().contact ? shop.settings.pressing_mm_s
                                                                     : kReachingMmPerS});
      }
      break;
    case Drag::none:
      break;
  }
}

bool SceneView::button(AppState& shop, const ButtonChanged& change) {
  if (!change.down) {
    const bool was = drag_ != Drag::none && !sizing();
    if (was && drag_ == Drag::shape) shop.potter.release();
    if (was) drag_ = Drag::none;
    return was;
  }
  if (sizing()) {  // a click takes the size as it is
    if (change.button == MouseButton::right) cancel(shop);
    drag_ = Drag::none;
    return true;
  }
  if (!rect_.holds(pointer_px_) || drag_ != Drag::none) return false;
  if (change.button == MouseButton::left)
    press(shop, (change.mods & kControl) != 0);
  else
    drag_ = (change.mods & kShift) != 0 ? Drag::pan : Drag::orbit;
  return true;
}

/// In the clay a press takes the tool to the nearest place beside it, and from there on the
/// tool goes as the mouse goes.
void SceneView::press(AppState& shop, bool inverted) {
  const auto pointed = pointed_mm();
  const auto tool = chosen_tool(shop);
  if (!pointed || !tool || !shop.potter.has_work() || shop.potter.has_device() ||
      shop.potter.paused())
    return;
  const ToolSpec spec = tool_of(shop.settings.tool, inverted);
  glm::dvec2 start = free_place(shop.potter.view(), *tool, *pointed);
  double gap_mm = 0.0;
  if (spec.mode == ToolMode::pinch) {
    const auto wall = wall_at(shop.potter.view(), *tool, pointed->y);
    if (!wall) {
      shop.notices.say(Grade::warning,
                       "There is no wall here to pinch: open the clay with a press from above "
                       "first, or point at the wall");
      return;
    }
    start = {pointed->x < 0.0 ? -wall->middle_mm : wall->middle_mm, pointed->y};
    gap_mm = wall->thickness_mm;
  }
  if (auto begun = shop.potter.press({spec, clay_rate_per_s(shop), on_wheel(start), gap_mm});
      !begun) {
    tell(shop, begun.error());
    return;
  }
  shop.log("stroke begun");
  offset_mm_ = start - *pointed;
  drag_ = Drag::shape;
}

bool SceneView::scrolled(float steps) {
  if (!rect_.holds(pointer_px_)) return false;
  zoom(static_cast<double>(steps));
  return true;
}

void SceneView::begin_sizing(AppState& shop) {
  if (drag_ != Drag::none) return;
  drag_ = Drag::size;
  saved_tool_ = shop.settings.tool;
}

void SceneView::begin_strength(AppState& shop) {
  if (drag_ != Drag::none || stiffness(shop) <= 0.0) return;
  drag_ = Drag::strength;
  before_ = stiffness(shop);
}

void SceneView::cancel(AppState& shop) {
  if (drag_ == Drag::size) shop.settings.tool = saved_tool_;
  if (drag_ == Drag::strength) shop.potter.set_stiffness(before_);
  if (sizing()) drag_ = Drag::none;
}

std::optional<render::ToolView> SceneView::tool_view(const AppState& shop) const {
  const auto tool = chosen_tool(shop);
  if (!tool || !shop.potter.has_work()) return std::nullopt;
  render::ToolView view;
  view.half_profile_mm = render::half_profile_of(*tool);
  const bool pinches = shop.settings.tool.mode == ToolMode::pinch;
  if (shop.potter.throwing()) {
    const servo::LiveStatus& status = shop.potter.status();
    if (status.ticks == 0) return std::nullopt;
    view.place_mm = status.tool_mm;
    view.contact = status.contact;
    view.force_n = status.clay_n;
    if (pinches) view.gap_mm = status.gap_mm > 0.0 ? status.gap_mm : shop.settings.tool.gap_mm;
    view.inside = inside(shop.potter.view(), status.tool_mm);
    return view;
  }
  if (shop.overlay != Overlay::none || drag_ == Drag::orbit || drag_ == Drag::pan ||
      !rect_.holds(pointer_px_))
    return std::nullopt;
  const auto pointed = pointed_mm();
  if (!pointed) return std::nullopt;
  glm::dvec2 place = free_place(shop.potter.view(), *tool, *pointed);
  if (pinches) {
    view.gap_mm = shop.settings.tool.gap_mm;
    if (const auto wall = wall_at(shop.potter.view(), *tool, pointed->y)) {
      place = {pointed->x < 0.0 ? -wall->middle_mm : wall->middle_mm, pointed->y};
      view.gap_mm = std::max(*view.gap_mm, wall->thickness_mm);
    }
  }
  view.place_mm = on_wheel(place);
  view.inside = inside(shop.potter.view(), view.place_mm);
  return view;
}

render::Picture SceneView::picture(const AppState& shop) const {
  render::Picture picture;
  picture.pot = shop.potter.view();
  picture.tool = tool_view(shop);
  if (const auto& check = shop.readings.check(); check && shop.settings.wall_map) {
    picture.pot.wall_mm = walls_for(*check, picture.pot.rows.size(), picture.pot.height_mm);
    picture.wall_map = wall_map_of(*check);
  }
  picture.camera = camera_;
  picture.theme = shop.settings.theme;
  picture.cut = cut;
  picture.wheel_turn_rad = turn_rad_;
  if (wheel_radius_mm_ > 0.0) picture.wheel_radius_mm = wheel_radius_mm_;
  return picture;
}

}  // namespace clay::studio
