#pragma once
// The guide through the steps of a sample: the present step, the path to follow, and the end of the
// step. It can play the strokes itself.

#include "app/studio/document.hpp"
#include "app/studio/guide/lesson_planner.hpp"
#include "app/studio/samples.hpp"
#include "app/studio/stroke_controller.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace clay::studio {

/// Maximum distance of the hand from the path [mm].
inline constexpr double kPathToleranceMm = 4.0;

enum class Demonstration { none, step, all };

class Guide {
 public:
  /// Without `background` plans are made within `update`, so that scripts are reproducible.
  explicit Guide(bool background) : planner_(background) {}

  /// Starts with the first step of a sample.
  Result<void> begin(const Sample& sample, Demonstration demonstration);
  void end() {
    script_.reset();
    demonstration_ = Demonstration::none;
  }
  /// The user goes on to the next step.
  void next();
  /// Plays the stroke of the step, or those of all steps that are left.
  void demonstrate(Demonstration what) { demonstration_ = what; }

  /// Once a frame. While the tool is off the clay, the next stroke is planned, and a step ends when
  /// the clay has its result.
  void update(const Document& document, const StrokeController& stroke);

  [[nodiscard]] bool active() const noexcept { return script_ != nullptr; }
  [[nodiscard]] bool finished() const noexcept { return state_.step >= script_->strokes.size(); }
  [[nodiscard]] const char* title() const noexcept { return sample_->title; }
  [[nodiscard]] std::size_t sample() const noexcept { return index_; }
  [[nodiscard]] std::size_t step() const noexcept { return state_.step; }
  [[nodiscard]] std::size_t steps() const noexcept { return script_->strokes.size(); }
  /// Whether the user has left out this step.
  [[nodiscard]] bool skipped(std::size_t step) const { return state_.skipped.contains(step); }
  [[nodiscard]] std::size_t skipped_steps() const noexcept { return state_.skipped.size(); }
  /// Whether the pot needed no stroke in this step.
  [[nodiscard]] bool left_out(std::size_t step) const { return state_.left_out.contains(step); }
  [[nodiscard]] const strokes::Stroke& stroke(std::size_t step) const {
    return script_->strokes.at(step);
  }
  [[nodiscard]] const ToolSpec& tool() const noexcept { return scene_.tool; }
  /// The path to follow, of the pot on the wheel; null while it is planned, and at the end.
  [[nodiscard]] const LessonPlan* plan() const noexcept { return plan_ ? &*plan_ : nullptr; }
  /// Number of the plan, so that a reader notices a new one; 0: none yet.
  [[nodiscard]] std::size_t plan_number() const noexcept { return plan_number_; }
  /// Progress of the clay in this step, from 0 to 1.
  [[nodiscard]] double progress() const noexcept { return progress_; }
  [[nodiscard]] Demonstration demonstration() const noexcept { return demonstration_; }
  /// Whether the window, not the user, has thrown the pot.
  [[nodiscard]] bool shown() const noexcept { return shown_; }
  /// The plan of a step that has just begun; returned once.
  [[nodiscard]] bool take_new_step() { return std::exchange(new_step_, false); }
  [[nodiscard]] bool busy() const { return active() && planner_.busy(); }

 private:
  struct State {
    std::size_t step = 0;
    int tries = 0;                                      // strokes in this step
    double start_mm2 = 0.0;                             // left at its beginning
    std::set<std::size_t> skipped = {}, left_out = {};  // steps before this one
  };
  void go_on();
  void follow(history::NodeId node);
  void ask(const Document& document);
  void receive(LessonPlan plan);

  const Sample* sample_ = nullptr;
  std::size_t index_ = 0;
  std::shared_ptr<const strokes::StrokeScript> script_;
  SceneSpec scene_;
  State state_;
  history::NodeId node_ = 0;
  std::map<history::NodeId, State> visited_;  // so that undo goes back to the step
  std::optional<LessonPlan> plan_;
  std::size_t plan_number_ = 0;
  bool asked_ = false, new_step_ = false;
  double progress_ = 0.0;
  render::PotView seen_;  // of `progress_`
  Demonstration demonstration_ = Demonstration::none;
  bool shown_ = false;
  LessonPlanner planner_;
};

}  // namespace clay::studio
