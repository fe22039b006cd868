// The strokes so far as blocks along a line: a click goes to the end of one, a drag shows what was
// in the middle of it, from where one can go on.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "app/studio/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace clay::studio {
namespace {

constexpr float kRowEm = 1.6f, kStartEm = 3.6f, kNarrowestEm = 1.0f;
constexpr float kAroundEm = kStartEm + 1.2f;  // of the width, beside the blocks
constexpr std::size_t kMostRowsShown = 3;
constexpr float kLeastRoomEm = 26.0f;  // of the view: below it the strip goes
constexpr float kDragPx = 4.0f;        // a shake of a click is none

std::string words_of(const history::NodeView& stroke, const TimelineBlock& block) {
  constexpr std::array kModes = {"Press", "Trim", "Pinch"};
  constexpr std::array kShapes = {"sphere", "ellipse", "rib", "own tool"};
  const ToolSpec& tool = stroke.scene->tool;
  return fmt::format(
      "Stroke {}: {}, {}, {:.1f} s{}{}{}", block.node, kModes[static_cast<std::size_t>(tool.mode)],
      kShapes[tool.shape.index()], stroke.seconds,
      stroke.volume_mm3 ? fmt::format(", {:.1f} ml", 1e-3 * *stroke.volume_mm3) : std::string(),
      stroke.changed == false ? ", in the air" : "",
      stroke.children.size() > 1 ? fmt::format("; {} ways go on", stroke.children.size())
                                 : std::string());
}

ImVec4 colour_of(const history::NodeView& stroke, const Palette& colours) {
  switch (stroke.scene->tool.mode) {
    case ToolMode::trim:
      return colours.warning;
    case ToolMode::pinch:
      return colours.good;
    case ToolMode::press:
      break;
  }
  return colours.accent;
}

/// Where blocks are on the screen.
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

void draw_block(const AppState& shop, const TimelineBlock& block, const Scale& scale) {
  const float em = ImGui::GetFontSize();
  const history::Work& work = shop.potter.work();
  const history::NodeView stroke = work.view(block.node);
  const Palette& colours = shop.colours();
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

/// The pot that all began with.
bool draw_start(const AppState& shop, const Scale& scale) {
  const float em = ImGui::GetFontSize();
  const bool here = shop.potter.work().at() == 0;
  ImGui::SetCursorScreenPos({scale.origin.x, scale.origin.y + 0.12f * em});
  const ImVec4 accent = shop.colours().accent;
  if (here) ImGui::PushStyleColor(ImGuiCol_Button, accent);
  if (here) ImGui::PushStyleColor(ImGuiCol_Text, ink_on(accent));
  const bool clicked =
      ImGui::Button("Start", {scale.start_px - 0.3f * em, scale.row_px - 0.24f * em});
  if (here) ImGui::PopStyleColor(2);
  return clicked;
}

/// A long work scrolls: every stroke stays wide enough to be hit.
float scale_px_per_s(const Timeline& timeline, float width_px) {
  const float em = ImGui::GetFontSize();
  const float fitting = (width_px - kAroundEm * em) / static_cast<float>(timeline.seconds);
  return std::clamp(fitting, kNarrowestEm * em / static_cast<float>(kShortestBlockS), 8.0f * em);
}

/// The stroke that the mouse has hold of.
struct Held {
  history::NodeId node = 0;
  float from_px = 0.0f;
  bool dragged = false;
};

/// In mid-stroke, where the mouse is along the block.
void scrub_to(AppState& shop, const TimelineBlock& block, const Scale& scale) {
  const float low = scale.low(block).x, high = scale.high(block).x;
  const double part =
      std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - low) / (high - low)), 0.0, 1.0);
  shop.potter.scrub(block.node, part * shop.potter.work().view(block.node).seconds);
}

