// The first screen: a sample, a custom lump, a file, or an unsaved work.

#include "app/studio/commands.hpp"
#include "app/studio/new_scene.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/value_slider.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace clay::studio {
namespace {

constexpr float kBesideEm = 34.0f;  // a work and its buttons in one row
constexpr std::size_t kMostWorksShown = 3;
constexpr float kLeastCardEm = 10.0f, kPictureEm = 9.0f, kLeastLumpEm = 30.0f;
constexpr float kNameEm = 12.0f;  // longest name of a recent file

/// Sections of the finished samples, computed when they are first shown.
const render::PotView& section_of(const Sample& sample) {
  static std::array<std::optional<render::PotView>, kSamples> made;
  const auto index = static_cast<std::size_t>(&sample - samples().data());
  if (!made[index]) {
    auto pot = finished(sample);
    made[index] = pot ? std::move(*pot) : render::PotView();
  }
  return *made[index];
}

/// A button with picture, title and text: the lesson. Below it: watch the strokes, or throw freely.
void draw_sample(std::size_t index, float width, const ViewModel& model, Actions& actions) {
  const Sample& sample = samples()[index];
  const Palette& colours = model.colours();
  ImFont* title = model.ui.fonts.title;
  const float em = ImGui::GetFontSize();
  ImGui::BeginGroup();
  ImGui::PushID(sample.title);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked =
      ImGui::Button(fmt::format("##{}. {}", sample.title, sample.description).c_str(),
                    {width, (kPictureEm + 6.8f) * em});
  const float inset = 0.5f * (width - kPictureEm * em);
  draw_half_section(section_of(sample), {at.x + inset, at.y + 0.5f * em}, kPictureEm * em, colours);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float x = at.x + inset;
  draw->AddText(title, title->FontSize, {x, at.y + (kPictureEm + 0.7f) * em},
                ImGui::GetColorU32(ImGuiCol_Text), sample.title);
  draw->AddText(ImGui::GetFont(), em, {x, at.y + (kPictureEm + 2.4f) * em},
                ImGui::GetColorU32(colours.faint), sample.description, nullptr, kPictureEm * em);
  draw->AddText(ImGui::GetFont(), em, {x, at.y + (kPictureEm + 5.2f) * em},
                ImGui::GetColorU32(ImGuiCol_Text), "Learn the steps >");
  const float half = 0.5f * (width - ImGui::GetStyle().ItemInnerSpacing.x);
  if (clicked) actions.emplace_back(BeginLesson{index, false});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Throw it step by step");
  if (ImGui::Button("Show me", {half, 0.0f})) actions.emplace_back(BeginLesson{index, true});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Watch the pot being thrown");
  ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
  if (ImGui::Button("Throw it", {half, 0.0f})) actions.emplace_back(BeginSample{index});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Begin with the lump, without a lesson");
  ImGui::PopID();
  ImGui::EndGroup();
}

void draw_lump(const ViewModel& model, Actions& actions) {
  // In ImGui's storage, so that the sliders keep their values while the dialog is closed.
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID kg_id = ImGui::GetID("kg"), radius_id = ImGui::GetID("radius");
  float kg = kept.GetFloat(kg_id, 1.0f);
  double radius_mm = static_cast<double>(kept.GetFloat(radius_id, 50.0f));
  const bool wide = ImGui::GetContentRegionAvail().x >= kLeastLumpEm * ImGui::GetFontSize();
  ImGui::Columns(wide ? 3 : 1, "lump", false);
  if (panel_slider("Clay weight", kg, static_cast<float>(kLeastClayKg),
                   static_cast<float>(kMostClayKg), fmt::format("{:.2f} kg", kg), kKilograms,
                   ImGuiSliderFlags_Logarithmic))
    kept.SetFloat(kg_id, kg);
  ImGui::NextColumn();
  if (length_slider("Radius", radius_mm, 20.0, 200.0, model.settings.unit))
    kept.SetFloat(radius_id, static_cast<float>(radius_mm));
  ImGui::NextColumn();
  const double clay_kg = static_cast<double>(kg);
  const double height_mm = lump_height_mm(clay_kg, radius_mm);
  const bool stands = height_mm <= tallest_lump_mm();
  faint_text(model.colours(),
             fmt::format("Height {}{}", length_text(height_mm, model.settings.unit),
                         stands ? "" : ", too tall"));
  ImGui::BeginDisabled(!stands);
  if (ImGui::Button("Throw this lump", {kToEdge, 0.0f}))
    actions.emplace_back(BeginWork{lump_of(clay_kg, radius_mm), nullptr, {}});
  ImGui::EndDisabled();
  ImGui::Columns(1);
}

/// Buttons for any file and for the list of works, and the recent files that have room.
void draw_files(const ViewModel& model, Actions& actions) {
  if (ImGui::Button("Open...")) actions.emplace_back(RunCommand{"file.open"});
  ImGui::SameLine();
  if (ImGui::Button("Works...")) actions.emplace_back(RunCommand{"file.works"});
  const float em = ImGui::GetFontSize(), pad = 2.0f * ImGui::GetStyle().FramePadding.x;
  for (const std::string& path : model.settings.recent) {
    const std::string whole = std::filesystem::path(path).filename().string();
    ImGui::SameLine();
    const float room = ImGui::GetContentRegionAvail().x - pad;
    const std::string name = shortened(whole, kNameEm * em);
    if (room < ImGui::CalcTextSize(name.c_str()).x) break;
    ImGui::PushID(path.c_str());
    if (ImGui::Button(name.c_str())) actions.emplace_back(OpenFile{path});
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", shown_name(path).c_str());
    ImGui::PopID();
  }
}

}  // namespace

