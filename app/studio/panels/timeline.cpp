#include "app/studio/panels/timeline.hpp"
#include "app/studio/tool_choice.hpp"

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace clay::studio {
namespace {

/// Nodes on the path of undo and redo: the ancestors of the current node, and the descendants along
/// the latest branch.
std::vector<char> main_line(const history::Work& work) {
  std::vector<char> on(work.size(), 0);
  const auto& nodes = work.record().nodes;
  for (history::NodeId node = work.at(); node != 0; node = nodes[node].parent) on[node] = 1;
  for (history::NodeId node = nodes[work.at()].taken; node != 0; node = nodes[node].taken)
    on[node] = 1;
  return on;
}

}  // namespace

Timeline timeline_of(const history::Work& work) {
  const std::vector<char> line = main_line(work);
  std::vector<char> done(work.size(), 0);
  for (history::NodeId node = work.at(); node != 0; node = work.record().nodes[node].parent)
    done[node] = 1;
  Timeline timeline;
  std::vector<TimelineBlock> of(work.size());
  std::vector<char> row_goes_on(work.size(), 0);  // a child has taken over this row
  row_goes_on[0] = 1;
  for (history::NodeId node = 1; node < work.size(); ++node) {  // parents precede their children
    const history::NodeView view = work.view(node);
    TimelineBlock& block = of[node];
    block.node = node;
    block.from_s = of[view.parent].to_s;
    block.to_s = block.from_s + std::max(view.seconds, kShortestBlockS);
    block.parent_row = of[view.parent].row;
    block.done = done[node] != 0;
    if (line[node] != 0) {
      block.row = 0;
    } else if (block.parent_row > 0 && row_goes_on[view.parent] == 0) {
      block.row = block.parent_row;
      row_goes_on[view.parent] = 1;
    } else {
      block.row = timeline.rows++;
    }
    timeline.seconds = std::max(timeline.seconds, block.to_s);
    timeline.blocks.push_back(block);
  }
  return timeline;
}

std::optional<TimelineBlock> block_at(const Timeline& timeline, double seconds, std::size_t row) {
  const auto found = std::ranges::find_if(timeline.blocks, [&](const TimelineBlock& block) {
    return block.row == row && seconds >= block.from_s && seconds < block.to_s;
  });
  if (found == timeline.blocks.end()) return std::nullopt;
  return *found;
}

namespace {

constexpr float kRowEm = 1.6f, kStartEm = 3.6f, kNarrowestEm = 1.0f;
constexpr float kAroundEm = kStartEm + 1.2f;  // width of the margins beside the blocks
constexpr std::size_t kMostRowsShown = 3;
constexpr float kLeastRoomEm = 26.0f;  // minimum height of the view for the timeline
constexpr float kDragPx = 4.0f;        // a shorter movement is a click

std::string tooltip_of(const history::NodeView& stroke, const TimelineBlock& block) {
  constexpr std::array kShapes = {"sphere", "ellipse", "rib", "custom tool"};
  const ToolSpec& tool = stroke.scene->tool;
  return fmt::format(
      "Stroke {}: {}, {}, {:.1f} s{}{}{}", block.node, name_of(tool.mode),
      kShapes[tool.shape.index()], stroke.seconds,
      stroke.volume_mm3 ? fmt::format(", {:.1f} ml", 1e-3 * *stroke.volume_mm3) : std::string(),
      stroke.changed == false ? ", no contact" : "",
      stroke.children.size() > 1 ? fmt::format("; {} branches follow", stroke.children.size())
                                 : std::string());
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

/// Positions of blocks on screen.
struct Scale {
  ImVec2 origin;
  float px_per_s, row_px, start_px;
  [[nodiscard]] ImVec2 low(const TimelineBlock& b) const {
    return {origin.x + start_px + px_per_s * static_cast<float>(b.from_s),
            origin.y + row_px * static_cast<float>(b.row)};
  }
  [[nodiscard]] ImVec2 high(const TimelineBlock& b) const {
    return {origin.x + start_px + px_per_s * static_cast<float>(b.to_s),
            origin.y + row_px * static_cast<float>(b.row + 1)};
  }
};

void draw_block(const ViewModel& model, const TimelineBlock& block, const Scale& scale) {
  const float em = ImGui::GetFontSize();
  const history::Work& work = model.document.work();
  const history::NodeView stroke = work.view(block.node);
  const Palette& colours = model.colours();
  ImVec2 low = scale.low(block), high = scale.high(block);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 line = ImGui::GetColorU32(colours.faint);
  if (block.row != block.parent_row) {
    const float from =
        scale.origin.y + scale.row_px * (static_cast<float>(block.parent_row) + 0.9f);
    draw->AddLine({low.x, from}, {low.x, 0.5f * (low.y + high.y)}, line, 0.1f * em);
  }
  low.x += 0.06f * em;
  high.x -= 0.06f * em;
  low.y += 0.12f * em;
  high.y -= 0.12f * em;
  ImVec4 face = colour_of(stroke, colours);
  face.w = block.done ? 0.85f : 0.3f;
  draw->AddRectFilled(low, high, ImGui::GetColorU32(face), 0.25f * em);
  if (block.node == work.at())
    draw->AddRect(low, high, ImGui::GetColorU32(ImGuiCol_Text), 0.25f * em, 0, 0.12f * em);
  const std::string number = fmt::format("{}", block.node);
  const ImVec2 size = ImGui::CalcTextSize(number.c_str());
  if (size.x + 0.3f * em > high.x - low.x) return;
  draw->AddText({0.5f * (low.x + high.x - size.x), 0.5f * (low.y + high.y - size.y)},
                ImGui::GetColorU32(ink_on(face)), number.c_str());
}

/// The pot before all strokes. Returns true on a click.
bool draw_start(const ViewModel& model, const Scale& scale) {
  const float em = ImGui::GetFontSize();
  const bool here = model.document.work().at() == 0;
  ImGui::SetCursorScreenPos({scale.origin.x, scale.origin.y + 0.12f * em});
  const ImVec4 accent = model.colours().accent;
  if (here) ImGui::PushStyleColor(ImGuiCol_Button, accent);
  if (here) ImGui::PushStyleColor(ImGuiCol_Text, ink_on(accent));
  const bool clicked =
      ImGui::Button("Start", {scale.start_px - 0.3f * em, scale.row_px - 0.24f * em});
  if (here) ImGui::PopStyleColor(2);
  return clicked;
}

/// A long work scrolls, so that every stroke is wide enough for the mouse.
float scale_px_per_s(const Timeline& timeline, float width_px) {
  const float em = ImGui::GetFontSize();
  const float fitting = (width_px - kAroundEm * em) / static_cast<float>(timeline.seconds);
  return std::clamp(fitting, kNarrowestEm * em / static_cast<float>(kShortestBlockS), 8.0f * em);
}

/// The stroke under the held mouse; ImGui stores it with the window of the timeline.
struct Held {
  history::NodeId node = 0;  ///< 0: none
  float from_px = 0.0f;
  bool dragged = false;

  static Held load() {
    const ImGuiStorage& kept = *ImGui::GetStateStorage();
    return {static_cast<history::NodeId>(kept.GetInt(ImGui::GetID("held"))),
            kept.GetFloat(ImGui::GetID("from")), kept.GetBool(ImGui::GetID("dragged"))};
  }
  void store() const {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    kept.SetInt(ImGui::GetID("held"), static_cast<int>(node));
    kept.SetFloat(ImGui::GetID("from"), from_px);
    kept.SetBool(ImGui::GetID("dragged"), dragged);
  }
};

/// The moment within the stroke at the mouse position.
Scrub moment_at_mouse(const ViewModel& model, const TimelineBlock& block, const Scale& scale) {
  const float low = scale.low(block).x, high = scale.high(block).x;
  const double part =
      std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - low) / (high - low)), 0.0, 1.0);
  return {block.node, part * model.document.work().view(block.node).seconds};
}

