#include "app/studio/facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace clay::studio {
namespace {

std::string yes_or_no(bool value) { return value ? "yes" : "no"; }

const char* name_of(Overlay overlay) {
  constexpr std::array kNames = {"none", "gallery", "shortcuts", "quit",    "open",
                                 "save", "export",  "import",    "settings"};
  return kNames[static_cast<std::size_t>(overlay)];
}

struct Fact {
  std::string_view name;
  std::string (*tell)(const AppState&);
};

const std::array kFacts = {
    Fact{"overlay", [](const AppState& s) { return std::string(name_of(s.overlay)); }},
    Fact{"throwing", [](const AppState& s) { return yes_or_no(s.potter.throwing()); }},
    Fact{"contact", [](const AppState& s) { return yes_or_no(s.potter.status().contact); }},
    Fact{"paused", [](const AppState& s) { return yes_or_no(s.potter.paused()); }},
    Fact{"unsaved", [](const AppState& s) { return yes_or_no(s.potter.unsaved()); }},
    Fact{"can_undo", [](const AppState& s) { return yes_or_no(s.potter.can_undo()); }},
    Fact{"can_redo", [](const AppState& s) { return yes_or_no(s.potter.can_redo()); }},
    Fact{"tool_mm",
         [](const AppState& s) {
           const auto size = size_mm(s.settings.tool);
           return size ? fmt::format("{}", *size) : std::string();
         }},
    Fact{"stiffness",
         [](const AppState& s) {
           return s.potter.has_work() && s.potter.scene().force
                      ? fmt::format("{}", s.potter.scene().force->stiffness_n_per_mm2)
                      : std::string();
         }},
    Fact{"strokes",
         [](const AppState& s) {
           return fmt::format("{}", s.potter.has_work() ? s.potter.work().size() - 1 : 0);
         }},
    Fact{"node",
         [](const AppState& s) {
           return fmt::format("{}", s.potter.has_work() ? s.potter.work().at() : 0);
         }},
    Fact{"scrubbing", [](const AppState& s) { return yes_or_no(s.potter.scrubbing()); }},
    Fact{"falling", [](const AppState& s) { return yes_or_no(s.fall.running()); }},
    Fact{"fallen",
         [](const AppState& s) {
           return yes_or_no(s.potter.has_work() && s.potter.pot().collapse.has_value());
         }},
    Fact{"marks",
         [](const AppState& s) {
           return fmt::format(
               "{}", s.potter.has_work() && s.marked == s.potter.shared_pot() ? s.marks.size() : 0);
         }},
    Fact{"triangles",
         [](const AppState& s) {
           return fmt::format("{}", s.exporting.shown ? s.exporting.shown->size.triangles : 0);
         }},
    Fact{"exported",
         [](const AppState& s) { return fmt::format("{}", s.exporting.written.size()); }},
    Fact{"problem",
         [](const AppState& s) {
           return s.overlay == Overlay::import_drawing ? s.importing.problem : s.exporting.problem;
         }},
    Fact{"closed", [](const AppState& s) { return yes_or_no(s.done); }},
    Fact{"device", [](const AppState& s) { return s.potter.device_name(); }},
    Fact{"force", [](const AppState& s) { return s.hand_is.empty() ? "none" : s.hand_is; }},
    Fact{"process",
         [](const AppState& s) {
           return s.overlay == Overlay::export_files ? s.exporting.wish.process
                                                     : s.settings.process;
         }},
    Fact{"banner",
         [](const AppState& s) {
           return s.notices.shown() ? s.notices.shown()->text : std::string();
         }},
    Fact{"height_mm",
         [](const AppState& s) { return fmt::format("{}", s.potter.view().height_mm); }},
    Fact{
        "force_n",
        [](const AppState& s) { return fmt::format("{}", glm::length(s.potter.status().clay_n)); }},
    Fact{"volume_error",
         [](const AppState& s) { return fmt::format("{}", s.potter.status().volume_error); }},
    Fact{"poses", [](const AppState& s) { return fmt::format("{}", s.potter.status().poses); }},
    Fact{"proved",
         [](const AppState& s) {
           return yes_or_no(s.readings.check() && s.readings.check()->proved);
         }},
    Fact{"thin",
         [](const AppState& s) {
           return yes_or_no(s.readings.check() && s.readings.check()->thin());
         }},
    Fact{"thinnest_mm",
         [](const AppState& s) {
           return s.readings.check() ? fmt::format("{}", s.readings.check()->thinnest_mm)
                                     : std::string();
         }},
    Fact{"stress_part",
         [](const AppState& s) {
           return fmt::format("{}", s.readings.stress().part().value_or(0.0));
         }},
    Fact{"plotted_ticks",
         [](const AppState& s) { return fmt::format("{}", s.readings.ticks().samples().size()); }},
    Fact{"missed", [](const AppState& s) { return fmt::format("{}", s.potter.status().missed); }},
};

}  // namespace

std::optional<std::string> fact(const AppState& shop, std::string_view name) {
  const auto* found = std::ranges::find(kFacts, name, &Fact::name);
  if (found == kFacts.end()) return std::nullopt;
  return found->tell(shop);
}

}  // namespace clay::studio
