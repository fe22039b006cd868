#include "app/studio/app_state.hpp"

#include "app/servo/words.hpp"
#include "app/studio/commands.hpp"

#include <utility>

namespace clay::studio {

ViewModel view_model(AppState& state) {
  return {.settings = state.settings,
          .document = state.document,
          .stroke = state.stroke,
          .readings = state.readings,
          .guide = state.guide,
          .scene = state.scene,
          .ui = state.ui,
          .recoverable = state.recoverable,
          .export_running = state.exporter.running(),
          .export_stage = state.exporter.stage(),
          .picture_running = state.pictures.busy(),
          .picture_progress = state.pictures.progress(),
          .now_s = state.now_s(),
          .real_time = state.host.real_time(),
          .fingers = state.host.fingers()};
}

bool ViewModel::has_marks() const {
  return !stroke.throwing() && !document.scrubbing() && !ui.marks.empty() &&
         ui.marked == document.shared_pot();
}

std::string ViewModel::arm_text() const {
  if (!stroke.throwing() || !stroke.has_motors()) return {};
  return servo::words_of(stroke.status(), text_of(find_command("wheel.rearm")->chord));
}

bool ViewModel::waits_for_rearm() const {
  return stroke.throwing() && stroke.has_motors() && servo::waits_for_rearm(stroke.status());
}

void report(AppState& state, const Error& error) {
  state.log("error: " + error.message);
  state.last_error = error;
  state.ui.notices.show(Grade::error, error.message);
}

bool succeeded(AppState& state, const Result<void>& result) {
  if (!result) report(state, result.error());
  return result.has_value();
}

void show_present(AppState& state) {
  state.stroke.release();
  if (!state.document.scrubbing()) return;
  (void)succeeded(state, state.document.show_present());
  state.stroke.resume();
}

void note(AppState& state, Grade grade, std::string text, double seconds) {
  state.ui.notices.show(grade, std::move(text), state.now_s() + seconds);
}

}  // namespace clay::studio
