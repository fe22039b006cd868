#pragma once
// The pot in the window: camera, mouse and picture. Mouse actions on the clay and on the settings
// become Actions.

#include "app/render/painter.hpp"
#include "app/studio/action.hpp"
#include "app/studio/input.hpp"
#include "app/studio/tool_choice.hpp"

#include <optional>

namespace clay::studio {

struct ViewModel;

/// Relative to the upper left corner of the framebuffer [px].
struct ViewRect {
  glm::vec2 corner_px{0.0f}, size_px{1.0f};
  [[nodiscard]] bool holds(glm::vec2 place_px) const noexcept {
    const glm::vec2 p = place_px - corner_px;
    return p.x >= 0.0f && p.y >= 0.0f && p.x < size_px.x && p.y < size_px.y;
  }
};

/// Grip of the hand on the tool.
struct Grip {
  /// Of the press, 0 (soft) to 1 (firm): the bite, and in a pinch the part of the way that the
  /// fingers have closed. None: as in the settings.
  std::optional<double> strength = std::nullopt;
  bool inverted = false;  ///< trims instead of pressing, and the other way round
  bool pinch = false;     ///< pinches in any mode
};

class SceneView {
 public:
  // --- Mouse. A bool result: the view used the event. --------------------------------------------
  bool pointer_moved(const ViewModel& view, const PointerMoved& moved, Actions& actions);
  bool button(const ViewModel& view, const ButtonChanged& change, Actions& actions);
  bool scrolled(const ViewModel& view, float steps);
  /// The mouse sets the size of the tool, or the stiffness, until a click or Esc.
  void drag_size(const ViewModel& view);
  void drag_stiffness(const ViewModel& view);
  [[nodiscard]] bool setting() const noexcept {
    return drag_ == Drag::size || drag_ == Drag::stiffness;
  }
  /// Ends `setting` and restores the previous value.
  void cancel(Actions& actions);
  /// Call if the stroke could not begin.
  void stop_shaping() noexcept { drag_ = Drag::none; }
  /// A stroke from a point (rho, y) [mm] of the section plane, and on to others.
  void shape_from(const ViewModel& view, glm::dvec2 pointed_mm, const Grip& grip, Actions& actions);
  void shape_to(const ViewModel& view, glm::dvec2 pointed_mm, const Grip& grip, Actions& actions);
  /// Target of the tool in such a stroke, for a place of the pointer [mm].
  [[nodiscard]] glm::dvec2 target_mm(glm::dvec2 pointed_mm) const noexcept;
  /// Strength of the press in progress; none: as in the settings.
  [[nodiscard]] const std::optional<double>& strength() const noexcept { return strength_; }

  // --- The pointer. ------------------------------------------------------------------------------
  /// The point (rho, y) [mm] of the section plane under it; empty: it points past the plane.
  [[nodiscard]] std::optional<glm::dvec2> pointed_mm() const;
  [[nodiscard]] glm::vec2 pointer_px() const noexcept;
  /// Whether a panel that lies over the view is under the mouse. Call once a frame.
  void set_over_panel(bool over) noexcept { over_panel_ = over; }
  /// Another device than the mouse sets the pointer until the mouse moves.
  void lead(glm::dvec2 place_mm) noexcept { led_mm_ = place_mm; }
  /// The nearest point of the section plane at which the tool does not touch the clay.
  [[nodiscard]] glm::dvec2 free_at(const ViewModel& view, glm::dvec2 place_mm) const;
  [[nodiscard]] bool turning() const noexcept { return drag_ == Drag::orbit || drag_ == Drag::pan; }

