#include "app/studio/guide/guide.hpp"

#include <algorithm>
#include <utility>

namespace clay::studio {
namespace {

// A step ends when this share of its change, or this area of the half-section, is left.
constexpr double kLeftShare = 0.3, kLeftMm2 = 30.0;
constexpr double kNothingMm2 = 3.0;  // a step that would change less is left out
constexpr int kSpareTries = 2;       // after these the lesson continues with the clay as it is

}  // namespace

Result<void> Guide::begin(const Sample& sample, Demonstration demonstration) {
  auto scene = scene_of(sample);
  if (!scene) return tl::make_unexpected(scene.error());
  return strokes::parse_strokes(sample.strokes_text, sample.name)
      .map([&](strokes::StrokeScript&& script) {
        sample_ = &sample;
        index_ = static_cast<std::size_t>(&sample - samples().data());
        script_ = std::make_shared<const strokes::StrokeScript>(std::move(script));
        scene_ = std::move(*scene);
        state_ = {};
        node_ = 0;
        visited_.clear();
        plan_.reset();
        asked_ = false;
        progress_ = 0.0;
        shown_ = false;
        demonstrate(demonstration);
      });
}

void Guide::next() {
  if (!active() || finished()) return;
  // The user decides when a step with a stroke is good enough.
  if (state_.tries == 0) state_.skipped.insert(state_.step);
  go_on();
}

void Guide::go_on() {
  if (!active() || finished()) return;
  state_ = {state_.step + 1, 0, 0.0, std::move(state_.skipped), std::move(state_.left_out)};
  plan_.reset();
  asked_ = false;
  progress_ = 0.0;
  if (demonstration_ == Demonstration::step || finished()) demonstration_ = Demonstration::none;
}

/// A stroke, or undo: the step is that of the pot.
void Guide::follow(history::NodeId node) {
  visited_[node_] = state_;
  if (const auto known = visited_.find(node); known != visited_.end())
    state_ = known->second;
  else
    ++state_.tries;
  node_ = node;
  plan_.reset();
  asked_ = false;
}

void Guide::ask(const Document& document) {
  asked_ = true;
  const int passes = script_->strokes[state_.step].passes - state_.tries;
  planner_.ask({script_, scene_, document.shared_pot(), node_, state_.step, std::max(1, passes)});
}

void Guide::receive(LessonPlan plan) {
  if (plan.node != node_ || plan.step != state_.step) return;
  if (!plan.problem.empty()) {  // the card shows it; a stroke or undo makes another plan
    demonstration_ = Demonstration::none;
    plan_ = std::move(plan);
    return;
  }
  if (state_.tries == 0) state_.start_mm2 = plan.left_mm2;
  const double enough = std::max(kLeftMm2, kLeftShare * state_.start_mm2);
  const bool there = plan.left_mm2 <= (state_.tries > 0 ? enough : kNothingMm2);
  const strokes::Stroke& stroke = script_->strokes[state_.step];
  const bool sponge = stroke.kind == strokes::StrokeKind::lip;  // one stroke does it
  const bool tried = state_.tries >= stroke.passes + (sponge ? 0 : kSpareTries);
  if (there || tried || plan.path.empty()) {
    if (state_.tries == 0) state_.left_out.insert(state_.step);
    return go_on();
  }
  progress_ =
      state_.start_mm2 > 0.0 ? std::clamp(1.0 - plan.left_mm2 / state_.start_mm2, 0.0, 1.0) : 0.0;
  new_step_ = true;
  plan_ = std::move(plan);
  ++plan_number_;
}

void Guide::update(const Document& document, const StrokeController& stroke) {
  if (!active() || !document.has_work()) return;
  // A stroke of a device contains times in which the tool is off the clay.
  if (stroke.by_hand() || stroke.touched()) {
    shown_ = shown_ || demonstration_ == Demonstration::all;
    if (finished() || !plan_ || plan_->path.empty() || stroke.view() == seen_) return;
    seen_ = stroke.view();
    const double left = plan_->left_from(seen_);
    progress_ = std::clamp(1.0 - left / std::max(1.0, state_.start_mm2), 0.0, 1.0);
    return;
  }
  if (document.scrubbing() || document.pot().collapse) return;
  if (document.work().at() != node_) follow(document.work().at());
  if (finished()) return;
  if (!plan_ && !asked_) ask(document);
  if (auto answer = planner_.take()) receive(std::move(*answer));
}

}  // namespace clay::studio