/// A line at the moment shown in the view.
void draw_moment(const ViewModel& model, const Timeline& timeline, const Scale& scale) {
  const auto& moment = model.document.moment();
  if (!moment) return;
  const auto block = std::ranges::find(timeline.blocks, moment->node, &TimelineBlock::node);
  const double whole = model.document.work().view(moment->node).seconds;
  if (block == timeline.blocks.end() || whole <= 0.0) return;
  const ImVec2 low = scale.low(*block), high = scale.high(*block);
  const float x = low.x + static_cast<float>(moment->seconds / whole) * (high.x - low.x);
  ImGui::GetWindowDrawList()->AddLine({x, low.y}, {x, high.y}, ImGui::GetColorU32(ImGuiCol_Text),
                                      2.0f);
}

std::optional<TimelineBlock> block_under_mouse(const Timeline& timeline, const Scale& scale) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float row = (mouse.y - scale.origin.y) / scale.row_px;
  const double s =
      static_cast<double>((mouse.x - scale.origin.x - scale.start_px) / scale.px_per_s);
  if (!ImGui::IsWindowHovered() || row < 0.0f) return std::nullopt;
  return block_at(timeline, s, static_cast<std::size_t>(row));
}

/// A click selects the end of a stroke; a drag shows a moment within it.
void handle_mouse(const ViewModel& model, const Timeline& timeline, const Scale& scale,
                  Actions& actions) {
  Held held = Held::load();
  const float mouse_px = ImGui::GetIO().MousePos.x;
  const auto over = block_under_mouse(timeline, scale);
  if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
    held = Held{over->node, mouse_px, false};
  const auto block = std::ranges::find(timeline.blocks, held.node, &TimelineBlock::node);
  if (block == timeline.blocks.end()) {
    Held{}.store();
    if (over)
      ImGui::SetTooltip("%s", tooltip_of(model.document.work().view(over->node), *over).c_str());
    return;
  }
  held.dragged = held.dragged || std::abs(mouse_px - held.from_px) > kDragPx;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (held.dragged) actions.emplace_back(moment_at_mouse(model, *block, scale));
    return held.store();
  }
  if (held.dragged && model.document.scrubbing())
    actions.emplace_back(EndScrub{});
  else
    actions.emplace_back(GoToStroke{held.node, true});
  Held{}.store();
}

