#pragma once
// The pot in the window: camera, mouse over the pot, picture. What the mouse does to the clay and
// to the settings becomes actions.

#include "app/render/painter.hpp"
#include "app/studio/action.hpp"
#include "app/studio/input.hpp"
#include "app/studio/tool_choice.hpp"

#include <optional>

namespace clay::studio {

struct ViewModel;

/// Of the framebuffer, from its upper left corner [px].
struct ViewRect {
  glm::vec2 corner_px{0.0f}, size_px{1.0f};
  [[nodiscard]] bool holds(glm::vec2 place_px) const noexcept {
    const glm::vec2 p = place_px - corner_px;
    return p.x >= 0.0f && p.y >= 0.0f && p.x < size_px.x && p.y < size_px.y;
  }
};

class SceneView {
 public:
  // --- Mouse. Functions that return a bool: whether the view used the event.
  // -------------------------
  bool pointer_moved(const ViewModel& view, glm::vec2 place_px, Actions& actions);
  bool button(const ViewModel& view, const ButtonChanged& change, Actions& actions);
  bool scrolled(float steps);
  /// The mouse sets the size of the tool, or the stiffness, until a click or Esc.
  void drag_size(const ViewModel& view);
  void drag_stiffness(const ViewModel& view);
  [[nodiscard]] bool setting() const noexcept {
    return drag_ == Drag::size || drag_ == Drag::stiffness;
  }
  /// Ends `setting`, with the value from before.
  void cancel(Actions& actions);
  /// The stroke could not begin.
  void stop_shaping() noexcept { drag_ = Drag::none; }
  [[nodiscard]] bool turning() const noexcept { return drag_ == Drag::orbit || drag_ == Drag::pan; }

  // --- Camera.
  // ----------------------------------------------------------------------------------------
  void look(const render::PotView& pot, ViewFrom from);
  void zoom(double notches) { camera_ = render::zoomed(camera_, notches); }
  void place(const ViewRect& rect) noexcept { rect_ = rect; }
  [[nodiscard]] const ViewRect& rect() const noexcept { return rect_; }
  [[nodiscard]] const render::Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] render::Viewport viewport() const noexcept;
  /// Pixel of the window for a point (rho, y) [mm] of the profile plane.
  [[nodiscard]] std::optional<glm::vec2> pixel_of(glm::dvec2 place_mm) const noexcept;
  /// Once a frame.
  void turn_wheel(const render::PotView& pot, double rad);

  // --- Picture.
  // ---------------------------------------------------------------------------------------
  [[nodiscard]] render::Picture picture(const ViewModel& view) const;
  /// In the clay, or where a press would begin; empty where neither is shown.
  [[nodiscard]] std::optional<render::ToolView> tool_view(const ViewModel& view) const;

  render::Cut cut = render::Cut::none;

 private:
  enum class Drag { none, shape, orbit, pan, size, stiffness };
  void press(const ViewModel& view, bool inverted, Actions& actions);
  void drag(const ViewModel& view, glm::vec2 by_px, Actions& actions);
  [[nodiscard]] std::optional<render::ToolView> hovering_tool(const ViewModel& view,
                                                              const Tool& tool) const;
  [[nodiscard]] glm::dvec3 on_wheel(glm::dvec2 place_mm) const;
  [[nodiscard]] std::optional<glm::dvec2> pointed_mm() const;

  ViewRect rect_;
  render::Camera camera_;
  Drag drag_ = Drag::none;
  glm::vec2 pointer_px_{-1.0f};
  glm::dvec2 offset_mm_{0.0};      // from the pointer to the tool, since the press
  ToolChoice tool_before_;         // before its size is set
  double stiffness_before_ = 0.0;  // before it is set
  double turn_rad_ = 0.0, wheel_radius_mm_ = 0.0;
};

}  // namespace clay::studio
