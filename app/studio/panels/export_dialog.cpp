// The export dialog: choices, preview and results.

#include "app/studio/commands.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

/// Boxes in columns, the same for every row: in one line, or in lines of equal length.
class BoxRow {
 public:
  explicit BoxRow(const char* label) {
    form_row(label);
    left_ = ImGui::GetCursorPosX();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room = ImGui::GetContentRegionAvail().x;
    const float least = ImGui::GetFrameHeight() + ImGui::CalcTextSize("Report").x +
                        style.ItemInnerSpacing.x + 0.5f * style.ItemSpacing.x;
    const int fitting = std::clamp(static_cast<int>(room / least), 1, kBoxes);
    const int lines = (kBoxes + fitting - 1) / fitting;
    columns_ = (kBoxes + lines - 1) / lines;
    pitch_ = room / static_cast<float>(columns_);
  }
  bool box(const char* title, bool& wanted) {
    const int column = count_ % columns_;
    if (column > 0)
      ImGui::SameLine(left_ + pitch_ * static_cast<float>(column));
    else if (count_ > 0)
      ImGui::SetCursorPosX(left_);
    ++count_;
    return ImGui::Checkbox(title, &wanted);
  }

 private:
  static constexpr int kBoxes = 6;  // at most, of a row
  float left_ = 0.0f, pitch_ = 0.0f;
  int columns_ = 1, count_ = 0;
};

/// A box for each ending that can be written, in the order of the table of formats.
void draw_meshes(ExportChoices& choices) {
  BoxRow row("Meshes");
  std::string_view last_ending;
  for (const solid::FormatFacts& facts : solid::kFormatFacts) {
    if (!facts.written || facts.ending == last_ending) continue;
    last_ending = facts.ending;
    const auto at = std::ranges::find(choices.meshes, facts.format);
    bool wanted = at != choices.meshes.end();
    if (!row.box(std::string(facts.title).c_str(), wanted)) continue;
    if (wanted)
      choices.meshes.insert(std::ranges::lower_bound(choices.meshes, facts.format), facts.format);
    else
      choices.meshes.erase(at);
  }
}

/// Each function edits its own part of `choices`.
void draw_formats(const ViewModel& model, ExportChoices& choices) {
  draw_meshes(choices);
  BoxRow also("Other files");
  also.box("STEP", choices.step);
  also.box("SVG", choices.section);
  also.box("DXF", choices.dxf);
  if (!kInPage) also.box("PDF", choices.pdf);
  also.box("Pot", choices.pot);
  if (!kInPage) also.box("Report", choices.report);
  if (kInPage) faint_text(model.colours(), "PDF and the report need the native program.");
  if (std::ranges::find(choices.meshes, solid::MeshFormat::glb) == choices.meshes.end()) return;
  form_row("Surface of the GLB");
  const Material* shown = find_material(choices.material);
  if (const Material* chosen = choose_material(shown != nullptr ? *shown : kWet))
    choices.material = chosen->id;
}

/// Shows the usual length until another one is chosen.
void choose_smooth_length(const Pot& pot, LengthUnit unit, ExportChoices& choices) {
  std::optional<double>& length_mm = choices.smooth_length_mm;
  double shown_mm =
      length_mm ? *length_mm : solid::usual_smooth_length_mm(pot, choices.tolerance_mm);
  if (form_length("Smoothing length", shown_mm, 0.0, kLongestFairingMm, unit, "none"))
    length_mm = shown_mm;
  tip("Marks that are shorter along the height are smoothed away.");
}

/// Tenths of a millimetre, as shown, so that the command line gives the same file.
void choose_tenths(const char* label, double& mm, double low_mm, double high_mm, LengthUnit unit,
                   const char* none) {
  if (form_length(label, mm, low_mm, high_mm, unit, none)) mm = std::round(10.0 * mm) / 10.0;
}

