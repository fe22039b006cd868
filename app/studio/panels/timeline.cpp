#include "app/studio/panels/timeline.hpp"

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/tool_choice.hpp"
#include "claystack/engine/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace clay::studio {

std::vector<TimelineCard> timeline_of(const history::Work& work) {
  const auto& nodes = work.record().nodes;
  std::vector<TimelineCard> cards;
  const auto add = [&](history::NodeId node, bool done) {
    TimelineCard card{node, done, work.view(nodes[node].parent).children};
    std::erase(card.others, node);
    cards.push_back(std::move(card));
  };
  for (history::NodeId node = work.at(); node != 0; node = nodes[node].parent) add(node, true);
  std::ranges::reverse(cards);
  for (history::NodeId node = nodes[work.at()].taken; node != 0; node = nodes[node].taken)
    add(node, false);
  return cards;
}

namespace {

constexpr float kCardEm = 3.6f, kGapEm = 0.25f, kPadEm = 0.4f, kBarEm = 0.35f;
constexpr float kLeastRoomEm = 26.0f;  // minimum height of the view for the timeline
constexpr float kDragPx = 4.0f;        // a shorter movement is a click

std::string tooltip_of(const ViewModel& model, history::NodeId node) {
  constexpr std::array kShapes = {"sphere", "ellipse", "rib", "custom tool"};
  const history::NodeView stroke = model.document.work().view(node);
  const ToolSpec& tool = stroke.scene->tool;
  const std::string shape =
      cuts_level(tool.mode) ? "" : fmt::format(" with a {}", kShapes[tool.shape.index()]);
  return fmt::format(
      "Stroke {}: {}{}, {:.1f} s{}{}", node, name_of(tool.mode), shape, stroke.seconds,
      stroke.volume_mm3
          ? fmt::format(", then {} of clay in the pot",
                        mass_text(1e-3 * *stroke.volume_mm3 * model.document.pot().density_g_cm3))
          : std::string(),
      stroke.changed == false ? ", no contact" : "");
}

ImVec4 colour_of(const history::NodeView& stroke, const Palette& colours) {
  switch (stroke.scene->tool.mode) {
    case ToolMode::trim:
    case ToolMode::trim_foot:
    case ToolMode::needle:
    case ToolMode::wire:
      return colours.warning;
    case ToolMode::pinch:
      return colours.good;
    case ToolMode::press:
    case ToolMode::smooth:
      break;
  }
  return colours.accent;
}

/// Positions of cards on screen; index 0 is the start, before all strokes.
struct Row {
  ImVec2 origin;
  float side, step;
  [[nodiscard]] ImVec2 low(std::size_t index) const {
    return {origin.x + step * static_cast<float>(index), origin.y};
  }
  [[nodiscard]] ImVec2 high(std::size_t index) const {
    const ImVec2 corner = low(index);
    return {corner.x + side, corner.y + side};
  }
};

/// The pot after the stroke, the number of the stroke, and the colour of its mode.
void draw_card(const ViewModel& model, history::NodeId node, bool done, const Row& row,
               std::size_t index) {
  const float em = ImGui::GetFontSize();
  const Palette& colours = model.colours();
  const ImVec2 low = row.low(index), high = row.high(index);
  if (!ImGui::IsRectVisible(low, high)) return;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg, done ? 1.0f : 0.4f),
                      0.25f * em);
  Palette faded = colours;
  faded.clay.w = done ? 1.0f : 0.35f;
  if (const auto thumb = model.ui.thumbs.find(node); thumb != model.ui.thumbs.end())
    draw_half_section(thumb->second, {low.x + 0.5f * em, low.y}, row.side - em, faded);
  ImFont* small = model.ui.fonts.small != nullptr ? model.ui.fonts.small : ImGui::GetFont();
  const std::string name = node == 0 ? "Start" : fmt::format("{}", node);
  draw->AddText(small, small->FontSize, {low.x + 0.25f * em, high.y - 1.15f * em},
                ImGui::GetColorU32(ImGuiCol_Text, done ? 1.0f : 0.6f), name.c_str());
  if (node > 0) {
    ImVec4 mode = colour_of(model.document.work().view(node), colours);
    mode.w = done ? 1.0f : 0.5f;
    draw->AddRectFilled({high.x - 0.75f * em, high.y - 0.75f * em},
                        {high.x - 0.3f * em, high.y - 0.3f * em}, ImGui::GetColorU32(mode),
                        0.15f * em);
  }
  if (node == model.document.work().at())
    draw->AddRect(low, high, ImGui::GetColorU32(ImGuiCol_Text), 0.25f * em, 0, 0.12f * em);
}