  // --- Camera. -----------------------------------------------------------------------------------
  void look(const render::PotView& pot, ViewFrom from);
  /// Moves back until the whole pot and the room above its rim are in sight: 40 mm, and for a
  /// pinch, which pulls the wall up, at least half of the pot's height. Not during a stroke,
  /// because the pointer would lead the tool elsewhere.
  void make_room(const render::PotView& pot, ToolMode mode);
  /// After a change of the pot, keeps it in sight as far as it was before: the whole pot, and the
  /// room above it. A part of the pot that the user has moved close to stays in the view.
  void follow(const render::PotView& pot, const render::Extent& before, ToolMode mode);
  void zoom(double notches) { camera_ = render::zoomed(camera_, notches, extent_); }
  /// To the right and up.
  void turn(glm::dvec2 by_rad);
  /// `covered_px`: the height at the foot of the view over which the timeline lies. If the view
  /// changes in a stroke, the pointer means another place, but the tool stays where it is.
  void place(const ViewRect& rect, float covered_px = 0.0f);
  [[nodiscard]] const ViewRect& rect() const noexcept { return rect_; }
  [[nodiscard]] const render::Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] render::Viewport viewport() const noexcept;
  /// Pixel of the window for a point (rho, y) [mm] of the section plane.
  [[nodiscard]] std::optional<glm::vec2> pixel_of(glm::dvec2 place_mm) const noexcept;
  /// Pixels per mm at the axis, across the view.
  [[nodiscard]] float px_per_mm() const noexcept;
  /// A place on the wheel, turned into the section plane.
  [[nodiscard]] glm::dvec2 in_section(const glm::dvec3& place_mm) const noexcept;
  /// Call once a frame.
  void turn_wheel(const render::PotView& pot, double rad);

  // --- Picture. ----------------------------------------------------------------------------------
  [[nodiscard]] render::Picture picture(const ViewModel& view) const;
  /// Place of the tool in the clay, or where a press would begin; empty if neither is shown.
  [[nodiscard]] std::optional<render::ToolView> tool_view(const ViewModel& view) const;

  render::Cut cut = render::Cut::none;

 private:
  enum class Drag { none, approach, shape, orbit, pan, size, stiffness };
  /// The wall where a pinch began, and the gap that it closes to.
  struct PinchedWall {
    double wall_mm = 0.0, gap_mm = 0.0;
  };
  void press(const ViewModel& view, bool inverted, Actions& actions);
  void approach(const ViewModel& view, glm::dvec2 pointed_mm, Actions& actions);
  [[nodiscard]] bool pinch_from(const ViewModel& view, const Tool& tool, glm::dvec2& place_mm,
                                ToolSpec& spec, Actions& actions);
  void drag(const ViewModel& view, glm::vec2 by_px, Actions& actions);
  [[nodiscard]] float free_height_px() const noexcept;
  [[nodiscard]] bool shows(const render::Extent& pot, double above_mm) const noexcept;
  void back_off(const render::Extent& pot, double above_mm);
  [[nodiscard]] std::optional<render::ToolView> hovering_tool(const ViewModel& view,
                                                              const Tool& tool) const;
  [[nodiscard]] glm::dvec3 on_wheel(glm::dvec2 place_mm) const;
  [[nodiscard]] glm::dvec3 in_stroke(glm::dvec2 place_mm) const;

  ViewRect rect_;
  render::Camera camera_;
  Drag drag_ = Drag::none;
  glm::vec2 mouse_px_{-1.0f};
  bool over_panel_ = false;
  std::optional<double> pen_;         // strength of the pen; none: a mouse
  std::optional<glm::dvec2> led_mm_;  // the place of another pointer
  // Of the press in progress: its strength, the offset from the pointer to the tool,
  std::optional<double> strength_;
  glm::dvec2 offset_mm_{0.0};
  glm::dvec3 outward_{1.0, 0.0, 0.0};  // and its plane: a turn of the view does not turn the tool
  std::optional<PinchedWall> pinched_;
  bool inverted_ = false;          // of the press that approaches the clay
  glm::dvec2 air_mm_{0.0};         // last place of that press in the air
  ToolChoice tool_before_;         // value before a change
  double stiffness_before_ = 0.0;  // value before a change
  double turn_rad_ = 0.0, wheel_radius_mm_ = 0.0;
  render::Extent extent_;  // of the pot on the wheel
};

}  // namespace clay::studio
