#pragma once
// Who throws: the work so far, the hand, and the stroke that is under way.

#include "app/history/work.hpp"
#include "app/render/picture.hpp"
#include "app/servo/recorder.hpp"
#include "app/studio/mouse_hand.hpp"
#include "app/studio/stroke_session.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace clay::studio {

/// Events since the window last looked; each is reported once.
struct PotterNews {
  bool stroke_ended = false;
  servo::Ending ending = servo::Ending::none;
  std::size_t poses = 0;    ///< of that stroke
  std::uint64_t ticks = 0;  ///< the same
  bool ring_limit = false;  ///< clay waits above the rim
  bool device_lost = false;
  std::optional<Error> error;
};

/// How the servo of a stroke did.
struct ServoRecord {
  servo::ServoTiming timing;
  servo::GuardEvents events;
  servo::Realtime realtime;
};

/// Of a stroke, as it begins.
struct Press {
  ToolSpec tool;
  double rate_per_s = 20.0;  ///< of removal
  glm::dvec3 place_mm{0.0};  ///< on the wheel, free of the clay
  double gap_mm = 0.0;       ///< of a pinch: wide enough for the wall; it closes to the tool's own
};

/// In the middle of a stroke.
struct Moment {
  history::NodeId node = 0;
  double seconds = 0.0;
};

class StrokeController {
 public:
  /// `clock` outlives it. Without `threads` the servo ticks within `advance`.
  StrokeController(servo::Clock& clock, bool threads)
      : clock_(clock), threads_(threads), mouse_(clock) {}
  /// From now on every work has a journal, so that a program that dies loses none of it.
  void keep_journals() noexcept { journals_ = true; }
  ~StrokeController() { release(); }
  StrokeController(const StrokeController&) = delete;
  StrokeController& operator=(const StrokeController&) = delete;

  /// In place of what there was: a scene's lump, a pot, a whole work.
  Result<void> begin(const SceneSpec& scene);
  Result<void> begin(const SceneSpec& scene, const Pot& pot);
  Result<void> begin(WorkRecord record);
  /// With the journal that it was recovered from.
  Result<void> begin(history::Work work);
  /// A clean end: what was not saved is not wanted.
  void close();
  [[nodiscard]] bool has_work() const noexcept { return work_.has_value(); }
  /// Of the next stroke.
  [[nodiscard]] const SceneSpec& scene() const noexcept { return scene_; }
  /// The contact's [N/mm^2], from the next stroke on.
  void set_stiffness(double n_per_mm2);
  [[nodiscard]] const Pot& pot() const noexcept { return *pot_; }
  /// The same for who keeps it; nothing before there is a work. As the stroke under way found it.
  [[nodiscard]] const history::SharedPot& shared_pot() const noexcept { return pot_; }
  [[nodiscard]] const history::Work& work() const noexcept { return *work_; }

  /// The mouse takes the tool to the clay. The scene is that of the work, with this tool and rate.
  Result<void> press(const Press& press);
  void aim(const MouseAim& aim) noexcept { mouse_.aim(aim); }
  void command(const servo::Command& command) noexcept;
  /// Nothing that the hand does reaches the clay, and none of it the hand: in this stroke and in
  /// those that follow, until it is taken back.
  void pause(bool on) noexcept;
  [[nodiscard]] bool paused() const noexcept { return paused_; }
  /// Lets go; the stroke is part of the work.
  void release();

  /// An arm or a controller in place of the mouse; it is open. Its strokes last from here until it
  /// is given back, undo and a change of tool aside.
  void take(std::unique_ptr<falcon::HapticDevice> device, servo::LiveSettings settings);
  [[nodiscard]] bool has_device() const noexcept { return device_ != nullptr; }
  /// A hand may be pushed.
  [[nodiscard]] bool has_motors() const noexcept { return device_ && device_->info().can_push; }
  /// What the device holds in the clay: with the next frame.
  void hold(const ToolSpec& tool, double rate_per_s);
  [[nodiscard]] bool throwing() const noexcept { return sitting_ != nullptr; }