/// A button on the card, and the menu of the strokes beside it. Returns whether the mouse is on it.
bool draw_branches(const ViewModel& model, const TimelineCard& card, const Row& row,
                   std::size_t index, Actions& actions) {
  if (card.others.empty()) return false;
  const float em = ImGui::GetFontSize();
  ImGui::PushID(static_cast<int>(card.node));
  ImGui::SetCursorScreenPos({row.high(index).x - 1.45f * em, row.low(index).y + 0.1f * em});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, 0.0f));
  if (ImGui::Button(fmt::format("+{}", card.others.size()).c_str(), {1.35f * em, 1.25f * em}))
    ImGui::OpenPopup("branches");
  ImGui::PopStyleVar();
  const bool hovered = ImGui::IsItemHovered();
  if (hovered) ImGui::SetTooltip("Other branches (Ctrl+B)");
  if (ImGui::BeginPopup("branches")) {
    ImGui::TextColored(model.colours().faint, "Go to another branch");
    for (const history::NodeId other : card.others)
      if (ImGui::MenuItem(tooltip_of(model, other).c_str()))
        actions.emplace_back(GoToStroke{other, true});
    ImGui::EndPopup();
  }
  ImGui::PopID();
  return hovered;
}

/// The stroke under the held mouse; ImGui stores it with the window of the timeline.
struct Held {
  std::size_t index = 0;  ///< of its card; 0: none
  float from_px = 0.0f;
  bool dragged = false;

  static Held load() {
    const ImGuiStorage& kept = *ImGui::GetStateStorage();
    return {static_cast<std::size_t>(kept.GetInt(ImGui::GetID("held"))),
            kept.GetFloat(ImGui::GetID("from")), kept.GetBool(ImGui::GetID("dragged"))};
  }
  void store() const {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    kept.SetInt(ImGui::GetID("held"), static_cast<int>(index));
    kept.SetFloat(ImGui::GetID("from"), from_px);
    kept.SetBool(ImGui::GetID("dragged"), dragged);
  }
};

/// The moment within the stroke at the mouse position.
Scrub moment_at_mouse(const ViewModel& model, history::NodeId node, const Row& row,
                      std::size_t index) {
  const double part = std::clamp(
      static_cast<double>((ImGui::GetIO().MousePos.x - row.low(index).x) / row.side), 0.0, 1.0);
  return {node, part * model.document.work().view(node).seconds};
}

/// A line at the moment shown in the view.
void draw_moment(const ViewModel& model, const std::vector<TimelineCard>& cards, const Row& row) {
  const auto& moment = model.document.moment();
  if (!moment) return;
  const auto card = std::ranges::find(cards, moment->node, &TimelineCard::node);
  const double whole = model.document.work().view(moment->node).seconds;
  if (card == cards.end() || whole <= 0.0) return;
  const auto index = static_cast<std::size_t>(card - cards.begin()) + 1;
  const float x = row.low(index).x + static_cast<float>(moment->seconds / whole) * row.side;
  ImGui::GetWindowDrawList()->AddLine({x, row.low(index).y}, {x, row.high(index).y},
                                      ImGui::GetColorU32(ImGuiCol_Text), 2.0f);
}

/// Index of the card under the mouse: 0 for the start.
std::optional<std::size_t> card_at_mouse(std::size_t count, const Row& row) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float along = (mouse.x - row.origin.x) / row.step, down = mouse.y - row.origin.y;
  if (!ImGui::IsWindowHovered() || along < 0.0f || down < 0.0f || down >= row.side)
    return std::nullopt;
  const auto index = static_cast<std::size_t>(along);
  return index < count && mouse.x < row.high(index).x ? std::optional(index) : std::nullopt;
}