std::string text_of(const history::Recoverable& work) {
  return fmt::format("{}, {}: {} stroke{}, {:.0f} s{}", time_text(work.when), work.scene,
                     work.strokes, work.strokes == 1 ? "" : "s", work.seconds,
                     work.running ? ", the last one incomplete" : "");
}

namespace {

/// Unsaved works left by programs that crashed.
void draw_recoverable(const ViewModel& model, Actions& actions) {
  if (model.recoverable.empty()) return;
  const std::size_t shown = std::min(model.recoverable.size(), kMostWorksShown);
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleColor(ImGuiCol_Border, model.colours().warning);
  const bool beside = ImGui::GetContentRegionAvail().x > kBesideEm * em;  // the text has room
  const float row = std::max(2.2f * em, ImGui::GetFrameHeightWithSpacing());
  ImGui::BeginChild("##recoverable",
                    {0.0f, 2.6f * em + (beside ? 1.0f : 2.0f) * row * static_cast<float>(shown)},
                    true);
  ImGui::PopStyleColor();
  ImGui::TextColored(model.colours().warning, "Not saved when the program ended:");
  for (std::size_t i = 0; i < shown; ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text_of(model.recoverable[i]).c_str());
    if (beside) ImGui::SameLine(ImGui::GetContentRegionMax().x - 14.0f * em);
    if (ImGui::Button(i == 0 ? "Recover (Ctrl+R)" : "Recover"))
      actions.emplace_back(RecoverWork{i});
    ImGui::SameLine();
    if (ImGui::Button("Discard")) actions.emplace_back(DiscardRecoverable{i});
    ImGui::PopID();
  }
  ImGui::EndChild();
}

/// As many per row as fit.
void draw_samples(const ViewModel& model, Actions& actions) {
  const float room = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemSpacing.x, least = kLeastCardEm * ImGui::GetFontSize();
  const auto fitting = static_cast<std::size_t>(std::max(1.0f, (room + gap) / (least + gap)));
  const std::size_t in_row = std::min(fitting, samples().size());
  const float width = (room + gap) / static_cast<float>(in_row) - gap;
  for (std::size_t i = 0; i < samples().size(); ++i) {
    if (i % in_row != 0) ImGui::SameLine();
    draw_sample(i, width, model, actions);
  }
}

}  // namespace

void draw(const GalleryDialog&, const ViewModel& model, Actions& actions, const ViewRect& rect) {
  begin_dialog("##gallery", rect, 50.0f);
  dialog_title(model, "New pot");
  faint_text(
      model.colours(),
      "Choose a pot, and throw it step by step along a line. Each begins as a lump of clay.");
  ImGui::Spacing();
  draw_recoverable(model, actions);
  draw_samples(model, actions);
  rule();
  draw_lump(model, actions);
  rule();
  draw_files(model, actions);
  ImGui::End();
}

}  // namespace clay::studio
