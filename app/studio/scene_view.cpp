#include "app/studio/scene_view.hpp"

#include "app/render/pot_view.hpp"
#include "app/studio/free_place.hpp"
#include "app/studio/view_model.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace clay::studio {
namespace {

constexpr double kSizingPerPx = 0.006;  // drag: change of the logarithm of the size per pixel

std::optional<Tool> built(const ToolSpec& spec) {
  auto tool = Tool::build(spec.shape);
  if (!tool) return std::nullopt;
  return std::move(*tool);
}

/// The pot as it stands.
render::PotView shown_pot(const ViewModel& view) {
  const render::PotView& pot = view.stroke.view();
  return view.upside_down() ? render::turned(pot) : pot;
}

/// The start of a press near this place.
glm::dvec2 free_in(const ViewModel& view, const Tool& tool, glm::dvec2 place_mm) {
  return free_place(shown_pot(view), tool, place_mm,
                    view.upside_down() ? Bore::covered : Bore::open);
}

ToolSpec pinching(ToolChoice choice) {
  choice.mode = ToolMode::pinch;
  return tool_of(choice);
}

/// The middle of a wall, on the side of the pointer.
glm::dvec2 pinch_place(const WallPlace& wall, glm::dvec2 pointed_mm) {
  return {pointed_mm.x < 0.0 ? -wall.middle_mm : wall.middle_mm, wall.y_mm};
}

}  // namespace

std::optional<glm::dvec2> SceneView::pointed_mm() const {
  if (led_mm_) return led_mm_;
  return render::profile_point(camera_, viewport(), glm::dvec2(mouse_px_ - rect_.corner_px));
}

glm::vec2 SceneView::pointer_px() const noexcept {
  return led_mm_ ? pixel_of(*led_mm_).value_or(mouse_px_) : mouse_px_;
}

glm::dvec2 SceneView::free_at(const ViewModel& view, glm::dvec2 place_mm) const {
  const auto tool = built(view.tool_in_use());
  return tool ? free_in(view, *tool, place_mm) : place_mm;
}

bool SceneView::pointer_moved(const ViewModel& view, const PointerMoved& moved, Actions& actions) {
  const glm::vec2 by = moved.place_px - mouse_px_;
  mouse_px_ = moved.place_px;
  pen_ = moved.strength;
  led_mm_.reset();
  if (drag_ == Drag::none) return rect_.holds(mouse_px_);
  drag(view, by, actions);
  return true;
}

void SceneView::drag(const ViewModel& view, glm::vec2 by_px, Actions& actions) {
  const double factor = std::exp(kSizingPerPx * static_cast<double>(by_px.x));
  switch (drag_) {
    case Drag::orbit:
      camera_ = render::orbited(camera_, glm::dvec2(by_px), viewport());
      break;
    case Drag::pan:
      camera_ = render::panned(camera_, glm::dvec2(by_px), viewport());
      break;
    case Drag::size:
      actions.emplace_back(ScaleTool{factor});
      break;
    case Drag::stiffness:
      actions.emplace_back(SetStiffness{
          std::clamp(view.document.stiffness() * factor, kSoftestClay, kStiffestClay)});
      break;
    case Drag::shape:
      if (const auto place = pointed_mm()) shape_to(view, *place, {.strength = pen_}, actions);
      break;
    case Drag::approach:
      if (!view.document.scrubbing())
        drag_ = Drag::none;  // by Esc
      else if (const auto place = pointed_mm())
        approach(view, *place, actions);
      break;
    case Drag::none:
      break;
  }
}

bool SceneView::button(const ViewModel& view, const ButtonChanged& change, Actions& actions) {
  if (!change.down) {
    const bool by_left = drag_ == Drag::shape || drag_ == Drag::approach;
    const bool own = (change.button == MouseButton::left) == by_left;
    const bool was = drag_ != Drag::none && !setting() && own;
    if (was && drag_ == Drag::shape) actions.emplace_back(ReleaseTool{});
    if (was) drag_ = Drag::none;
    return was;
  }
  if (setting()) {  // a click accepts the value
    if (change.button == MouseButton::right) cancel(actions);
    drag_ = Drag::none;
    return true;
  }
  if (!rect_.holds(mouse_px_) || drag_ != Drag::none) return false;
  if (change.button == MouseButton::left)
    press(view, (change.mods & kControl) != 0, actions);
  else if (!view.view_is_held())
    drag_ = (change.mods & kShift) != 0 ? Drag::pan : Drag::orbit;
  return true;
}

void SceneView::press(const ViewModel& view, bool inverted, Actions& actions) {
  led_mm_.reset();
  inverted_ = inverted;
  const auto pointed = pointed_mm();
  if (!pointed) return;
  drag_ = Drag::approach;
  air_mm_ = *pointed;
  approach(view, *pointed, actions);
}

