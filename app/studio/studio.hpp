#pragma once
// The window: processes input, updates the state, draws a frame.

#include "app/studio/app_state.hpp"
#include "app/studio/input.hpp"
#include "app/studio/view_canvas.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

struct ImGuiContext;

namespace clay::studio {

/// Frames with a moving pot.
struct FrameTimes {
  Histogram drawing;  ///< time until the frame is complete
  /// From one such frame to the next, and how many times; `last_ns` 0: the pot was at rest.
  std::int64_t last_ns = 0, between_ns = 0, intervals = 0;
  /// From a motion of the mouse until the frame that shows it is complete, without and with a
  /// stroke. The time until the screen shows it is not included.
  Histogram hover, stroke;
  [[nodiscard]] double fps() const noexcept {
    return between_ns > 0 ? 1e9 * static_cast<double>(intervals) / static_cast<double>(between_ns)
                          : 0.0;
  }
};

/// Whether a frame paints the screen. Frames that differ from the last painted one are painted
/// anyway, except with `none`.
enum class Painting { none, if_changed, always };

/// Keys and clipboard of the current ImGui context. The host must outlive it.
void connect_imgui(Host& host);

class Studio {
 public:
  /// Requires the OpenGL context of the host to be current, here and in every call. `log_line`
  /// receives events.
  static Result<std::unique_ptr<Studio>> create(Host& host, Settings settings,
                                                std::function<void(std::string_view)> log_line);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  /// Queues input for the next frame.
  void take(Input input);
  /// Updates everything to the current time of the clock. Returns whether it has painted a frame.
  bool frame(Painting painting);
  /// Draws the panels once more, but not on the screen, for a reader of their texts.
  void repeat_panels() { build_frame(kShortestFrameS); }

  [[nodiscard]] AppState& state() noexcept { return state_; }
  [[nodiscard]] const AppState& state() const noexcept { return state_; }
  [[nodiscard]] const FrameTimes& frame_times() const noexcept { return times_; }
  [[nodiscard]] bool done() const noexcept { return state_.done; }
  /// True if the next frame differs from this one even without further input.
  [[nodiscard]] bool wakeful() const noexcept;

 private:
  Studio(Host& host, Settings settings, std::function<void(std::string_view)> log_line);
  [[nodiscard]] bool moving() const noexcept;
  void handle_input();
  void restyle();
  void let_keys_navigate();
  void build_frame(double elapsed_s);
  void apply(const Input& input);
  void key(const KeyChanged& change);
  void plug_gamepad(const std::string& name);
  void gamepad(const GamepadState& pad);
  void pad_button(const PadBinding& binding, bool down);
  [[nodiscard]] bool enter_chooses() const;
  [[nodiscard]] int key_that_chooses() const;
  void name_window();
  void turn_wheel(double elapsed_s);
  void lay_out(const ViewModel& model, Actions& actions);
  void place_view(const ViewModel& model, const ViewRect& view, float timeline, bool card);
  [[nodiscard]] bool needs_paint();
  void paint();
  bool update_canvas();

  static constexpr double kShortestFrameS = 1e-4;
  static constexpr int kFramesAfterInput = 3;  // frames until an ImGui window has settled

  AppState state_;
  ImGuiContext* context_ = nullptr;
  std::optional<ViewCanvas> canvas_;
  std::deque<Input> input_;
  std::array<int, kPadButtons> pad_keys_{};  // the key that each button holds down; 0: none
  std::int64_t moved_ns_ = 0;  // arrival of the first motion that no frame shows yet; 0: none
  std::string title_;
  double last_s_ = 0.0;
  double spin_ = 0.0;  // speed of the wheel: 0 at rest, 1 at full speed
  FrameTimes times_;
  bool warm_ = false;       // the driver is prepared
  std::size_t panels_ = 0;  // hash of the painted panels
  int awake_frames_ = 0;    // ImGui needs some frames after an input
  float guide_px_ = 0.0f;   // kept free for the guide's card
};

}  // namespace clay::studio