/// The cuts and fillets after throwing; none at first.
void draw_finish(const ViewModel& model, ExportChoices& choices) {
  const LengthUnit unit = model.settings.unit;
  choose_tenths("Foot ring width", choices.foot_width_mm, 0.0, kWidestFootMm, unit, "none");
  tip("The width of a ring on which the pot stands. Inside it the foot is cut away.");
  if (choices.foot_width_mm > 0.0)
    choose_tenths("Depth of the foot", choices.foot_depth_mm, 0.1, kDeepestFootMm, unit, nullptr);
  choose_tenths("Fillet at the floor", choices.floor_fillet_mm, 0.0, kLargestFilletMm, unit,
                "none");
  tip("The radius where wall and floor meet inside, filled with clay.");
  choose_tenths("Fillet at the lip", choices.lip_fillet_mm, 0.0, kLargestFilletMm, unit,
                choices.process.empty() ? "none" : "by the process");
  choose_tenths("Glaze allowance", choices.glaze_mm, 0.0, kThickestGlazeMm, unit, "none");
  tip("The thickness of the fired glaze. Every face except the foot is set back by it.");
  const auto& preview = model.ui.exporting.preview;
  if (!(choices.drain_mm > 0.0) && !(preview && preview->closed_cavity)) return;
  choose_tenths("Drain hole", choices.drain_mm, 0.0, kWidestDrainMm, unit, "none");
  tip("The diameter of a hole through the foot that opens the closed cavity.");
}

/// Begins with the goal of the panel, or with the size of the pot.
void begin_size(const ViewModel& model, ExportChoices& choices) {
  const PotGoal& goal = model.settings.goal;
  const auto& preview = model.ui.exporting.preview;
  const auto begin = [](double& value, double wanted, double present) {
    if (wanted > 0.0 || present > 0.0) value = std::round(wanted > 0.0 ? wanted : present);
  };
  const ExportFigures present = preview.value_or(ExportFigures{});
  const double fired = 1.0 - present.shrinkage;
  if (choices.size == ExportSize::capacity)
    begin(choices.holds_ml, goal.holds_ml, present.capacity_ml);
  if (choices.size == ExportSize::weight) begin(choices.weighs_g, 0.0, present.weight_g);
  if (choices.size == ExportSize::height)
    begin(choices.height_mm, goal.height_mm, fired * present.height_mm);
  if (choices.size == ExportSize::diameter)
    begin(choices.diameter_mm, goal.diameter_mm, fired * present.diameter_mm);
}

/// Scales the pot, in whole millimetres, millilitres or grams, as shown.
void draw_size(const ViewModel& model, ExportChoices& choices) {
  constexpr std::array kTitles = {"As thrown", "Capacity", "Weight", "Height", "Diameter"};
  constexpr double kLeastMm = 10.0, kLeastMl = 10.0, kLeastG = 10.0;
  form_row("Scale to");
  if (const int chosen = choice_row("##size", kTitles, static_cast<int>(choices.size));
      chosen >= 0) {
    choices.size = static_cast<ExportSize>(chosen);
    begin_size(model, choices);
  }
  tip("The finished pot has this capacity, weight or size: fired, if a shrinkage is set.");
  const auto length = [&](const char* label, double& mm) {
    if (form_length(label, mm, kLeastMm, kMostGoalMm, model.settings.unit)) mm = std::round(mm);
  };
  if (choices.size == ExportSize::height) length("Height", choices.height_mm);
  if (choices.size == ExportSize::diameter) length("Diameter", choices.diameter_mm);
  const auto amount = [](const char* label, double& value, double least, double most,
                         const std::string& text, const ValueUnits& units) {
    float shown = static_cast<float>(value);
    if (form_slider(label, shown, static_cast<float>(least), static_cast<float>(most), text, units,
                    ImGuiSliderFlags_Logarithmic))
      value = std::round(static_cast<double>(shown));
  };
  if (choices.size == ExportSize::capacity)
    amount("Capacity", choices.holds_ml, kLeastMl, kMostGoalMl,
           capacity_text(1e3 * choices.holds_ml), kVolumes);
  if (choices.size == ExportSize::weight)
    amount("Weight", choices.weighs_g, kLeastG, kMostGoalG, mass_text(choices.weighs_g), kWeights);
}

