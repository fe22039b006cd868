#pragma once
// Controls strokes: the mouse or a device, its servo, and the current stroke. The document keeps
// the results.

#include "app/render/picture.hpp"
#include "app/servo/tick_trace.hpp"
#include "app/studio/document.hpp"
#include "app/studio/mouse_hand.hpp"
#include "claystack/engine/wheel.hpp"
#include "claystack/servo/servo.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace clay::studio {

/// Events since the last call; each is reported once.
struct StrokeNews {
  bool stroke_ended = false;
  servo::Ending ending = servo::Ending::none;
  std::size_t poses = 0;    ///< of the stroke that ended
  std::uint64_t ticks = 0;  ///< of the stroke that ended
  render::Extent before;    ///< of the pot, before that stroke
  bool ring_limit = false;  ///< there is clay above the rim
  bool device_lost = false;
  std::string nothing_cut;  ///< reason why a needle or wire in the clay cut nothing
  std::optional<Error> error;
};

/// Timings and events of the servo during one stroke.
struct ServoRecord {
  servo::ServoTiming timing;
  servo::GuardEvents events;
  servo::Realtime realtime;
};

/// Start of a stroke by the mouse.
struct MousePress {
  ToolSpec tool;
  double wheel_rpm = 120.0;
  glm::dvec3 place_mm{0.0};  ///< start position on the wheel, clear of the clay
  double gap_mm =
      0.0;  ///< gap at the start of a pinch, as wide as the wall; it closes to the gap of the tool
};

class StrokeController {
 public:
  /// `document` and `clock` must outlive it. Without `threads` the servo runs within `advance`.
  StrokeController(Document& document, servo::Clock& clock, bool threads)
      : document_(document), clock_(clock), threads_(threads), mouse_(clock) {}
  ~StrokeController() { release(); }
  StrokeController(const StrokeController&) = delete;
  StrokeController& operator=(const StrokeController&) = delete;

  // --- Strokes. ----------------------------------------------------------------------------------
  /// Begins a stroke of the mouse, unless a device is in use.
  Result<void> press(const MousePress& press);
  void aim(const MouseAim& aim) noexcept { mouse_.aim(aim); }
  /// The fingers of a pinch move at their speed to this gap, or to a wider one at a wall that
  /// leans.
  void close_to(double gap_mm) noexcept { closed_gap_mm_ = gap_mm; }
  void command(const servo::Command& command) noexcept;
  /// A pause separates tool and clay, in this stroke and in those that follow.
  void pause(bool on) noexcept;
  [[nodiscard]] bool paused() const noexcept { return paused_; }
  /// Ends the stroke; the document keeps it.
  void release();
  /// Call when the document shows another pot: a device begins a stroke on it.
  void resume() noexcept { device_waits_ = device_ != nullptr; }
  /// The same for a new work; also clears the figures of the old one.
  void begin_work() noexcept;
  /// Devices begin no stroke until `resume`.
  void hold_back() noexcept { device_waits_ = false; }
  [[nodiscard]] bool throwing() const noexcept { return live_.has_value(); }
  /// A stroke of the mouse, the gamepad or the guide, not of a device.
  [[nodiscard]] bool by_hand() const noexcept { return throwing() && !has_device(); }
  /// The tool has touched the clay in the stroke in progress.
  [[nodiscard]] bool touched() const noexcept { return throwing() && touched_; }
  /// The tool has touched the clay in this stroke, and has been off it for longer than
  /// history::kFreeAirS since.
  [[nodiscard]] bool has_left_clay() const noexcept;
  /// Pull of the mouse: the distance from the tool to its target [mm].
  [[nodiscard]] double stretch_mm() const noexcept { return live_ ? mouse_.stretch_mm() : 0.0; }

  // --- Devices. ----------------------------------------------------------------------------------
  /// An open device replaces the mouse until it is lost. Its strokes follow each other; undo and a
  /// change of tool end one.
  void take(std::unique_ptr<falcon::HapticDevice> device, servo::LiveSettings settings);
  [[nodiscard]] bool has_device() const noexcept { return device_ != nullptr; }
  /// The device can exert force.
  [[nodiscard]] bool has_motors() const noexcept { return device_ && device_->info().can_push; }
  /// Sets the tool of the device from the next frame on, and applies a changed stiffness to its
  /// force.
  void hold(const ToolSpec& tool, double wheel_rpm);
  [[nodiscard]] std::string device_name() const {
    return device_ ? device_->info().name : mouse_.info().name;
  }

  // --- Every frame. ------------------------------------------------------------------------------
  void advance(std::int64_t now_ns);
  [[nodiscard]] StrokeNews take_news() { return std::exchange(news_, {}); }
  /// The pot on screen: during a stroke the clay under the tool, otherwise the pot of the document.
  [[nodiscard]] const render::PotView& view() const noexcept {
    return live_ ? view_ : document_.view();
  }
  /// Height of the crown above the rows of `view`; 0 at rest, because the rows include it then
  /// [mm].
  [[nodiscard]] double crown_mm() const noexcept { return live_ ? crown_mm_ : 0.0; }
  /// Figures of the current stroke, or of the last one.
  [[nodiscard]] const servo::LiveStatus& status() const noexcept { return status_; }
  /// Figures of the last finished stroke.
  [[nodiscard]] const ServoRecord& servo() const noexcept { return servo_; }
  /// Every tick of all strokes; the window consumes them.
  [[nodiscard]] servo::TickTrace& trace() noexcept { return trace_; }
  [[nodiscard]] const servo::TickTrace& trace() const noexcept { return trace_; }
  /// Measured rate; 0 at rest.
  [[nodiscard]] double tick_rate_hz() const noexcept { return tick_rate_hz_; }

 private:
  Result<void> begin_session(const SceneSpec& scene, falcon::HapticDevice& device,
                             const servo::LiveSettings& settings);
  Result<void> start_servo(const SceneSpec& scene, falcon::HapticDevice& device,
                           const servo::LiveSettings& settings);
  void begin_with_device();
  void lose_device();
  void read_servo();
  void measure_rate(std::int64_t now_ns);
  [[nodiscard]] double aimed_gap_mm() const;
  [[nodiscard]] std::string why_nothing_cut() const;

  Document& document_;
  servo::Clock& clock_;
  bool threads_;
  bool paused_ = false;
  MouseDevice mouse_;
  std::unique_ptr<falcon::HapticDevice> device_;
  servo::LiveSettings device_settings_;
  bool device_waits_ = false;  // it begins a stroke as soon as possible
  servo::TickTrace trace_;
  std::optional<Wheel> wheel_;            // of the stroke in progress
  std::optional<servo::LiveThrow> live_;  // of the same stroke
  ThrowSettings felt_;                    // of the same stroke; may be softer than `force_`
  std::optional<ForceSpec> force_;        // of the work's scene
  servo::LiveStatus status_;
  ServoRecord servo_;
  bool touched_ = false;         // the clay, in this stroke
  std::int64_t contact_ns_ = 0;  // time of the last frame with contact
  render::PotView view_;         // during a stroke
  render::Extent begun_;         // of the pot at its start
  double crown_mm_ = 0.0;
  StrokeNews news_;
  double resisting_rpm_ = 0.0;  // speed of the wheel whose clay resists the mouse; 0: none does
  double gap_mm_ = 0.0, closed_gap_mm_ = 0.0;  // of a pinch of the mouse: current, final
  std::int64_t last_ns_ = 0;                   // time of the previous frame
  std::int64_t measured_ns_ = 0;
  std::uint64_t measured_ticks_ = 0;
  double tick_rate_hz_ = 0.0;
};

}  // namespace clay::studio