  /// Once a frame.
  void advance(std::int64_t now_ns);
  [[nodiscard]] PotterNews take_news() { return std::exchange(news_, {}); }

  /// As it is now, also in mid-stroke.
  [[nodiscard]] const render::PotView& view() const noexcept { return view_; }
  /// Of the view's height what is the crown's and in no row; 0 at rest, where it is in the rows
  /// [mm].
  [[nodiscard]] double crown_mm() const noexcept { return crown_mm_; }
  /// Of the stroke under way, or the last one.
  [[nodiscard]] const servo::LiveStatus& status() const noexcept { return status_; }
  /// Of the stroke that ended last.
  [[nodiscard]] const ServoRecord& servo() const noexcept { return servo_; }
  /// Every tick of all strokes, for the window to take.
  [[nodiscard]] servo::TickTrace& trace() noexcept { return trace_; }
  /// Of the servo, as measured; 0 at rest.
  [[nodiscard]] double tick_rate_hz() const noexcept { return tick_rate_hz_; }
  [[nodiscard]] std::string device_name() const {
    return device_ ? device_->info().name : mouse_.info().name;
  }

  // Not while throwing.
  [[nodiscard]] bool can_undo() const noexcept { return work_ && work_->can_undo(); }
  [[nodiscard]] bool can_redo() const noexcept { return work_ && work_->can_redo(); }
  void undo();
  void redo();
  void go_to(history::NodeId node);
  /// Shows the pot in mid-stroke, until `show_present` or anything else that shows a pot. The work
  /// stays where it is, until the pot that is shown is pressed.
  void scrub(history::NodeId node, double seconds);
  void show_present();
  /// That moment becomes the present, as a branch (history::Work::branch).
  void branch_here();
  [[nodiscard]] bool scrubbing() const noexcept { return moment_.has_value(); }
  [[nodiscard]] const std::optional<Moment>& moment() const noexcept { return moment_; }
  /// The part that fell is seen here.
  void show_fall(const render::FallenView& fallen) { view_.fallen = fallen; }
  /// What is not saved is not wanted: its journal goes with the next work.
  void give_up() noexcept { given_up_ = true; }
  [[nodiscard]] bool unsaved() const noexcept { return work_ && work_->unsaved(); }
  Result<void> save(const std::string& path);

 private:
  void begin(const SceneSpec& scene, history::Work work);
  Result<void> sit_down(const SceneSpec& scene, falcon::HapticDevice& device,
                        const servo::LiveSettings& settings);
  void sit_with_device();
  void lose_device();
  void look();
  void show_pot();
  void count_ticks(std::int64_t now_ns);

  servo::Clock& clock_;
  bool threads_;
  bool journals_ = false;
  bool paused_ = false;
  bool given_up_ = false;         // the work, by an answer to a question
  std::optional<Moment> moment_;  // the view is of it, not of the present pot
  MouseDevice mouse_;
  std::unique_ptr<falcon::HapticDevice> device_;
  servo::LiveSettings device_settings_;
  bool device_waits_ = false;  // it is to sit down as soon as it can
  SceneSpec scene_;
  std::optional<history::Work> work_;
  history::SharedPot pot_;
  servo::TickTrace trace_;
  std::unique_ptr<servo::Recorder> recorder_;
  std::unique_ptr<StrokeSession> sitting_;
  servo::LiveStatus status_;
  ServoRecord servo_;
  render::PotView view_;
  double crown_mm_ = 0.0;
  PotterNews news_;
  double gap_mm_ = 0.0, closed_gap_mm_ = 0.0;  // of a pinch that closes
  std::int64_t last_ns_ = 0;                   // of the frame before
  std::int64_t counted_ns_ = 0;
  std::uint64_t counted_ticks_ = 0;
  double tick_rate_hz_ = 0.0;
};

}  // namespace clay::studio
