// Actions on the tool and the wheel.

#include "app/studio/performer.hpp"

#include "app/studio/commands.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clay::studio {
namespace {

constexpr double kGapShareStep = 0.05;

}  // namespace

void Performer::operator()(const SetToolMode& set) const {
  state.settings.tool.mode = set.mode;
  if (set.mode == ToolMode::pinch && state.document.has_work() && !state.stroke.throwing())
    state.scene.make_room(state.stroke.view(), set.mode);
}

void Performer::operator()(const StepTool& step) const {
  const ViewModel view = view_model(state);
  std::vector<const Command*> tools;
  std::size_t chosen = 0;
  for (const Command& command : commands()) {
    if (!std::holds_alternative<SetToolMode>(command.action) || !command.enabled(view)) continue;
    if (command.checked(view)) chosen = tools.size();
    tools.push_back(&command);
  }
  const std::size_t count = tools.size();
  (*this)(RunCommand{tools[(chosen + count + static_cast<std::size_t>(step.by)) % count]->id});
}

void Performer::operator()(const SetToolShape& set) const { state.settings.tool.shape = set.shape; }

void Performer::operator()(const ScaleTool& scale) const {
  resize(state.settings.tool, scale.factor);
}

void Performer::operator()(const ChangeGap& change) const {
  double& gap_mm = state.settings.tool.gap_mm;
  if (double& share = state.settings.tool.gap_share; share > 0.0) {
    share = std::clamp(share + std::copysign(kGapShareStep, change.by_mm), kLeastGapShare,
                       kMostGapShare);
    return;
  }
  gap_mm = std::clamp(gap_mm + change.by_mm, kNarrowestGapMm, kWidestPinchMm);
}

void Performer::operator()(const SetStiffness& set) const {
  state.document.set_stiffness(set.n_per_mm2);
}

void Performer::operator()(const DragToolSize&) const { state.scene.drag_size(view_model(state)); }

void Performer::operator()(const DragStiffness&) const {
  state.scene.drag_stiffness(view_model(state));
}

void Performer::operator()(const TogglePause&) const { state.stroke.pause(!state.stroke.paused()); }

void Performer::operator()(const Rearm&) const {
  state.stroke.command({servo::CommandKind::rearm, 0.0});
}

void Performer::operator()(const Back&) const {
  const bool force =
      state.stroke.has_device() && state.document.has_work() && !state.stroke.paused();
  if (force) state.stroke.pause(true);
  if (state.scene.setting()) {
    Actions undone;
    state.scene.cancel(undone);
    return apply_all(state, undone);
  }
  if (!state.ui.shows<NoDialog>()) return (*this)(CloseDialog{});
  if (state.ui.keys_in) return state.ui.keys_in.reset();
  if (state.document.scrubbing())
    return change_document([](Document& document) { return document.show_present(); });
  if (state.guide.demonstration() != Demonstration::none) return (*this)(StopShowing{});
  if (state.stroke.throwing() && !state.stroke.has_device()) return state.stroke.release();
  if (!force) (*this)(CloseNotice{!state.ui.notices.answer()});
}

void Performer::operator()(const PressClay& press) const {
  if (succeeded(state, state.stroke.press(press.press))) return state.log("stroke started");
  state.scene.stop_shaping();
  if (state.document.fallen())  // the answer reports it
    state.ui.notices.keep_answer_while([](const Document& document) { return document.fallen(); });
}

void Performer::operator()(const AimTool& aim) const {
  state.stroke.aim(aim.aim);
  if (aim.gap_mm) state.stroke.close_to(*aim.gap_mm);
}

void Performer::operator()(const ReleaseTool&) const { state.stroke.release(); }

}  // namespace clay::studio
