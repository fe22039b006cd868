#pragma once
// The pot as it stands in the window: the camera, the mouse above it, the picture.

#include "app/render/painter.hpp"
#include "app/studio/input.hpp"
#include "app/studio/tool_choice.hpp"
#include "claystack/engine/tool.hpp"

#include <memory>
#include <optional>

namespace clay::studio {

struct Workshop;

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
  bool pointer_moved(Workshop& shop, glm::vec2 place_px);
  bool button(Workshop& shop, const ButtonChanged& change);
  bool scrolled(float steps);
  /// F and Shift+F: the mouse then sets a size or a strength, until a click or a key.
  void begin_sizing(Workshop& shop);
  void begin_strength(Workshop& shop);
  void cancel(Workshop& shop);
  [[nodiscard]] bool sizing() const noexcept {
    return drag_ == Drag::size || drag_ == Drag::strength;
  }

  [[nodiscard]] bool turning() const noexcept { return drag_ == Drag::orbit || drag_ == Drag::pan; }

  void look(const Workshop& shop, Seen from);
  void zoom(double notches) { camera_ = draw::zoomed(camera_, notches); }
  void place(const ViewRect& rect) noexcept { rect_ = rect; }
  [[nodiscard]] const ViewRect& rect() const noexcept { return rect_; }
  [[nodiscard]] const draw::Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] draw::Viewport viewport() const noexcept;
  /// Where a place on the profile's plane (rho, y) [mm] is in the window [px].
  [[nodiscard]] std::optional<glm::vec2> pixel_of(glm::dvec2 place_mm) const noexcept;

  /// Once a frame.
  void turn_wheel(const Workshop& shop, double rad);
  [[nodiscard]] draw::Picture picture(const Workshop& shop) const;
  /// At work, or as it would begin where the mouse points; nothing else.
  [[nodiscard]] std::optional<draw::ToolView> tool_view(const Workshop& shop) const;

  draw::Cut cut = draw::Cut::none;

 private:
  enum class Drag { none, shape, orbit, pan, size, strength };
  void press(Workshop& shop, bool inverted);
  void drag(Workshop& shop, glm::vec2 by_px);
  [[nodiscard]] glm::dvec3 on_wheel(glm::dvec2 place_mm) const;
  [[nodiscard]] std::optional<glm::dvec2> pointed_mm() const;

  ViewRect rect_;
  draw::Camera camera_;
  Drag drag_ = Drag::none;
  glm::vec2 pointer_px_{-1.0f};
  glm::dvec2 offset_mm_{0.0};  // from the pointer to the tool, since the press
  ToolChoice saved_tool_;      // before a size is set
  double before_ = 0.0;        // stiffness, before it is set
  double turn_rad_ = 0.0, wheel_radius_mm_ = 0.0;
};

}  // namespace clay::studio
