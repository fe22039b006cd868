#include "app/studio/guide/play.hpp"

#include "app/studio/app_state.hpp"

#include <algorithm>

namespace clay::studio {
namespace {

constexpr double kPace = 0.8;      // of an experienced hand
constexpr double kReadS = 1.2;     // before the first stroke of a step
constexpr double kCloseS = 0.8;    // two fingers close on the wall before they rise
constexpr double kFarMm = 3.0;     // the hand waits for a tool that is further behind
constexpr double kSettleS = 0.15;  // time for the tool to arrive at the end of the path

glm::dvec2 place_at(const LessonPlan& plan, double time_s) {
  const auto next =
      std::ranges::find_if(plan.path, [&](const PathPoint& p) { return p.time_s >= time_s; });
  if (next == plan.path.end()) return plan.path.back().at_mm;
  if (next == plan.path.begin()) return next->at_mm;
  const PathPoint& before = *std::prev(next);
  const double part = (time_s - before.time_s) / std::max(1e-9, next->time_s - before.time_s);
  return before.at_mm + part * (next->at_mm - before.at_mm);
}

}  // namespace

void Play::advance(AppState& state) {
  const Guide& guide = state.guide;
  const double now_s = state.now_s();
  if (guide.demonstration() == Demonstration::none) {
    playing_ = false;
    read_plan_ = 0;
    return;
  }
  const LessonPlan* plan = guide.plan();
  Actions actions;
  if (!state.stroke.throwing()) {
    playing_ = false;
    if (plan == nullptr || plan->path.empty() || !state.ui.shows<NoDialog>()) return;
    if (read_plan_ != guide.plan_number()) {
      read_plan_ = guide.plan_number();
      rest_until_s_ = now_s + kReadS;
    }
    if (now_s < rest_until_s_) return;
    state.scene.shape_from(view_model(state), plan->path.front().at_mm, {}, actions);
    apply_all(state, actions);
    time_s_ = plan->mode == ToolMode::pinch ? -kPace * kCloseS : 0.0;
    last_s_ = now_s;
    playing_ = state.stroke.throwing();
    if (!playing_) apply(state, StopShowing{});
    return;
  }
  if (!playing_ || plan == nullptr) return;
  if (state.stroke.stretch_mm() < kFarMm) time_s_ += kPace * (now_s - last_s_);
  last_s_ = now_s;
  if (time_s_ > plan->path.back().time_s + kPace * kSettleS) {
    if (guide.demonstration() == Demonstration::step) state.guide.demonstrate(Demonstration::none);
    return apply(state, ReleaseTool{});
  }
  state.scene.shape_to(view_model(state), place_at(*plan, time_s_), {}, actions);
  apply_all(state, actions);
}

}  // namespace clay::studio