/// A stroke on a moment of another one makes a branch. There, a press in the air waits until the
/// pointer reaches the clay, so that a click makes no branch; a pinch finds its wall from the air.
void SceneView::approach(const ViewModel& view, glm::dvec2 pointed_mm, Actions& actions) {
  const bool waits = view.document.scrubbing() && !view.stroke.has_device() &&
                     view.settings.tool.mode != ToolMode::pinch;
  const glm::dvec2 above_wheel(pointed_mm.x, std::max(0.0, pointed_mm.y));
  if (waits && free_at(view, pointed_mm) == above_wheel) {
    air_mm_ = pointed_mm;
    return;
  }
  drag_ = Drag::none;
  const Grip grip{.strength = pen_, .inverted = inverted_};
  shape_from(view, air_mm_, grip, actions);
  const bool begun = std::ranges::any_of(
      actions, [](const Action& action) { return std::holds_alternative<PressClay>(action); });
  if (!begun) return;
  drag_ = Drag::shape;
  if (air_mm_ != pointed_mm) shape_to(view, pointed_mm, grip, actions);
}

/// A press on the clay moves the tool to the nearest free place; from there the tool follows the
/// mouse.
void SceneView::shape_from(const ViewModel& view, glm::dvec2 pointed_mm, const Grip& grip,
                           Actions& actions) {
  const auto tool = built(tool_of(view.settings.tool));
  if (!tool || !view.document.has_work() || view.stroke.has_device() || view.stroke.paused())
    return;
  ToolSpec spec =
      grip.pinch ? pinching(view.settings.tool) : tool_of(view.settings.tool, grip.inverted);
  glm::dvec2 start = pointed_mm;
  pinched_.reset();
  if (spec.mode != ToolMode::pinch)
    start = free_in(view, *tool, pointed_mm);
  else if (!pinch_from(view, *tool, start, spec, actions))
    return;
  offset_mm_ = start - pointed_mm;
  outward_ = render::profile_direction(camera_);
  actions.emplace_back(PressClay{
      {spec, view.settings.wheel_rpm, on_wheel(start), pinched_ ? pinched_->wall_mm : 0.0}});
  strength_ = grip.strength;
  if (strength_) shape_to(view, pointed_mm, grip, actions);
}

/// Finds the wall, and completes place and tool.
bool SceneView::pinch_from(const ViewModel& view, const Tool& tool, glm::dvec2& place_mm,
                           ToolSpec& spec, Actions& actions) {
  const auto wall = wall_above(shown_pot(view), tool, place_mm.y);
  if (!wall) {
    actions.emplace_back(
        ShowWarning{"There is no wall here to pinch: open the clay with a press from above first, "
                    "or point at the wall"});
    return false;
  }
  place_mm = pinch_place(*wall, place_mm);
  if (const double share = view.settings.tool.gap_share; share > 0.0)
    spec.gap_mm = std::max(kNarrowestGapMm, share * (wall->thickness_mm - 2.0 * kClearanceMm));
  pinched_ = {wall->thickness_mm, std::min(wall->thickness_mm, spec.gap_mm.value_or(0.0))};
  return true;
}

namespace {

/// Two fingers follow the wall that they hold, go no lower than the floor, and continue over the
/// rim. A pointer beside the wall pulls them sideways.
glm::dvec2 along_wall(const ViewModel& view, glm::dvec2 aim_mm) {
  constexpr double kLean = 0.35, kMostLeanMm = 4.0, kRimMm = 1.0;
  const auto tool = built(view.tool_in_use());
  const render::PotView& pot = view.stroke.view();
  if (!tool) return aim_mm;
  const double floor_mm = render::floor_of(pot).value_or(render::Floor{}).top_mm;
  aim_mm.y = std::max(aim_mm.y, floor_mm - tool->low());
  const auto wall = wall_at(pot, *tool, std::min(aim_mm.y, pot.height_mm - kRimMm));
  if (!wall) return aim_mm;
  // The foot does not move: a wall that is led outward beyond the foot tears off there.
  const double over_foot_mm = std::max(0.0, aim_mm.y - 2.0 * tool->high());
  const double most_mm = static_cast<double>(pot.rows.front().outer_mm) - 0.5 * wall->thickness_mm -
                         kFootSpareMm + over_foot_mm - wall->middle_mm;
  const double lean = kLean * (std::abs(aim_mm.x) - wall->middle_mm);
  const double rho =
      wall->middle_mm + std::clamp(lean, -kMostLeanMm, std::clamp(most_mm, 0.0, kMostLeanMm));
  return {aim_mm.x < 0.0 ? -rho : rho, aim_mm.y};
}

}  // namespace

glm::dvec2 SceneView::target_mm(glm::dvec2 pointed_mm) const noexcept {
  const glm::dvec2 target = pointed_mm + offset_mm_;
  return {target.x, std::max(0.0, target.y)};
}