/// A click selects the end of a stroke; a drag shows a moment within it.
void handle_mouse(const ViewModel& model, const std::vector<TimelineCard>& cards, const Row& row,
                  Actions& actions) {
  Held held = Held::load();
  const float mouse_px = ImGui::GetIO().MousePos.x;
  const auto over = card_at_mouse(cards.size() + 1, row);
  const bool clicked = over && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  if (clicked && *over == 0) actions.emplace_back(GoToStroke{0});
  if (clicked) held = Held{*over, mouse_px, false};
  if (held.index == 0 || held.index > cards.size()) {
    Held{}.store();
    if (over && *over > 0)
      ImGui::SetTooltip("%s", tooltip_of(model, cards[*over - 1].node).c_str());
    return;
  }
  const history::NodeId node = cards[held.index - 1].node;
  held.dragged = held.dragged || std::abs(mouse_px - held.from_px) > kDragPx;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (held.dragged) actions.emplace_back(moment_at_mouse(model, node, row, held.index));
    return held.store();
  }
  if (held.dragged && model.document.scrubbing())
    actions.emplace_back(EndScrub{});
  else
    actions.emplace_back(GoToStroke{node, true});
  Held{}.store();
}

/// Moves the current stroke to the middle when the stroke or the size of the timeline changes.
void scroll_to_present(const ViewModel& model, const std::vector<TimelineCard>& cards,
                       const Row& row) {
  const auto card = std::ranges::find(cards, model.document.work().at(), &TimelineCard::node);
  const auto index = card == cards.end() ? 0 : static_cast<std::size_t>(card - cards.begin()) + 1;
  const float at = row.low(index).x - row.origin.x + 0.5f * row.side;
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID place = ImGui::GetID("present"), size = ImGui::GetID("width");
  const float width = ImGui::GetWindowWidth();
  if (kept.GetFloat(place, -1.0f) != at || kept.GetFloat(size, -1.0f) != width)
    ImGui::SetScrollFromPosX(row.origin.x + at - ImGui::GetWindowPos().x, 0.5f);
  kept.SetFloat(place, at);
  kept.SetFloat(size, width);
}

}  // namespace

float timeline_height(const ViewModel& model, glm::vec2 room_px) {
  const float em = ImGui::GetFontSize();
  if (!model.document.has_work() || room_px.y < kLeastRoomEm * em) return 0.0f;
  return std::ceil((kCardEm + 2.0f * kPadEm + kBarEm) * em);
}

void draw_timeline(const ViewModel& model, Actions& actions, glm::vec2 corner_px,
                   glm::vec2 size_px) {
  if (model.document.work().size() < 2) return;
  const float em = ImGui::GetFontSize();
  const std::vector<TimelineCard> cards = timeline_of(model.document.work());
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  ImGui::SetNextWindowBgAlpha(0.72f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2.0f * kPadEm * em, kPadEm * em));
  ImGui::PushStyleVar(ImGuiStyleVar_ScrollbarSize, kBarEm * em);
  begin_window("##timeline",
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_HorizontalScrollbar);
  const Row row{ImGui::GetCursorScreenPos(), kCardEm * em, (kCardEm + kGapEm) * em};
  draw_card(model, 0, true, row, 0);
  bool on_button = false;
  for (std::size_t i = 0; i < cards.size(); ++i) {
    draw_card(model, cards[i].node, cards[i].done, row, i + 1);
    on_button = draw_branches(model, cards[i], row, i + 1, actions) || on_button;
  }
  // Disabled while a dialog is open.
  if (model.ui.shows<NoDialog>() && !on_button) handle_mouse(model, cards, row, actions);
  draw_moment(model, cards, row);
  ImGui::SetCursorScreenPos({row.origin.x, row.origin.y + row.side - 1.0f});
  ImGui::Dummy({row.high(cards.size()).x - row.origin.x, 1.0f});
  scroll_to_present(model, cards, row);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace clay::studio
