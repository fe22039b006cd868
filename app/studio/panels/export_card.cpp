// What an export would write, and what it has written.

#include "app/studio/actions.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

void act(AppState& shop, const char* id) { run(*find_action(id), shop); }

void draw_formats(ExportWish& wish) {
  form_row("Files");
  const std::array boxes = {std::pair{"STL", &wish.stl}, std::pair{"OBJ", &wish.obj},
                            std::pair{"Draco", &wish.drc}, std::pair{"Section", &wish.section},
                            std::pair{"Pot", &wish.pot}};
  bool first = true;
  for (const auto& [title, wanted] : boxes) {
    if (!first) ImGui::SameLine();
    ImGui::Checkbox(title, wanted);
    first = false;
  }
}

void draw_places(AppState& shop, ExportWish& wish) {
  form_row("Name");
  ImGui::InputText("##name", &wish.name);
  form_row("Folder");
  const float button = ImGui::CalcTextSize("Choose...").x + 3.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputText("##folder", &wish.folder);
  ImGui::SameLine();
  if (ImGui::Button("Choose...") &&
      !(shop.host.real_time() &&
        shop.dialog.begin(FileDialog::Kind::folder, std::filesystem::path(wish.folder) / "")))
    shop.notices.say(Grade::warning,
                     "No file dialog is installed (zenity, kdialog): type the folder",
                     1e-9 * static_cast<double>(shop.host.frame_ns()) + 5.0);
}

void draw_choices(AppState& shop, ExportWish& wish) {
  const Palette& colours = shop.colours();
  form_length("Tolerance", wish.tolerance_mm, kFinestMm, kCoarsestMm, LengthUnit::mm);
  constexpr std::array kSmooth = {solid::Smoothing::fair, solid::Smoothing::exact,
                                  solid::Smoothing::none};
  constexpr std::array kSmoothTitles = {"Fair", "Exact", "As thrown"};
  const auto smooth =
      static_cast<int>(std::ranges::find(kSmooth, wish.smoothing) - kSmooth.begin());
  form_row("Walls");
  if (const int chosen = choice_row("##smooth", kSmoothTitles, smooth, colours); chosen >= 0)
    wish.smoothing = kSmooth[static_cast<std::size_t>(chosen)];
  form_row("Process");
  choose_process(shop, "Not said", wish.process);
  form_length("Minimum wall", wish.min_wall_mm, 0.0, kThickestDemandMm, shop.settings.unit,
              wish.process.empty() ? "not asked" : "as the process asks");
  form_row("Shrinkage");
  float percent = static_cast<float>(wish.shrinkage_percent);
  if (ImGui::SliderFloat("##shrinkage", &percent, 0.0f, 25.0f, percent > 0.0f ? "%.1f %%" : "none",
                         ImGuiSliderFlags_AlwaysClamp))
    // In tenths, as it is shown: the file is what the command line makes of the same number.
    wish.shrinkage_percent = std::round(10.0 * static_cast<double>(percent)) / 10.0;
}

const char* title_of(solid::MeshFormat format) {
  switch (format) {
    case solid::MeshFormat::obj:
      return "OBJ";
    case solid::MeshFormat::drc:
      return "Draco";
    default:
      return "STL";
  }
}

std::string size_text(const solid::ExportReport& report, double factor, LengthUnit unit) {
  return fmt::format("{} wide, {} high", length_text(factor * report.size.diameter_mm, unit),
                     length_text(factor * report.size.height_mm, unit));
}

void draw_shown(AppState& shop, const solid::ExportReport& report) {
  const Palette& colours = shop.colours();
  const LengthUnit unit = shop.settings.unit;
  value_row(colours, "Triangles", fmt::format("{}", report.size.triangles));
  for (const solid::FileReport& file : report.files)
    if (file.kind == solid::FileKind::mesh)
      value_row(colours, title_of(file.format),
                fmt::format("{:.3f} MB", 1e-6 * static_cast<double>(file.bytes)));
  value_row(colours, "Size as written", size_text(report, 1.0, unit));
  if (report.prepared.shrinkage > 0.0)
    value_row(colours, "Size when fired", size_text(report, 1.0 - report.prepared.shrinkage, unit));
  if (!report.collapsed)
    value_row(
        colours, "Thinnest wall",
        fmt::format("{:.2f} mm, {:.1f} mm up", report.thinnest_mm(), report.walls.thinnest.from.y));
  ImGui::PushStyleColor(ImGuiCol_Text, colours.warning);
  for (const solid::Problem& problem : solid::problems_of(report))
    ImGui::TextWrapped("%s", problem.text.c_str());
  ImGui::PopStyleColor();
}

/// What it is at, what it is of, or why not; in a part of its own, so that the card keeps its
/// height while figures come and go.
void draw_preview(AppState& shop) {
  const ExportCard& card = shop.exporting;
  const ImVec2 size(0.0f, 12.5f * ImGui::GetFontSize());
  ImGui::BeginChild("##preview", size, true);
  const std::string stage = shop.exporter.stage();
  const auto running = shop.exporter.running();
  if (running == Exporter::Kind::files)
    faint_text(shop.colours(), "Writing: " + stage);
  else if (!card.problem.empty())
    ImGui::TextWrapped("%s", card.problem.c_str());
  else if (running)
    faint_text(shop.colours(), "Computing: " + stage);
  if (card.shown && card.problem.empty()) draw_shown(shop, *card.shown);
  if (!card.shown && !running && card.problem.empty())
    faint_text(shop.colours(), "No mesh among the files");
  ImGui::EndChild();
}

void draw_answers(AppState& shop) {
  const ExportCard& card = shop.exporting;
  const bool writes = shop.exporter.running() == Exporter::Kind::files;
  const std::vector<std::string> standing =
      card.written.empty() && !writes ? standing_files(card.wish) : std::vector<std::string>();
  if (!card.said.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, shop.colours().good);
    ImGui::TextWrapped("%s", card.said.c_str());
    ImGui::PopStyleColor();
  } else {
    faint_text(shop.colours(),
               standing.empty()
                   ? "A file is written whole or not at all"
                   : fmt::format("{} will be replaced",
                                 standing.size() == 1
                                     ? std::filesystem::path(standing.front()).filename().string()
                                     : fmt::format("{} files", standing.size())));
  }
  if (writes) {
    if (ImGui::Button("Cancel")) act(shop, "export.cancel");
  } else {
    if (main_button("Export (Ctrl+Enter)", shop.colours())) act(shop, "export.write");
    ImGui::SameLine();
    if (!card.written.empty()) {
      if (ImGui::Button("Open folder")) act(shop, "export.folder");
      ImGui::SameLine();
    }
    if (ImGui::Button("Close (Esc)")) close_overlay(shop);
  }
}

}  // namespace

void draw_export_card(AppState& shop, const ViewRect& view) {
  begin_card("##export", view, 38.0f);
  card_title(shop, "Export");
  ExportWish& wish = shop.exporting.wish;
  draw_formats(wish);
  draw_places(shop, wish);
  draw_choices(shop, wish);
  ImGui::Spacing();
  draw_preview(shop);
  draw_answers(shop);
  ImGui::End();
}

}  // namespace clay::studio