void SceneView::shape_to(const ViewModel& view, glm::dvec2 pointed_mm, const Grip& grip,
                         Actions& actions) {
  strength_ = grip.strength;
  glm::dvec2 aim = target_mm(pointed_mm);
  if (pinched_) aim = along_wall(view, aim);
  const bool resisted = view.stroke.status().contact && !cuts_level(view.tool_in_use().mode);
  const double speed_mm_s = resisted ? view.settings.pressing_mm_s : kReachingMmPerS;
  const double bite_mm = strength_ ? bite_at(*strength_) : view.settings.bite_mm;
  std::optional<double> gap_mm;
  if (pinched_ && strength_) gap_mm = glm::mix(pinched_->wall_mm, pinched_->gap_mm, *strength_);
  actions.emplace_back(AimTool{{in_stroke(aim), speed_mm_s, bite_mm}, gap_mm});
}

bool SceneView::scrolled(const ViewModel& view, float steps) {
  if (!rect_.holds(mouse_px_)) return false;
  if (!view.view_is_held()) zoom(static_cast<double>(steps));
  return true;
}

void SceneView::drag_size(const ViewModel& view) {
  if (drag_ != Drag::none) return;
  drag_ = Drag::size;
  tool_before_ = view.settings.tool;
}

void SceneView::drag_stiffness(const ViewModel& view) {
  if (drag_ != Drag::none || view.document.stiffness() <= 0.0) return;
  drag_ = Drag::stiffness;
  stiffness_before_ = view.document.stiffness();
}

void SceneView::cancel(Actions& actions) {
  if (drag_ == Drag::size) actions.emplace_back(SetTool{tool_before_});
  if (drag_ == Drag::stiffness) actions.emplace_back(SetStiffness{stiffness_before_});
  if (setting()) drag_ = Drag::none;
}

std::optional<render::ToolView> SceneView::tool_view(const ViewModel& view) const {
  const ToolSpec spec = view.tool_in_use();
  const auto tool = built(spec);
  if (!tool || !view.document.has_work()) return std::nullopt;
  if (!view.stroke.throwing()) return hovering_tool(view, *tool);
  const servo::LiveStatus& status = view.stroke.status();
  if (status.ticks == 0) return std::nullopt;
  render::ToolView shown;
  shown.half_profile_mm = render::half_profile_of(*tool);
  shown.place_mm = status.tool_mm;
  shown.contact = status.contact;
  shown.force_n = status.clay_n;
  if (spec.mode == ToolMode::pinch)
    shown.gap_mm = status.gap_mm > 0.0 ? status.gap_mm : spec.gap_mm;
  shown.inside = inside(shown_pot(view), status.tool_mm);
  return shown;
}

std::optional<render::ToolView> SceneView::hovering_tool(const ViewModel& view,
                                                         const Tool& tool) const {
  if (!view.ui.shows<NoDialog>() || turning() || !rect_.holds(pointer_px())) return std::nullopt;
  if (over_panel_ && !led_mm_) return std::nullopt;  // a press would be for the panel
  const auto pointed = pointed_mm();
  if (!pointed) return std::nullopt;
  const render::PotView pot = shown_pot(view);
  render::ToolView shown;
  shown.half_profile_mm = render::half_profile_of(tool);
  glm::dvec2 place = free_in(view, tool, *pointed);
  if (view.settings.tool.mode == ToolMode::pinch) {
    shown.gap_mm = view.settings.tool.gap_mm;
    if (const auto wall = wall_above(pot, tool, pointed->y)) {
      place = pinch_place(*wall, *pointed);
      shown.gap_mm = std::max(*shown.gap_mm, wall->thickness_mm);
    }
  }
  // A hand may go lower, but the tool is shown on the wheel head. Needle and wire are shown at the
  // level of their cut.
  if (!cuts_level(view.settings.tool.mode)) place.y = std::max(place.y, -tool.low());
  shown.place_mm = on_wheel(place);
  shown.inside = inside(pot, shown.place_mm);
  return shown;
}

render::Picture SceneView::picture(const ViewModel& view) const {
  render::Picture picture;
  picture.pot = view.stroke.view();
  picture.tool = tool_view(view);
  if (const auto& check = view.readings.check(); check && view.settings.wall_map) {
    picture.pot.wall_mm = walls_for(*check, picture.pot.rows.size(), picture.pot.height_mm);
    picture.wall_map = wall_map_of(*check);
  }
  if (view.upside_down()) picture.pot = render::turned(std::move(picture.pot));
  picture.camera = camera_;
  picture.theme = view.settings.theme;
  picture.material = view.settings.material;
  // The map shows the walls as they are.
  picture.style = view.settings.throwing_lines && !picture.wall_map ? render::Style::clay
                                                                    : render::Style::geometry;
  picture.cut = cut;
  picture.wheel_turn_rad = turn_rad_;
  if (wheel_radius_mm_ > 0.0) picture.wheel_radius_mm = wheel_radius_mm_;
  return picture;
}

}  // namespace clay::studio
