// The first screen: a sample to throw, or a lump of one's own.

#include "app/studio/actions.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/samples.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

namespace clay::studio {
namespace {

constexpr std::size_t kMostLeftShown = 3;
constexpr float kLeastCardEm = 10.6f, kPictureEm = 9.0f;

/// Sections of the finished samples, made when they are first seen.
const render::PotView& section_of(const Sample& sample) {
  static std::array<std::optional<render::PotView>, 4> made;
  const auto index = static_cast<std::size_t>(&sample - samples().data());
  if (!made[index]) {
    auto pot = finished(sample);
    made[index] = pot ? std::move(*pot) : render::PotView();
  }
  return *made[index];
}

bool card(const Sample& sample, float width, const Palette& colours, ImFont* title) {
  const float em = ImGui::GetFontSize();
  ImGui::BeginGroup();
  ImGui::PushID(sample.title);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::Button("##card", {width, (kPictureEm + 5.2f) * em});
  const float inset = 0.5f * (width - kPictureEm * em);
  draw_section(section_of(sample), {at.x + inset, at.y + 0.5f * em}, kPictureEm * em, colours);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float x = at.x + inset;
  draw->AddText(title, title->FontSize, {x, at.y + (kPictureEm + 0.7f) * em},
                ImGui::GetColorU32(ImGuiCol_Text), sample.title);
  draw->AddText(ImGui::GetFont(), em, {x, at.y + (kPictureEm + 2.4f) * em},
                ImGui::GetColorU32(colours.faint), sample.words, nullptr, kPictureEm * em);
  ImGui::PopID();
  ImGui::EndGroup();
  return clicked;
}

void own_lump(AppState& shop) {
  static double clay_kg = 1.0, radius_mm = 50.0;
  float kg = static_cast<float>(clay_kg);
  ImGui::Columns(3, "lump", false);
  ImGui::TextUnformatted("Clay");
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::SliderFloat("##clay", &kg, static_cast<float>(kLeastClayKg),
                         static_cast<float>(kMostClayKg), "%.2f kg",
                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    clay_kg = static_cast<double>(kg);
  ImGui::NextColumn();
  length_slider("Radius", radius_mm, 20.0, 200.0, shop.settings.unit);
  ImGui::NextColumn();
  faint_text(shop.colours(), fmt::format("{} high", length_text(lump_height_mm(clay_kg, radius_mm),
                                                                shop.settings.unit)));
  if (ImGui::Button("Throw this lump", {-1.0f, 0.0f}))
    begin_work(shop, lump_of(clay_kg, radius_mm));
  ImGui::Columns(1);
}

/// What was thrown before: any file, and the last ones by name.
void files(AppState& shop) {
  if (ImGui::Button("Open...")) run(*find_action("file.open"), shop);
  std::string chosen;
  for (const std::string& path : shop.settings.recent) {
    const std::string name = std::filesystem::path(path).filename().string();
    const float width =
        ImGui::CalcTextSize(name.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) break;
    ImGui::PushID(path.c_str());
    if (ImGui::Button(name.c_str())) chosen = path;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
    ImGui::PopID();
  }
  if (!chosen.empty()) open_file(shop, chosen);
}

/// "22 Nov 14:05", where the user is.
std::string time_text(std::chrono::system_clock::time_point when) {
  return fmt::format("{:%d %b %H:%M}", fmt::localtime(std::chrono::system_clock::to_time_t(when)));
}

/// What a program that died has left.
void left_works(AppState& shop) {
  if (shop.left.empty()) return;
  const std::size_t shown = std::min(shop.left.size(), kMostLeftShown);
  const float em = ImGui::GetFontSize();
  ImGui::PushStyleColor(ImGuiCol_Border, shop.colours().warning);
  ImGui::BeginChild("##left", {0.0f, (2.6f + 2.2f * static_cast<float>(shown)) * em}, true);
  ImGui::PopStyleColor();
  ImGui::TextColored(shop.colours().warning, "Not saved when the program ended:");
  for (std::size_t i = 0; i < shown; ++i) {
    const history::Recoverable& left = shop.left[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(fmt::format("{}, {}: {} stroke{}, {:.0f} s{}", time_text(left.when),
                                       left.scene, left.strokes, left.strokes == 1 ? "" : "s",
                                       left.seconds, left.running ? ", the last one cut short" : "")
                               .c_str());
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 14.0f * em);
    const bool wanted = ImGui::Button(i == 0 ? "Recover (Ctrl+R)" : "Recover");
    ImGui::SameLine();
    const bool unwanted = ImGui::Button("Discard");
    ImGui::PopID();
    if (wanted) recover_work(shop, i);
    if (unwanted) discard_work(shop, i);
    if (wanted || unwanted) break;
  }
  ImGui::EndChild();
}

}  // namespace

void draw_gallery(AppState& shop, const ViewRect& view) {
  const float em = ImGui::GetFontSize();
  begin_card("##gallery", view, 47.2f);
  ImGui::PushFont(shop.fonts.title);
  ImGui::TextUnformatted("What will you throw?");
  ImGui::PopFont();
  faint_text(shop.colours(),
             "Each is a lump of clay on the wheel; the picture is what it can become.");
  ImGui::Spacing();
  left_works(shop);
  const float room = ImGui::GetContentRegionAvail().x;
  const float gap = ImGui::GetStyle().ItemSpacing.x, least = kLeastCardEm * em;
  const auto fitting = static_cast<std::size_t>(std::max(1.0f, (room + gap) / (least + gap)));
  const std::size_t in_row = std::min(fitting, samples().size());
  const float width = (room + gap) / static_cast<float>(in_row) - gap;
  for (std::size_t i = 0; i < samples().size(); ++i) {
    const Sample& sample = samples()[i];
    if (i % in_row != 0) ImGui::SameLine();
    if (!card(sample, width, shop.colours(), shop.fonts.title)) continue;
    if (auto scene = scene_of(sample)) begin_work(shop, *scene);
  }
  ImGui::Spacing();
  ImGui::Separator();
  ImGui::Spacing();
  own_lump(shop);
  ImGui::Spacing();
  ImGui::Separator();
  ImGui::Spacing();
  files(shop);
  ImGui::End();
}

}  // namespace clay::studio
