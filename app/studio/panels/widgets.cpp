#include "app/studio/panels/widgets.hpp"

#include "app/studio/panels/panels.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace clay::studio {
namespace {

/// Columns of equal width, for buttons with these titles: the fewest rows that show every title
/// completely.
int columns_of(std::span<const char* const> titles, float room, float gap) {
  float widest = 0.0f;
  for (const char* title : titles) widest = std::max(widest, ImGui::CalcTextSize(title).x);
  widest += 2.0f * ImGui::GetStyle().FramePadding.x;
  const int count = static_cast<int>(titles.size());
  const int fitting = std::clamp(static_cast<int>((room + gap) / (widest + gap)), 1, count);
  const int rows = (count + fitting - 1) / fitting;
  return (count + rows - 1) / rows;
}

}  // namespace

int choice_row(const char* id, std::span<const char* const> titles, int chosen) {
  ImGui::PushID(id);
  ImGui::BeginGroup();
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x;
  const int columns = columns_of(titles, room, gap);
  const auto count = static_cast<float>(columns);
  const float width = std::floor((room - gap * (count - 1.0f)) / count);
  int clicked = -1;
  for (int i = 0; i < static_cast<int>(titles.size()); ++i) {
    if (i % columns > 0) ImGui::SameLine(0.0f, gap);
    const bool on = i == chosen;
    if (on) {
      const ImVec4 face = ImGui::GetStyleColorVec4(ImGuiCol_Text);
      ImGui::PushStyleColor(ImGuiCol_Button, face);
      ImGui::PushStyleColor(ImGuiCol_ButtonHovered, face);
      ImGui::PushStyleColor(ImGuiCol_Text, ink_on(face));
    }
    const bool last = i % columns + 1 == columns;
    if (ImGui::Button(titles[static_cast<std::size_t>(i)], ImVec2(last ? kToEdge : width, 0.0f)))
      clicked = i;
    mark_chosen(titles[static_cast<std::size_t>(i)], on);
    if (on) ImGui::PopStyleColor(3);
  }
  ImGui::EndGroup();
  ImGui::PopID();
  return clicked;
}

void rule() {
  ImGui::Spacing();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddLine(from, {from.x + ImGui::GetContentRegionAvail().x, from.y},
                                      ImGui::GetColorU32(ImGuiCol_Separator));
  ImGui::Dummy({0.0f, 1.0f});
  ImGui::Spacing();
}

bool main_button(const char* text, const Palette& colours, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  ImGui::PushStyleColor(ImGuiCol_Button, colours.accent);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, colours.accent);
  ImGui::PushStyleColor(ImGuiCol_Text, ink_on(colours.accent));
  const bool clicked = ImGui::Button(text);
  ImGui::PopStyleColor(3);
  ImGui::EndDisabled();
  return clicked;
}

void same_line_if_room(const char* text, float beside_px) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  const float width = ImGui::CalcTextSize(text).x + 2.0f * style.FramePadding.x + beside_px;
  if (ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= right) ImGui::SameLine();
}

bool next_box(const char* title, bool& on, float left_px) {
  same_line_if_room(title, ImGui::GetFrameHeight());
  if (ImGui::GetCursorPosX() < left_px) ImGui::SetCursorPosX(left_px);
  return ImGui::Checkbox(title, &on);
}

void dialog_title(const ViewModel& model, const char* text) {
  ImGui::PushFont(model.ui.fonts.title);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
  ImGui::Spacing();
}

bool narrow_form() {
  constexpr float kNarrowEm = 28.0f;
  return ImGui::GetContentRegionMax().x - ImGui::GetCursorStartPos().x <
         kNarrowEm * ImGui::GetFontSize();
}

