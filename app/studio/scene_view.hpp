#pragma once
// The pot as it stands in the window: the camera, the mouse above it, the picture.

#include "app/render/painter.hpp"
#include "app/studio/input.hpp"
#include "app/studio/tool_choice.hpp"
#include "claystack/engine/tool.hpp"

#include <memory>
#include <optional>

namespace clay::studio {

struct AppState;

/// Of the framebuffer, from its upper left corner [px].
struct ViewRect {
  glm::vec2 corner_px{0.0f}, size_px{1.0f};
  [[nodiscard]] bool holds(glm::vec2 place_px) const noexcept {
    const glm::vec2 p = place_px - corner_px;
    return p.x >= 0.0f && p.y >= 0.0f && p.x < size_px.x && p.y < size_px.y;
  }
};

enum class Seen { home, front, right, top };

class SceneView {
 public:
  // What the mouse does. `take` answers whether the view made use of it.
  bool pointer_moved(AppState& shop, glm::vec2 place_px);
  bool button(AppState& shop, const ButtonChanged& change);
  bool scrolled(float steps);
  /// F and Shift+F: the mouse then sets a size or a strength, until a click or a key.
  void begin_sizing(AppState& shop);
  void begin_strength(AppState& shop);
  void cancel(AppState& shop);
  [[nodiscard]] bool sizing() const noexcept {
    return drag_ == Drag::size || drag_ == Drag::strength;
  }

  [[nodiscard]] bool turning() const noexcept { return drag_ == Drag::orbit || drag_ == Drag::pan; }

  void look(const AppState& shop, Seen from);
  void zoom(double notches) { camera_ = render::zoomed(camera_, notches); }
  void place(const ViewRect& rect) noexcept { rect_ = rect; }
  [[nodiscard]] const ViewRect& rect() const noexcept { return rect_; }
  [[nodiscard]] const render::Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] render::Viewport viewport() const noexcept;
  /// Where a place on the profile's plane (rho, y) [mm] is in the window [px].
  [[nodiscard]] std::optional<glm::vec2> pixel_of(glm::dvec2 place_mm) const noexcept;

  /// Once a frame.
  void turn_wheel(const AppState& shop, double rad);
  [[nodiscard]] render::Picture picture(const AppState& shop) const;
  /// At work, or as it would begin where the mouse points; nothing else.
  [[nodiscard]] std::optional<render::ToolView> tool_view(const AppState& shop) const;

  render::Cut cut = render::Cut::none;

 private:
  enum class Drag { none, shape, orbit, pan, size, strength };
  void press(AppState& shop, bool inverted);
  void drag(AppState& shop, glm::vec2 by_px);
  [[nodiscard]] glm::dvec3 on_wheel(glm::dvec2 place_mm) const;
  [[nodiscard]] std::optional<glm::dvec2> pointed_mm() const;

  ViewRect rect_;
  render::Camera camera_;
  Drag drag_ = Drag::none;
  glm::vec2 pointer_px_{-1.0f};
  glm::dvec2 offset_mm_{0.0};  // from the pointer to the tool, since the press
  ToolChoice saved_tool_;      // before a size is set
  double before_ = 0.0;        // stiffness, before it is set
  double turn_rad_ = 0.0, wheel_radius_mm_ = 0.0;
};

}  // namespace clay::studio