void draw_choices(const ViewModel& model, ExportChoices& choices, Actions& actions) {
  const LengthUnit unit = model.settings.unit;
  form_length("Tolerance", choices.tolerance_mm, kFinestMm, kCoarsestMm, unit);
  tip("The largest distance between the triangles and the smooth pot.");
  constexpr std::array kSmooth = {solid::Smoothing::fair, solid::Smoothing::exact,
                                  solid::Smoothing::none};
  constexpr std::array kSmoothTitles = {"Fair", "Exact", "None"};
  const auto smooth =
      static_cast<int>(std::ranges::find(kSmooth, choices.smoothing) - kSmooth.begin());
  form_row("Smoothing");
  if (const int chosen = choice_row("##smooth", kSmoothTitles, smooth); chosen >= 0)
    choices.smoothing = kSmooth[static_cast<std::size_t>(chosen)];
  tip("Fair: smooth walls. Exact: keeps the volume of every ring. None: keeps the steps.");
  if (choices.smoothing == solid::Smoothing::fair && !model.document.pot().collapse)
    choose_smooth_length(model.document.pot(), unit, choices);
  form_row("Process");
  (void)choose_process(model, "None", choices.process, actions);
  form_length("Minimum wall", choices.min_wall_mm, 0.0, kThickestDemandMm, unit,
              choices.process.empty() ? "no limit" : "by the process");
  float percent = static_cast<float>(choices.shrinkage_percent);
  if (form_slider("Shrinkage", percent, 0.0f, static_cast<float>(kMostShrinkagePercent),
                  percent > 0.0f ? fmt::format("{:.1f} %", percent) : "none", kPercent))
    // Rounded to tenths, as shown, so that the command line gives the same file for the same
    // number.
    choices.shrinkage_percent = std::round(10.0 * static_cast<double>(percent)) / 10.0;
  tip("How much shorter each length becomes in drying and firing. The file is enlarged to "
      "compensate.");
  if (model.document.pot().collapse) return;
  draw_size(model, choices);
  draw_finish(model, choices);
}

std::string size_text(const ExportFigures& figures, double factor, LengthUnit unit) {
  return fmt::format("{} wide, {} high", length_text(factor * figures.diameter_mm, unit),
                     length_text(factor * figures.height_mm, unit));
}

void draw_figures(const ViewModel& model, const ExportFigures& figures) {
  const Palette& colours = model.colours();
  const LengthUnit unit = model.settings.unit;
  value_row(colours, "Triangles", fmt::format("{}", figures.triangles));
  for (const ExportFigures::Mesh& mesh : figures.meshes)
    value_row(colours, std::string(solid::facts_of(mesh.format).title).c_str(),
              fmt::format("{:.3f} MB", 1e-6 * static_cast<double>(mesh.bytes)));
  value_row(colours, "Size in the file", size_text(figures, 1.0, unit));
  if (figures.shrinkage > 0.0)
    value_row(colours, "Fired size", size_text(figures, 1.0 - figures.shrinkage, unit));
  if (figures.capacity_ml > 0.0)
    value_row(
        colours, "Capacity to the brim",
        capacity_text(1e3 * figures.capacity_ml) + (figures.shrinkage > 0.0 ? ", fired" : ""));
  if (figures.weight_g > 0.0)
    value_row(colours, "Weight",
              mass_text(figures.weight_g) + (figures.shrinkage > 0.0 ? ", fired" : ""));
  if (!figures.fallen)
    value_row(colours, "Thinnest wall",
              length_text(figures.thinnest_mm, unit, 1) +
                  (figures.thinnest_in_floor
                       ? ", in the floor"
                       : ", at a height of " + length_text(figures.thinnest_at_mm, unit)));
  if (figures.faired_mm > 0.0)
    value_row(colours, "Walls moved by",
              fmt::format("at most {}, at a height of {}", length_text(figures.moved_mm, unit, 1),
                          length_text(figures.moved_at_mm, unit)));
}

