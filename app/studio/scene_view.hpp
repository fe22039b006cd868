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

class SceneView {
 public:
  // --- Mouse. A bool result: the view used the event. --------------------------------------------
  bool pointer_moved(const ViewModel& view, glm::vec2 place_px, Actions& actions);
  bool button(const ViewModel& view, const ButtonChanged& change, Actions& actions);
  bool scrolled(float steps);
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
  void shape_from(const ViewModel& view, glm::dvec2 pointed_mm, bool inverted, Actions& actions);
  void shape_to(const ViewModel& view, glm::dvec2 pointed_mm, Actions& actions) const;
  [[nodiscard]] bool turning() const noexcept { return drag_ == Drag::orbit || drag_ == Drag::pan; }

  // --- Camera. -----------------------------------------------------------------------------------
  void look(const render::PotView& pot, ViewFrom from);
  /// Moves back if the rim and 60 mm above it are not in sight.
  void keep_rim_in_view(const render::PotView& pot);
  void zoom(double notches) { camera_ = render::zoomed(camera_, notches); }
  /// `covered_px`: the height at the foot of the view over which the timeline lies.
  void place(const ViewRect& rect, float covered_px = 0.0f) noexcept {
    rect_ = rect;
    camera_.covered = covered_px / rect.size_px.y;
  }
  [[nodiscard]] const ViewRect& rect() const noexcept { return rect_; }
  [[nodiscard]] const render::Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] render::Viewport viewport() const noexcept;
  /// Pixel of the window for a point (rho, y) [mm] of the section plane.
  [[nodiscard]] std::optional<glm::vec2> pixel_of(glm::dvec2 place_mm) const noexcept;
  /// Call once a frame.
  void turn_wheel(const render::PotView& pot, double rad);

  // --- Picture. ----------------------------------------------------------------------------------
  [[nodiscard]] render::Picture picture(const ViewModel& view) const;
  /// Place of the tool in the clay, or where a press would begin; empty if neither is shown.
  [[nodiscard]] std::optional<render::ToolView> tool_view(const ViewModel& view) const;

  render::Cut cut = render::Cut::none;

 private:
  enum class Drag { none, shape, orbit, pan, size, stiffness };
  void press(const ViewModel& view, bool inverted, Actions& actions);
  void drag(const ViewModel& view, glm::vec2 by_px, Actions& actions);
  void lift_foot();
  [[nodiscard]] float free_height_px() const noexcept;
  [[nodiscard]] std::optional<render::ToolView> hovering_tool(const ViewModel& view,
                                                              const Tool& tool) const;
  [[nodiscard]] glm::dvec3 on_wheel(glm::dvec2 place_mm) const;
  [[nodiscard]] std::optional<glm::dvec2> pointed_mm() const;

  ViewRect rect_;
  render::Camera camera_;
  Drag drag_ = Drag::none;
  glm::vec2 pointer_px_{-1.0f};
  glm::dvec2 offset_mm_{0.0};      // offset from the pointer to the tool since the press
  ToolChoice tool_before_;         // value before a change
  double stiffness_before_ = 0.0;  // value before a change
  double turn_rad_ = 0.0, wheel_radius_mm_ = 0.0;
};

}  // namespace clay::studio
