#include "app/web/pot_text.hpp"

#include <fmt/format.h>

namespace clay::web {
namespace {

using studio::length_text;

struct Report {
  std::string text;
  void section(std::string_view title) {
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", title);
  }
  void line(std::string_view text_of_line) { text += fmt::format("  {}\n", text_of_line); }
  void row(std::string_view name, const std::string& value) {
    text += fmt::format("  {}: {}\n", name, value);
  }
};

void add_pot(Report& report, const studio::AppState& state) {
  const studio::LengthUnit unit = state.settings.unit;
  report.section("Pot");
  report.row("Name", state.document.name());
  report.row("Saved", state.document.unsaved() ? "no" : "yes");
  report.row("Strokes", fmt::format("{}", state.document.work().size() - 1));
  report.row("Height", length_text(state.stroke.view().height_mm, unit));
  report.row("Largest diameter", length_text(state.readings.diameter_mm(), unit));
  report.row("Weight", studio::mass_text(state.readings.account().in_stack_g));
  if (!state.readings.fallen())
    report.row("Capacity to the brim", studio::capacity_text(state.readings.capacity_mm3()));
}

void add_check(Report& report, const studio::PotCheck& check, studio::LengthUnit unit) {
  report.section("Walls");
  report.line(studio::wall_text(check, unit));
  for (const studio::Stretch& thin : thin_stretches(check))
    report.line(fmt::format("Too thin at heights from {} to {}", length_text(thin.from_mm, unit),
                            length_text(thin.to_mm, unit)));
  report.section("Certificate");
  report.line(check.proved ? "Proved: one closed solid" : "Not proved: " + check.why_not);
  if (check.proved) {
    report.row("Triangles", fmt::format("{}", check.triangles));
    report.row("Tolerance", fmt::format("{:g} mm", check.tolerance_mm));
    if (!check.fallen) report.row("Proved minimum wall", length_text(check.least_wall_mm, unit));
    report.row("Clay volume", fmt::format("{:.3f} ml", 1e-3 * check.counted_mm3));
    report.row("Volume of the solid", fmt::format("{:.3f} ml", 1e-3 * check.proved_mm3));
  }
  for (const studio::PotRemark& remark : check.remarks)
    report.line(fmt::format("At {}: {}", length_text(remark.from_mm, unit), remark.text));
}

void add_clay(Report& report, const studio::ClayAccount& account) {
  report.section("Clay balance");
  report.row("At the start", studio::mass_text(account.initial_g));
  report.row("Added", studio::mass_text(account.added_g));
  report.row("In the pot", studio::mass_text(account.in_stack_g));
  report.row("Trimmed", studio::mass_text(account.trimmed_g));
  report.row("Unaccounted for", account.unaccounted);
}

/// Instruction for the present step of a lesson; empty without a lesson.
std::string step_text(const studio::Guide& guide) {
  if (!guide.active()) return {};
  if (guide.finished()) return "The lesson is done";
  const strokes::Stroke& stroke = guide.stroke(guide.step());
  return fmt::format("Step {} of {}: {}. {}", guide.step() + 1, guide.steps(), stroke.name,
                     stroke.hint);
}

void add_lesson(Report& report, const studio::AppState& state) {
  if (!state.guide.active()) return;
  report.section(fmt::format("Lesson: {}", state.guide.title()));
  report.line(step_text(state.guide));
}

}  // namespace

std::optional<std::string> summary_of(const studio::AppState& state) {
  if (state.ui.notices.shown()) return state.ui.notices.shown()->text;
  if (!state.document.has_work() || state.readings.stack() == nullptr)
    return "No clay on the wheel";
  const auto& check = state.readings.check();
  if (state.stroke.throwing() || state.readings.checking() || state.readings.live() ||
      state.guide.demonstration() != studio::Demonstration::none || !check)
    return std::nullopt;
  const studio::LengthUnit unit = state.settings.unit;
  const std::string step = step_text(state.guide);
  return fmt::format(
      "{}: {} high, {} wide, {}. {}{}{}", state.document.name(),
      length_text(state.stroke.view().height_mm, unit),
      length_text(state.readings.diameter_mm(), unit),
      studio::mass_text(state.readings.account().in_stack_g),
      state.readings.fallen() ? "Fallen: undo removes the last stroke" : ready_text(*check, unit),
      step.empty() ? "" : ". ", step);
}

std::string report_of(const studio::AppState& state) {
  if (!state.document.has_work() || state.readings.stack() == nullptr)
    return "No clay on the wheel\n";
  Report report;
  add_lesson(report, state);
  add_pot(report, state);
  if (state.readings.check()) add_check(report, *state.readings.check(), state.settings.unit);
  add_clay(report, state.readings.account());
  return report.text;
}

}  // namespace clay::web
