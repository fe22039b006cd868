// Facts that scripts query.

#include "app/studio/script_facts.hpp"
#include "app/studio/panels/panels.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace clay::studio {
namespace {

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

/// In the order of the alternatives of Dialog.
const char* name_of(const Dialog& dialog) {
  constexpr std::array<const char*, std::variant_size_v<Dialog>> kNames = {
      "none",   "gallery",  "shortcuts", "quit",    "open",    "save", "export",
      "import", "settings", "replace",   "picture", "discard", "works"};
  return kNames[dialog.index()];
}

/// Place of the tool in the section plane; between strokes that of the pointer.
std::string place_text(const AppState& state, double (*part)(glm::dvec2)) {
  const auto& status = state.stroke.status();
  const auto place = state.stroke.throwing() && status.ticks > 0
                         ? std::optional(state.scene.in_section(status.tool_mm))
                         : state.scene.pointed_mm();
  return place ? nine_digit_text(part(*place)) : std::string();
}

struct Fact {
  std::string_view name;
  std::string (*read)(const AppState&);
};

const std::array kFacts = {
    Fact{"overlay", [](const AppState& s) { return std::string(name_of(s.ui.dialog)); }},
    Fact{"throwing", [](const AppState& s) { return yes_or_no(s.stroke.throwing()); }},
    Fact{"contact", [](const AppState& s) { return yes_or_no(s.stroke.status().contact); }},
    Fact{"paused", [](const AppState& s) { return yes_or_no(s.stroke.paused()); }},
    Fact{"unsaved", [](const AppState& s) { return yes_or_no(s.document.unsaved()); }},
    Fact{"can_undo", [](const AppState& s) { return yes_or_no(s.document.can_undo()); }},
    Fact{"can_redo", [](const AppState& s) { return yes_or_no(s.document.can_redo()); }},
    Fact{"tool_mm",
         [](const AppState& s) {
           const auto size = size_mm(s.settings.tool);
           return size ? nine_digit_text(*size) : std::string();
         }},
    Fact{"stiffness",
         [](const AppState& s) {
           return s.document.has_work() && s.document.scene().force
                      ? nine_digit_text(s.document.scene().force->stiffness_n_per_mm2)
                      : std::string();
         }},
    Fact{"strokes",
         [](const AppState& s) {
           return fmt::format("{}", s.document.has_work() ? s.document.work().size() - 1 : 0);
         }},
    Fact{"node",
         [](const AppState& s) {
           return fmt::format("{}", s.document.has_work() ? s.document.work().at() : 0);
         }},
    Fact{"scrubbing", [](const AppState& s) { return yes_or_no(s.document.scrubbing()); }},
    Fact{"falling", [](const AppState& s) { return yes_or_no(s.fall.running()); }},
    Fact{"fallen",
         [](const AppState& s) {
           return yes_or_no(s.document.has_work() && s.document.pot().collapse.has_value());
         }},
    Fact{"marks",
         [](const AppState& s) {
           return fmt::format("{}", s.document.has_work() && s.ui.marked == s.document.shared_pot()
                                        ? s.ui.marks.size()
                                        : 0);
         }},
    Fact{"triangles",
         [](const AppState& s) {
           return fmt::format("{}", s.ui.exporting.preview ? s.ui.exporting.preview->triangles : 0);
         }},
    Fact{"exported",
         [](const AppState& s) { return fmt::format("{}", s.ui.exporting.written.size()); }},
    Fact{"problem",
         [](const AppState& s) {
           const auto* import = std::get_if<ImportDialog>(&s.ui.dialog);
           if (import != nullptr) return import->problem;
           return s.ui.shows<PictureDialog>() ? s.ui.pictures.problem : s.ui.exporting.problem;
         }},
    Fact{"closed", [](const AppState& s) { return yes_or_no(s.done); }},
    Fact{"gamepad",
         [](const AppState& s) { return s.gamepad.name().empty() ? "none" : s.gamepad.name(); }},
    Fact{"strength",
         [](const AppState& s) {
           return s.stroke.throwing() && s.scene.strength() ? nine_digit_text(*s.scene.strength())
                                                            : std::string("none");
         }},
    Fact{"pull_mm", [](const AppState& s) { return nine_digit_text(s.stroke.stretch_mm()); }},
    Fact{"gap_mm", [](const AppState& s) { return nine_digit_text(s.stroke.status().gap_mm); }},
    Fact{"tool_rho_mm",
         [](const AppState& s) { return place_text(s, [](glm::dvec2 at) { return at.x; }); }},
    Fact{"tool_y_mm",
         [](const AppState& s) { return place_text(s, [](glm::dvec2 at) { return at.y; }); }},
    Fact{"azimuth_deg",
         [](const AppState& s) {
           return nine_digit_text(glm::degrees(s.scene.camera().azimuth_rad));
         }},
    Fact{"distance_mm",
         [](const AppState& s) { return nine_digit_text(s.scene.camera().distance_mm); }},
    Fact{"device", [](const AppState& s) { return s.stroke.device_name(); }},
    Fact{"force",
         [](const AppState& s) { return s.ui.arm.guard.empty() ? "none" : s.ui.arm.guard; }},
    Fact{"process",
         [](const AppState& s) {
           return s.ui.shows<ExportDialog>() ? s.ui.exporting.choices.process : s.settings.process;
         }},
    Fact{"banner",
         [](const AppState& s) {
           return s.ui.notices.shown() ? s.ui.notices.shown()->text : std::string();
         }},
    Fact{"height_mm", [](const AppState& s) { return nine_digit_text(s.stroke.view().height_mm); }},
    Fact{"force_n",
         [](const AppState& s) { return nine_digit_text(glm::length(s.stroke.status().clay_n)); }},
    Fact{"volume_error",
         [](const AppState& s) { return fmt::format("{}", s.stroke.status().volume_error); }},
    Fact{"poses", [](const AppState& s) { return fmt::format("{}", s.stroke.status().poses); }},
    Fact{"proved",
         [](const AppState& s) {
           return yes_or_no(s.readings.check() && s.readings.check()->proved);
         }},
    Fact{"thin",
         [](const AppState& s) {
           return yes_or_no(s.readings.check() && s.readings.check()->thin());
         }},
    Fact{"ready",
         [](const AppState& s) {
           return yes_or_no(s.readings.check() && s.readings.check()->ready());
         }},
    Fact{"verdict",
         [](const AppState& s) { return verdict_text(s.document, s.readings, s.settings.unit); }},
    Fact{"goal",
         [](const AppState& s) {
           const auto& check = s.readings.check();
           return check && check->maker
                      ? read_goal(s.settings.goal, *check->maker, s.settings.unit).text
                      : std::string();
         }},
    Fact{"off_target_mm",
         [](const AppState& s) {
           const auto& check = s.readings.check();
           return check && check->off ? nine_digit_text(check->off->mm) : std::string();
         }},
    Fact{"step",
         [](const AppState& s) {
           return !s.guide.active()    ? "none"
                  : s.guide.finished() ? "finished"
                                       : s.guide.stroke(s.guide.step()).name;
         }},
    Fact{"thinnest_mm",
         [](const AppState& s) {
           return s.readings.check() ? nine_digit_text(s.readings.check()->thinnest_mm)
                                     : std::string();
         }},
    Fact{"stress_part",
         [](const AppState& s) {
           return nine_digit_text(s.readings.stress().part().value_or(0.0));
         }},
    Fact{"plotted_ticks",
         [](const AppState& s) { return fmt::format("{}", s.readings.ticks().samples().size()); }},
    Fact{"missed", [](const AppState& s) { return fmt::format("{}", s.stroke.status().missed); }},
};

}  // namespace

std::optional<std::string> fact(const AppState& state, std::string_view name) {
  const auto* found = std::ranges::find(kFacts, name, &Fact::name);
  if (found == kFacts.end()) return std::nullopt;
  return found->read(state);
}

std::vector<std::string_view> fact_names() {
  std::vector<std::string_view> names;
  for (const Fact& one : kFacts) names.push_back(one.name);
  return names;
}

}  // namespace clay::studio
