#include "app/studio/glfw_host.hpp"

#include "app/servo/signals.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

namespace clay::studio {
namespace {

constexpr std::int64_t kFrameNs = 1'000'000'000 / 60;
constexpr double kIdleS = 0.5;  // interval of updates without input

GlfwHost& host_of(GLFWwindow* window) {
  return *static_cast<GlfwHost*>(glfwGetWindowUserPointer(window));
}

unsigned mods_of(int glfw) {
  return ((glfw & GLFW_MOD_SHIFT) != 0 ? kShift : 0u) |
         ((glfw & GLFW_MOD_CONTROL) != 0 ? kControl : 0u) |
         ((glfw & GLFW_MOD_ALT) != 0 ? kAlt : 0u);
}

std::string problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  std::string reason = text != nullptr ? text : "no reason given";
  reason.erase(reason.find_last_not_of(' ') + 1);  // the name of the display may be empty
  return reason;
}

}  // namespace

Result<std::unique_ptr<GlfwHost>> GlfwHost::create(glm::ivec2 size) {
  if (glfwInit() == GLFW_FALSE)
    return failure(ErrorKind::device,
                   "the window: no display: " + problem() + "; --script draws without one");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "claystack");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "claystack");
  GLFWwindow* window = glfwCreateWindow(size.x, size.y, "Claystack", nullptr, nullptr);
  if (window == nullptr) {
    const std::string why = problem();
    glfwTerminate();
    return failure(ErrorKind::device, "the window: expected OpenGL 3.3: " + why);
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window, 640, 480, GLFW_DONT_CARE, GLFW_DONT_CARE);
  return std::unique_ptr<GlfwHost>(new GlfwHost(window));
}

GlfwHost::~GlfwHost() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

/// Every key and click is queued, so that short ones are not lost.
void GlfwHost::connect() {
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    GlfwHost& host = host_of(window);
    int width = 1, height = 1;
    glfwGetWindowSize(window, &width, &height);
    const glm::dvec2 ratio =
        glm::dvec2(host.size_px()) / glm::dvec2(std::max(1, width), std::max(1, height));
    host.studio_->take(PointerMoved{glm::vec2(glm::dvec2(x, y) * ratio)});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int mods) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    host_of(window).studio_->take(
        ButtonChanged{static_cast<MouseButton>(button), action == GLFW_PRESS, mods_of(mods)});
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double y) {
    host_of(window).studio_->take(Scrolled{static_cast<float>(y)});
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int mods) {
    host_of(window).key(key, scancode, action, mods_of(mods));
  });
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    host_of(window).typed(static_cast<char32_t>(character));
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    host_of(window).studio_->take(FilesDropped{std::vector<std::string>(paths, paths + count)});
  });
  glfwSetWindowRefreshCallback(window_,
                               [](GLFWwindow* window) { host_of(window).damaged_ = true; });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* window) {
    glfwSetWindowShouldClose(window, GLFW_FALSE);
    host_of(window).studio_->take(CloseAsked{});
  });
  glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* window, float, float) {
    host_of(window).studio_->state().ui.restyle = true;
  });
}

void GlfwHost::key(int key, int scancode, int action, unsigned mods) {
  const char* printed = glfwGetKeyName(key, scancode);
  key_ = key_of_layout(key, printed != nullptr ? printed : "", mods);
  studio_->take(KeyChanged{key_, action != GLFW_RELEASE, action == GLFW_REPEAT, mods});
}

/// A question mark counts as the key ?, at any place of the layout.
void GlfwHost::typed(char32_t character) {
  studio_->take(TextTyped{character});
  if (character != U'?' || key_ == GLFW_KEY_SLASH) return;
  for (const bool down : {true, false})
    studio_->take(KeyChanged{GLFW_KEY_SLASH, down, false, kShift});
}

void GlfwHost::read_gamepad() {
  if (auto name = gamepad_.news()) studio_->take(GamepadPlugged{std::move(*name)});
  if (const auto state = gamepad_.changed()) studio_->take(GamepadChanged{*state});
}

/// Waits for the next frame. GLFW does not wake for a gamepad, so a connected one is read as often
/// as there are frames.
void GlfwHost::wait_for_events() {
  if (studio_->wakeful()) {
    glfwPollEvents();
    return read_gamepad();
  }
  const std::int64_t until_ns = clock_.now_ns() + static_cast<std::int64_t>(1e9 * kIdleS);
  do {
    glfwWaitEventsTimeout(gamepad_.connected() ? 1e-9 * static_cast<double>(kFrameNs) : kIdleS);
    read_gamepad();
  } while (gamepad_.connected() && !studio_->wakeful() && !damaged_ && size_px() == shown_ &&
           clock_.now_ns() < until_ns);
}

void GlfwHost::run(Studio& studio, double seconds) {
  studio_ = &studio;
  connect();
  std::int64_t next_ns = clock_.now_ns();
  const std::int64_t end_ns =
      seconds > 0.0 ? next_ns + static_cast<std::int64_t>(1e9 * seconds) : INT64_MAX;
  while (!studio.done() && servo::ForceSignals::asked_to_stop() == 0 && clock_.now_ns() < end_ns) {
    wait_for_events();
    frame_ns_ = clock_.now_ns();
    const glm::ivec2 size = size_px();
    if (size.x > 0 && size.y > 0) {
      const bool damaged = std::exchange(damaged_, false) || size != std::exchange(shown_, size);
      if (studio.frame(damaged ? Painting::always : Painting::if_changed)) glfwSwapBuffers(window_);
    }
    // Without vertical sync, frames that the screen never shows would compete with the servo for
    // the processor.
    clock_.sleep_until_ns(next_ns);
    next_ns = std::max(next_ns + kFrameNs, clock_.now_ns());
  }
  studio_ = nullptr;
}

glm::ivec2 GlfwHost::size_px() const {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

float GlfwHost::content_scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::max(x, y);
}

void GlfwHost::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
void GlfwHost::set_clipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}
std::string GlfwHost::clipboard() {
  const char* text = glfwGetClipboardString(window_);
  return text != nullptr ? text : "";
}

}  // namespace clay::studio