/// Brings the current stroke into sight when it changes, or when its row or the scale does.
void scroll_to_present(const ViewModel& model, const Timeline& timeline, const Scale& scale) {
  const history::NodeId at = model.document.work().at();
  const auto block = std::ranges::find(timeline.blocks, at, &TimelineBlock::node);
  const ImVec2 middle = block == timeline.blocks.end()
                            ? scale.origin
                            : ImVec2{0.5f * (scale.low(*block).x + scale.high(*block).x),
                                     0.5f * (scale.low(*block).y + scale.high(*block).y)};
  const float left = middle.x - scale.origin.x, top = middle.y - scale.origin.y;
  ImGuiStorage& kept = *ImGui::GetStateStorage();
  const ImGuiID x = ImGui::GetID("present x"), y = ImGui::GetID("present y");
  if (kept.GetFloat(x, -1.0f) != left)
    ImGui::SetScrollFromPosX(middle.x - ImGui::GetWindowPos().x, 0.5f);
  if (kept.GetFloat(y, -1.0f) != top)
    ImGui::SetScrollFromPosY(middle.y - ImGui::GetWindowPos().y, 0.5f);
  kept.SetFloat(x, left);
  kept.SetFloat(y, top);
}

}  // namespace

float timeline_height(const ViewModel& model, glm::vec2 room_px) {
  const float em = ImGui::GetFontSize();
  if (!model.document.has_work() || model.document.work().size() < 2 ||
      room_px.y < kLeastRoomEm * em)
    return 0.0f;
  const Timeline timeline = timeline_of(model.document.work());
  const float rows = static_cast<float>(std::min(timeline.rows, kMostRowsShown));
  const bool scrolls = scale_px_per_s(timeline, room_px.x) >
                       (room_px.x - kAroundEm * em) / static_cast<float>(timeline.seconds);
  return std::ceil((kRowEm * rows + 0.9f) * em +
                   (scrolls ? ImGui::GetStyle().ScrollbarSize : 0.0f));
}

void draw_timeline(const ViewModel& model, Actions& actions, glm::vec2 corner_px,
                   glm::vec2 size_px) {
  const float em = ImGui::GetFontSize();
  const Timeline timeline = timeline_of(model.document.work());
  ImGui::SetNextWindowPos({corner_px.x, corner_px.y});
  ImGui::SetNextWindowSize({size_px.x, size_px.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0.6f * em, 0.4f * em));
  ImGui::Begin("##timeline", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_HorizontalScrollbar);
  const float start_px = kStartEm * em;
  const float px_per_s = scale_px_per_s(timeline, size_px.x);
  const Scale scale{ImGui::GetCursorScreenPos(), px_per_s, kRowEm * em, start_px};
  // Disabled while a dialog is open.
  const bool live = model.ui.shows<NoDialog>();
  if (draw_start(model, scale) && live) actions.emplace_back(GoToStroke{0});
  for (const TimelineBlock& block : timeline.blocks) draw_block(model, block, scale);
  if (live) handle_mouse(model, timeline, scale, actions);
  draw_moment(model, timeline, scale);
  ImGui::SetCursorScreenPos(
      {scale.origin.x, scale.origin.y + scale.row_px * static_cast<float>(timeline.rows) - 1.0f});
  ImGui::Dummy({start_px + px_per_s * static_cast<float>(timeline.seconds), 1.0f});
  scroll_to_present(model, timeline, scale);
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace clay::studio