/// Where along its block the moment is that the view shows.
void draw_moment(const AppState& shop, const Timeline& timeline, const Scale& scale) {
  const auto& moment = shop.potter.moment();
  if (!moment) return;
  const auto block = std::ranges::find(timeline.blocks, moment->node, &TimelineBlock::node);
  const double whole = shop.potter.work().view(moment->node).seconds;
  if (block == timeline.blocks.end() || whole <= 0.0) return;
  const ImVec2 low = scale.low(*block), high = scale.high(*block);
  const float x = low.x + static_cast<float>(moment->seconds / whole) * (high.x - low.x);
  ImGui::GetWindowDrawList()->AddLine({x, low.y}, {x, high.y}, ImGui::GetColorU32(ImGuiCol_Text),
                                      2.0f);
}

void tell_moment(AppState& shop) {
  const Moment& moment = *shop.potter.moment();
  shop.log(fmt::format("timeline: {} at {:.3f} s", moment.node, moment.seconds));
  shop.notices.say(
      Grade::note,
      fmt::format("{:.1f} s into stroke {}: Ctrl+Shift+B, or a press on the clay, goes "
                  "on from here as a branch; Esc goes back",
                  moment.seconds, moment.node),
      1e-9 * static_cast<double>(shop.host.frame_ns()) + 8.0);
}

void handle_mouse(AppState& shop, const Timeline& timeline, const Scale& scale) {
  static std::optional<Held> held;
  const ImGuiIO& io = ImGui::GetIO();
  const float rho = (io.MousePos.y - scale.origin.y) / scale.row_px;
  const double s =
      static_cast<double>((io.MousePos.x - scale.origin.x - scale.start_px) / scale.px_per_s);
  const auto over = ImGui::IsWindowHovered() && rho >= 0.0f
                        ? block_at(timeline, s, static_cast<std::size_t>(rho))
                        : std::nullopt;
  if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
    held = Held{over->node, io.MousePos.x, false};
  if (!held) {
    if (over) ImGui::SetTooltip("%s", words_of(shop.potter.work().view(over->node), *over).c_str());
    return;
  }
  const auto block = std::ranges::find(timeline.blocks, held->node, &TimelineBlock::node);
  if (block == timeline.blocks.end()) return held.reset();
  held->dragged = held->dragged || std::abs(io.MousePos.x - held->from_px) > kDragPx;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (held->dragged) scrub_to(shop, *block, scale);
    return;
  }
  if (held->dragged && shop.potter.scrubbing()) {
    tell_moment(shop);
  } else {
    shop.log(fmt::format("timeline: {}", held->node));
    shop.potter.go_to(held->node);
  }
  held.reset();
}

}  // namespace

float timeline_height(const AppState& shop, glm::vec2 room_px) {
  const float em = ImGui::GetFontSize();
  if (!shop.potter.has_work() || shop.potter.work().size() < 2 || room_px.y < kLeastRoomEm * em)
    return 0.0f;
  const Timeline timeline = timeline_of(shop.potter.work());
  const float rows = static_cast<float>(std::min(timeline.rows, kMostRowsShown));
  const bool scrolls = scale_px_per_s(timeline, room_px.x) >
                       (room_px.x - kAroundEm * em) / static_cast<float>(timeline.seconds);
  return std::ceil((kRowEm * rows + 0.9f) * em +
                   (scrolls ? ImGui::GetStyle().ScrollbarSize : 0.0f));
}

void draw_timeline(AppState& shop, glm::vec2 corner_px, glm::vec2 size_px) {
  const float em = ImGui::GetFontSize();
  const Timeline timeline = timeline_of(shop.potter.work());
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
  // Behind a card nothing changes.
  const bool live = shop.overlay == Overlay::none;
  if (draw_start(shop, scale) && live) shop.potter.go_to(0);
  for (const TimelineBlock& block : timeline.blocks) draw_block(shop, block, scale);
  if (live) handle_mouse(shop, timeline, scale);
  draw_moment(shop, timeline, scale);
  ImGui::SetCursorScreenPos(
      {scale.origin.x, scale.origin.y + scale.row_px * static_cast<float>(timeline.rows) - 1.0f});
  ImGui::Dummy({start_px + px_per_s * static_cast<float>(timeline.seconds), 1.0f});
  // A stroke that has just been made is seen.
  static std::size_t seen = 0;
  if (seen != shop.potter.work().size()) ImGui::SetScrollX(ImGui::GetScrollMaxX());
  seen = shop.potter.work().size();
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace clay::studio