void form_row(const char* label) {
  const bool above = narrow_form();
  if (!above) ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  if (!above) ImGui::SameLine(kFormEm * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(kToEdge);
}

void tip(const char* text) {
  constexpr float kTipEm = 24.0f;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const float left = ImGui::GetWindowPos().x, right = left + ImGui::GetWindowWidth();
  if (!ImGui::IsWindowHovered() || !ImGui::IsMouseHoveringRect({left, low.y}, {right, high.y}) ||
      ImGui::IsAnyItemActive())
    return;
  // Above the line, so that it covers neither the value nor the next control, if there is room.
  const float em = ImGui::GetFontSize();
  const std::string shown = wrapped(text, kTipEm * em);
  const float above = low.y - 0.4f * em;
  if (above > ImGui::CalcTextSize(shown.c_str()).y + em)
    ImGui::SetNextWindowPos({ImGui::GetIO().MousePos.x, above}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetTooltip("%s", shown.c_str());
}

void form_place(std::string& name, std::string& folder, Actions& actions) {
  form_row("Name");
  ImGui::InputText("##name", &name);
  form_row("Folder");
  if (kInPage) return ImGui::TextDisabled("Downloads of the browser");
  const float button = ImGui::CalcTextSize("Choose...").x + 2.0f * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputText("##folder", &folder);
  ImGui::SameLine();
  if (ImGui::Button("Choose...")) actions.emplace_back(ChooseExportFolder{});
}

const Material* choose_material(const Material& shown) {
  const Material* chosen = nullptr;
  if (!begin_list("Material", shown.title.data(), ImGuiComboFlags_HeightLargest)) return chosen;
  for (const Material& material : kMaterials)
    if (ImGui::Selectable(material.title.data(), material == shown)) chosen = &material;
  ImGui::EndCombo();
  return chosen;
}

namespace {

/// Dims everything around the dialog except the menu and the status bar. The dialog draws it, so
/// that it covers the columns as well.
void dim_around(float top, float bottom) {
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const float right = corner.x + size.x, foot = corner.y + size.y;
  const float room = ImGui::GetIO().DisplaySize.x;
  const ImU32 shade = IM_COL32(0, 0, 0, 120);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRectFullScreen();
  draw->AddRectFilled({0.0f, top}, {room, corner.y}, shade);
  draw->AddRectFilled({0.0f, corner.y}, {corner.x, foot}, shade);
  draw->AddRectFilled({right, corner.y}, {room, foot}, shade);
  draw->AddRectFilled({0.0f, foot}, {room, bottom}, shade);
  draw->PopClipRect();
}

/// One row of pixels at y; the pixels at both ends are blended by their coverage.
void fill_row(float y, float from, float to, ImVec4 colour) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto fill = [&](float begin, float end, float part) {
    ImVec4 shade = colour;
    shade.w *= part;
    if (end > begin) draw->AddRectFilled({begin, y}, {end, y + 1.0f}, ImGui::GetColorU32(shade));
  };
  const float first = std::ceil(from), last = std::floor(to);
  if (last < first) return fill(last, first, to - from);
  fill(first - 1.0f, first, first - from);
  fill(first, last, 1.0f);
  fill(last, last + 1.0f, to - last);
}

}  // namespace

void begin_window(const char* id, int flags) {
  ImGui::Begin(id, nullptr, flags);
  // ImGui's log, which app/web/window_reader.cpp reads, ends with each window.
  if (ImGui::GetCurrentContext()->TestEngineHookItems) ImGui::LogToClipboard(0);
}

// ImGui of the native program has no hooks, and the macro no arguments.
void mark_chosen([[maybe_unused]] const char* name, [[maybe_unused]] bool chosen) {
  [[maybe_unused]] ImGuiContext& g = *ImGui::GetCurrentContext();
  IMGUI_TEST_ENGINE_ITEM_INFO(
      ImGui::GetItemID(), name,
      ImGuiItemStatusFlags_Checkable | ImGuiItemStatusFlags_Openable |
          (chosen ? ImGuiItemStatusFlags_Checked : 0));  // the flags of no control of ImGui
}

bool begin_list(const char* name, const char* shown, int flags) {
  const bool open = ImGui::BeginCombo(fmt::format("##{}", name).c_str(), shown, flags);
  [[maybe_unused]] ImGuiContext& g = *ImGui::GetCurrentContext();
  // An open list is the present window, and its entries follow.
  if (!open) IMGUI_TEST_ENGINE_ITEM_INFO(ImGui::GetItemID(), name, ImGuiItemStatusFlags_Openable);
  return open;
}

void begin_dialog(const char* id, const ViewRect& rect, float width_em, float steady_em) {
  const float em = ImGui::GetFontSize();
  const ImVec2 low(rect.corner_px.x, rect.corner_px.y);
  const ImVec2 high(low.x + rect.size_px.x, low.y + rect.size_px.y);
  // In a narrow view a dialog covers the columns as well, so that no text is cut off.
  const float room = ImGui::GetIO().DisplaySize.x;
  const float width = std::min(width_em * em, room);
  const float middle = width > rect.size_px.x ? 0.5f * room : 0.5f * (low.x + high.x);
  const float y = 0.5f * (low.y + high.y);
  if (steady_em > 0.0f)
    ImGui::SetNextWindowPos({middle, std::max(low.y, y - 0.5f * steady_em * em)}, ImGuiCond_Always,
                            {0.5f, 0.0f});
  else
    ImGui::SetNextWindowPos({middle, y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({width, 0.0f});  // as high as its content, at most as the view
  ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, rect.size_px.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(std::round(1.3f * em), std::round(1.1f * em)));
  begin_window(id, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                       ImGuiWindowFlags_NoSavedSettings);
  ImGui::PopStyleVar(2);
  dim_around(low.y, ImGui::GetIO().DisplaySize.y - status_height());
}

void begin_body(const ViewRect& rect, float width_px) {
  constexpr float kButtonsEm = 6.0f;
  const float room = std::max(4.0f * ImGui::GetFontSize(), rect.size_px.y - ImGui::GetCursorPosY() -
                                                               kButtonsEm * ImGui::GetFontSize());
  // Its height in the frame before.
  const float height = ImGui::GetStateStorage()->GetFloat(ImGui::GetID("body"), room);
  ImGui::BeginChild("##body", {width_px, std::min(height, room)}, false,
                    ImGuiWindowFlags_NavFlattened);
  ImGui::BeginGroup();
}

void end_body() {
  // Its last item may have had another spacing below it than that subtracted here.
  ImGui::EndGroup();
  const float height = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
  ImGui::EndChild();
  ImGui::GetStateStorage()->SetFloat(ImGui::GetID("body"), height);
}

const ImVec4& match_colour(double mm, const Palette& colours) {
  return mm <= kMatchesMm ? colours.good : mm <= kNearMm ? colours.warning : colours.fault;
}

void draw_half_section(const render::PotView& pot, ImVec2 corner, float side,
                       const Palette& colours) {
  if (pot.rows.empty()) return;
  const float widest = std::max(1.0f, static_cast<float>(render::extent_of(pot).radius_mm));
  const float height = static_cast<float>(pot.height_mm);
  const float scale = 0.9f * side / std::max(2.0f * widest, height);
  const float middle = std::floor(corner.x + 0.5f * side);
  const float foot = std::floor(corner.y + 0.5f * side + 0.5f * scale * height);
  const float step = scale * height / static_cast<float>(pot.rows.size());
  ImVec4 shade = colours.clay;
  shade.w = 0.35f;
  for (float up = 0.5f; up < scale * height; up += 1.0f) {
    const auto i = std::min(static_cast<std::size_t>(up / step), pot.rows.size() - 1);
    const float outer = scale * pot.rows[i].outer_mm, inner = scale * pot.rows[i].inner_mm;
    const float y = foot - up - 0.5f;
    fill_row(y, middle - outer, middle, colours.clay);
    fill_row(y, middle, middle + outer, shade);
    fill_row(y, middle + inner, middle + outer, colours.clay);
  }
}

namespace {

/// "workshop.process.json" is shown as workshop.
std::string title_of(const std::string& process) {
  if (!ends_ignoring_case(process, ".json")) return process_title(process);
  return name_of_file(process);
}

}  // namespace

bool choose_process(const ViewModel& model, const char* none, std::string& process,
                    Actions& actions) {
  if (!begin_list("Process", process.empty() ? none : title_of(process).c_str())) return false;
  const std::string before = process;
  if (ImGui::Selectable(none, process.empty())) process.clear();
  for (const std::string& name : process_names())
    if (ImGui::Selectable(process_title(name).c_str(), name == before)) process = name;
  for (const std::string& path : model.settings.processes) {
    ImGui::PushID(path.c_str());
    if (ImGui::Selectable(title_of(path).c_str(), path == before)) process = path;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
    ImGui::PopID();
  }
  if (ImGui::Selectable("From a file...")) actions.emplace_back(ChooseProcessFile{});
  ImGui::EndCombo();
  return process != before;
}

}  // namespace clay::studio
