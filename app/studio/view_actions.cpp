// Actions on the view and the settings.

#include "app/studio/performer.hpp"

#include "app/studio/panels/panels.hpp"

#include <algorithm>
#include <string>

namespace clay::studio {

void Performer::operator()(const LookFrom& look) const { show_from(look.from); }

void Performer::operator()(const Zoom& zoom) const { state.scene.zoom(zoom.notches); }

void Performer::operator()(const ToggleCut& toggle) const {
  state.scene.cut = state.scene.cut == toggle.cut ? render::Cut::none : toggle.cut;
}

void Performer::operator()(const TogglePanel& toggle) const {
  const bool open = !panel_open(state.settings, state.ui, toggle.id);
  state.settings.open[std::string(toggle.id)] = open;
  if (open && in_diagnostics(toggle.id))
    state.settings.open[kDiagnostics] = true;
  else if (open)
    show_context();
  state.ui.reveal = open ? toggle.id : std::string_view();
}

void Performer::operator()(const ToggleDiagnostics&) const {
  state.settings.open[kDiagnostics] = !diagnostics_open(state.settings);
}

void Performer::operator()(const NextColumn&) const {
  std::optional<Column>& keys_in = state.ui.keys_in;
  const bool diagnostics = diagnostics_open(state.settings);
  if (!keys_in)
    keys_in = diagnostics && !state.ui.context_shown ? Column::diagnostics : Column::context;
  else if (keys_in == Column::context && diagnostics)
    keys_in = Column::diagnostics;
  else
    keys_in.reset();
  if (keys_in == Column::context) show_context();
  state.ui.focus_column = keys_in.has_value();
}

void Performer::operator()(const FoldPanel& fold) const {
  state.settings.open[std::string(fold.id)] = fold.open;
  state.ui.reveal = fold.open ? fold.id : std::string_view();
}

void Performer::operator()(const ToggleTheme&) const {
  (*this)(SetTheme{state.settings.theme == Theme::dark ? Theme::light : Theme::dark});
}

void Performer::operator()(const ScaleText& scale) const {
  (*this)(SetScale{std::clamp(state.settings.scale * scale.factor, kSmallestScale, kLargestScale)});
}

void Performer::operator()(const SetProcess& set) const {
  state.settings.process = set.value;
  ExportChoices choices = state.ui.exporting.choices;
  choices.process = set.value;
  choose_export(choices);
}

void Performer::operator()(const SetTheme& set) const {
  state.settings.theme = set.value;
  state.settings.theme_chosen = true;
  state.ui.restyle = true;
}

void Performer::operator()(const SetScale& set) const {
  state.settings.scale = set.value;
  state.ui.restyle = true;
}

void Performer::show_context() const {
  if (state.ui.context_shown) return;
  state.settings.open[kDiagnostics] = false;  // the diagnostics are in the place of the context
  state.settings.open[kBelow] = true;
}

void Performer::show_from(ViewFrom from) const {
  const render::PotView& pot = state.stroke.view();
  const Target* target = state.ui.target.get();
  state.scene.look(target != nullptr && target->view.height_mm > pot.height_mm ? target->view : pot,
                   from);
}

}  // namespace clay::studio
