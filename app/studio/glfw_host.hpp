#pragma once
// A window on a screen.

#include "app/studio/glfw_gamepad.hpp"
#include "app/studio/host.hpp"
#include "app/studio/studio.hpp"
#include "claystack/core/result.hpp"

#include <memory>

struct GLFWwindow;

namespace clay::studio {

class GlfwHost final : public Host {
 public:
  /// Makes its OpenGL context current. Error `device`: no display, or no OpenGL 3.3.
  static Result<std::unique_ptr<GlfwHost>> create(glm::ivec2 size);
  ~GlfwHost() override;

  /// Draws frames until the studio ends or a signal requests the end (servo::ForceSignals): at most
  /// sixty frames a second, and none that equals the one on the screen. `seconds`: maximum
  /// duration; 0: no limit.
  void run(Studio& studio, double seconds = 0.0);

  [[nodiscard]] glm::ivec2 size_px() const override;
  [[nodiscard]] float content_scale() const override;
  [[nodiscard]] servo::Clock& clock() override { return clock_; }
  [[nodiscard]] bool real_time() const override { return true; }
  [[nodiscard]] std::int64_t frame_ns() override { return frame_ns_; }
  void set_title(const std::string& title) override;
  void set_clipboard(const std::string& text) override;
  [[nodiscard]] std::string clipboard() override;

 private:
  explicit GlfwHost(GLFWwindow* window) : window_(window) {}
  void connect();
  void key(int key, int scancode, int action, unsigned mods);
  void typed(char32_t character);
  void read_gamepad();
  void wait_for_events();

  GLFWwindow* window_;
  servo::MonotonicClock clock_;
  std::int64_t frame_ns_ = clock_.now_ns();
  GlfwGamepad gamepad_;
  Studio* studio_ = nullptr;
  bool damaged_ = true;  // the screen has lost the last frame
  glm::ivec2 shown_{0};  // size of the last frame
  int key_ = 0;          // that changed last
};

}  // namespace clay::studio