/// Progress, problems and figures, or the reason why there are none.
void draw_preview(const ViewModel& model) {
  const ExportState& exporting = model.ui.exporting;
  const bool running = model.export_running.has_value();
  if (model.writing())
    faint_text(model.colours(), "Writing: " + model.export_stage);
  else if (!exporting.problem.empty())
    wrapped_text(exporting.problem, model.colours().fault);
  else if (running)
    faint_text(model.colours(), "Computing: " + model.export_stage);
  else if (!exporting.preview)
    faint_text(model.colours(), "No mesh file is chosen");
  if (!exporting.preview || !exporting.problem.empty()) return;
  const std::vector<std::string>& problems = exporting.preview->problems;  // failed limits first
  for (std::size_t i = 0; i < problems.size(); ++i)
    problem_text(problems[i],
                 i < exporting.preview->failed ? model.colours().fault : model.colours().warning);
  draw_figures(model, *exporting.preview);
}

std::string replaced_text(const ExportChoices& choices) {
  const std::vector<std::string> standing = standing_files(choices);
  if (standing.empty()) return "No file will be replaced";
  return (standing.size() == 1 ? std::filesystem::path(standing.front()).filename().string()
                               : fmt::format("{} files", standing.size())) +
         " will be replaced";
}

/// The outcome, or the reason why no export is possible, or its preview.
void draw_outcome(const ViewModel& model) {
  const ExportState& exporting = model.ui.exporting;
  const Palette& colours = model.colours();
  const char* why_not = find_command("export.write")->why_not(model);
  if (model.writing()) return faint_text(colours, "Writing the files");
  if (why_not != nullptr) return wrapped_text(sentence(why_not), colours.warning);
  if (!exporting.result.empty())
    return wrapped_text(exporting.result, exporting.written.empty()
                                              ? ImGui::GetStyleColorVec4(ImGuiCol_Text)
                                          : exporting.grade == Grade::note ? colours.good
                                                                           : colours.warning);
  if (exporting.preview && exporting.preview->failed > 0)
    return wrapped_text(
        failed_text(exporting.preview->failed) + ". " + replaced_text(exporting.choices),
        colours.warning);
  faint_text(colours, replaced_text(exporting.choices));
}

void draw_buttons(const ViewModel& model, Actions& actions) {
  const ExportState& exporting = model.ui.exporting;
  draw_outcome(model);
  if (model.writing()) {
    if (ImGui::Button("Cancel")) actions.emplace_back(RunCommand{"export.cancel"});
  } else {
    const Command& write = *find_command("export.write");
    if (main_button("Export (Ctrl+Enter)", model.colours(), write.enabled(model)))
      actions.emplace_back(RunCommand{write.id});
    if (!exporting.written.empty() && !kInPage) {
      same_line_if_room("Open folder");
      if (ImGui::Button("Open folder")) actions.emplace_back(RunCommand{"export.folder"});
    }
    same_line_if_room("Close (Esc)");
    if (ImGui::Button("Close (Esc)")) actions.emplace_back(CloseDialog{});
  }
}

}  // namespace

void draw(const ExportDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect) {
  constexpr float kBesideEm = 67.0f, kBelowEm = 44.0f, kLeastBesideEm = 54.0f, kPreviewEm = 22.0f;
  constexpr float kUsualHeightEm = 43.0f;
  const float em = ImGui::GetFontSize();
  // In a narrow window the preview is the end of the list.
  const bool beside = ImGui::GetIO().DisplaySize.x >= kLeastBesideEm * em;
  begin_dialog("##export", rect, beside ? kBesideEm : kBelowEm, beside ? kUsualHeightEm : 0.0f);
  dialog_title(model, "Export");
  begin_body(rect, beside ? -kPreviewEm * em : 0.0f);
  ExportChoices choices = model.ui.exporting.choices;
  draw_formats(model, choices);
  form_place(choices.name, choices.folder, actions);
  draw_choices(model, choices, actions);
  if (choices != model.ui.exporting.choices) actions.emplace_back(EditExport{choices});
  ImGui::Spacing();
  if (!beside) draw_preview(model);
  end_body();
  if (beside) {
    const float height = ImGui::GetItemRectSize().y;
    ImGui::SameLine();
    ImGui::BeginChild("##preview", {0.0f, height}, true, ImGuiWindowFlags_NavFlattened);
    draw_preview(model);
    ImGui::EndChild();
  }
  draw_buttons(model, actions);
  ImGui::End();
}

}  // namespace clay::studio
