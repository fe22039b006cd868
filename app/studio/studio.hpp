#pragma once
// The window: takes what comes from outside, lets the potter throw, draws what there is.

#include "app/render/gl_objects.hpp"
#include "app/render/painter.hpp"
#include "app/studio/app_state.hpp"
#include "app/studio/input.hpp"
#include "app/studio/quality.hpp"

#include <deque>
#include <memory>
#include <optional>

struct ImGuiContext;

namespace clay::studio {

/// Frames of a pot in motion.
struct Drawn {
  Histogram took;  ///< drawing, until the last pixel
  std::int64_t first_ns = 0, last_ns = 0;
  [[nodiscard]] double fps() const noexcept {
    return last_ns > first_ns ? 1e9 * static_cast<double>(took.count() - 1) /
                                    static_cast<double>(last_ns - first_ns)
                              : 0.0;
  }
};

class Studio {
 public:
  /// The host's context of OpenGL is current, here and in every call. `log_line` gets events.
  static Result<std::unique_ptr<Studio>> create(Host& host, Settings settings,
                                                std::function<void(std::string_view)> log_line);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  /// In order, with the next frame.
  void take(Input input) { waiting_.push_back(std::move(input)); }
  /// At the clock's present time. Without `paint` all is done but the drawing itself.
  void frame(bool paint);

  [[nodiscard]] AppState& shop() noexcept { return shop_; }
  [[nodiscard]] const AppState& shop() const noexcept { return shop_; }
  [[nodiscard]] const Drawn& drawn() const noexcept { return drawn_; }
  [[nodiscard]] bool done() const noexcept { return shop_.done; }
  /// Whether the next frame shows something else even if nothing comes from outside.
  [[nodiscard]] bool wakeful() const noexcept;

 private:
  Studio(Host& host, Settings settings, std::function<void(std::string_view)> log_line);
  [[nodiscard]] bool moving() const noexcept;
  void take_waiting();
  void shape_frame(double elapsed_s);
  void apply(const Input& input);
  void key(const KeyChanged& change);
  void drop(const FilesDropped& files);
  void tell_news();
  void show_fall(double now_s);
  void name_window();
  void turn_wheel(double elapsed_s);
  void lay_out();
  void paint();

  void draw_view(unsigned target);

  static constexpr int kFramesAfterInput = 3;  // an ImGui window settles in that many

  AppState shop_;
  ImGuiContext* context_ = nullptr;
  std::optional<render::Painter> painter_;
  std::optional<render::Canvas> canvas_;
  std::deque<Input> waiting_;
  std::string title_;
  double last_s_ = 0.0;
  double spin_ = 0.0;  // of the wheel: 0 stands, 1 turns at its speed
  Quality quality_;
  Drawn drawn_;
  bool coarse_ = false;   // the last frame was not drawn in full
  int awake_frames_ = 0;  // ImGui needs some after an input
};

}  // namespace clay::studio
