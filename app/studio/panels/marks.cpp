// Marks over the view: results of the checks and problems of an export, at their places on the pot,
// and the scale of the wall map.

#include "app/render/legend.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

namespace clay::studio {
namespace {

constexpr float kLeastViewEm = 18.0f;  // minimum height of the view for the scale
constexpr float kNarrowViewEm = 32.0f;
constexpr int kSteps = 5;
constexpr float kNoteEm = 10.0f;  // width of the note below the scale

ImU32 colour_of(const render::Swatch& swatch) {
  return IM_COL32(swatch.red, swatch.green, swatch.blue, 255);
}

/// The same where the pot is darkest: half of the light (clay_fragment in render/shaders.cpp). The
/// scale shows every colour of a wall, from shade at the left to light at the right.
ImU32 in_shade(const render::Swatch& swatch) {
  const auto shade = [](int channel) {
    return static_cast<int>(std::lround(channel * std::pow(0.5, 1.0 / 2.2)));
  };
  return IM_COL32(shade(swatch.red), shade(swatch.green), shade(swatch.blue), 255);
}

/// Text beside the scale, and its place from the scale's upper left corner.
struct ScaleLabel {
  ImVec2 at;
  std::string text;
};

/// In a narrow view the numbers alone: the panel of the walls has the rest.
std::vector<ScaleLabel> texts_of_scale(const PotCheck& check, const ImVec2& bar, LengthUnit unit,
                                       bool narrow) {
  const float em = ImGui::GetFontSize();
  const render::WallMap map = wall_map_of(check);
  std::vector<ScaleLabel> texts{{{0.0f, -1.9f * em}, narrow ? "Wall" : "Wall thickness"}};
  for (int step = 0; step <= kSteps; ++step)
    texts.push_back(
        {{bar.x + 0.6f * em, bar.y * (1.0f - static_cast<float>(step) / kSteps) - 0.5f * em},
         length_text(map.top_mm * step / kSteps, unit) +
             (step == kSteps && !narrow ? " or more" : "")});
  if (check.limit && !narrow)
    texts.push_back({{0.0f, bar.y + 0.9f * em},
                     wrapped(fmt::format("Hatched red: below {}, {}",
                                         length_text(check.limit->min_wall_mm, unit),
                                         process_title(check.limit->process)),
                             kNoteEm * em)});
  return texts;
}

/// The scale of the wall map: the same range for every pot, with the limit marked.
void draw_scale(const PotCheck& check, const ViewRect& rect, float top_px, LengthUnit unit) {
  const float em = ImGui::GetFontSize(), pad = 0.7f * em;
  if (rect.size_px.y < kLeastViewEm * em) return;
  const render::WallMap map = wall_map_of(check);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  const ImVec2 bar(1.1f * em, std::round(std::min(11.0f * em, 0.45f * rect.size_px.y)));
  const ImVec2 low(std::round(rect.corner_px.x + 1.4f * em), std::round(top_px + 2.8f * em));
  const std::vector<ScaleLabel> texts =
      texts_of_scale(check, bar, unit, rect.size_px.x < kNarrowViewEm * em);
  ImVec2 high(low.x + bar.x, low.y + bar.y);
  for (const ScaleLabel& text : texts) {
    const ImVec2 size = ImGui::CalcTextSize(text.text.c_str());
    high = {std::max(high.x, low.x + text.at.x + size.x),
            std::max(high.y, low.y + text.at.y + size.y)};
  }
  draw->AddRectFilled({low.x - pad, low.y + texts.front().at.y - 0.7f * pad},
                      {high.x + pad, high.y + 0.7f * pad},
                      ImGui::GetColorU32(ImGuiCol_PopupBg, kOverView), 0.4f * em);
  for (int px = 0; px < static_cast<int>(bar.y); ++px) {
    const double wall = map.top_mm * (1.0 - (px + 0.5) / static_cast<double>(bar.y));
    const render::Swatch swatch = render::wall_swatch(map, wall);
    const float y = low.y + static_cast<float>(px);
    draw->AddRectFilledMultiColor({low.x, y}, {low.x + bar.x, y + 1.0f}, in_shade(swatch),
                                  colour_of(swatch), colour_of(swatch), in_shade(swatch));
  }
  for (int step = 0; step <= kSteps; ++step) {
    const float y = low.y + bar.y * (1.0f - static_cast<float>(step) / kSteps);
    draw->AddLine({low.x + bar.x, y}, {low.x + bar.x + 0.3f * em, y}, ink);
  }
  for (const ScaleLabel& text : texts)
    draw->AddText({low.x + text.at.x, low.y + text.at.y}, ink, text.text.c_str());
}

/// The pixel of a place on the pot, which stands on its rim while its foot is trimmed.
std::optional<glm::vec2> pixel_on_pot(const ViewModel& model, glm::dvec2 place_mm) {
  if (model.upside_down()) place_mm.y = model.stroke.view().height_mm - place_mm.y;
  return model.scene.pixel_of(place_mm);
}

/// A ring that is seen on any colour of the pot: its rim contrasts with it.
void draw_ring(ImDrawList* draw, glm::vec2 at, float radius, const ImVec4& colour, float width) {
  constexpr float kRim = 2.2f;  // as wide as the ring
  draw->AddCircle({at.x, at.y}, radius, ImGui::GetColorU32(ink_on(colour)), 0, kRim * width);
  draw->AddCircle({at.x, at.y}, radius, ImGui::GetColorU32(colour), 0, width);
}

/// A circle around the thinnest place, with its thickness.
void mark_thinnest(const ViewModel& model, const PotCheck& check, ImDrawList* draw) {
  const float em = ImGui::GetFontSize();
  const glm::dvec2 middle = 0.5 * (glm::abs(check.thinnest_from) + glm::abs(check.thinnest_to));
  const auto at = pixel_on_pot(model, middle);
  if (!at || !model.scene.rect().holds(*at)) return;
  const ImVec4 colour =
      check.thin() ? model.colours().fault : ImGui::GetStyleColorVec4(ImGuiCol_Text);
  draw_ring(draw, *at, 0.6f * em, colour, 0.15f * em);
  shaded_text(draw, {at->x + em, at->y - 0.5f * em},
              thickness_text(check.thinnest_mm, model.settings.unit), colour);
}

/// The height at which the pot consists of two parts.
void mark_fault(const ViewModel& model, double y_mm, ImDrawList* draw) {
  const ImVec4 colour = model.colours().fault;
  const double reach_mm = 1.2 * render::extent_of(model.stroke.view()).radius_mm;
  const auto left = pixel_on_pot(model, {-reach_mm, y_mm});
  const auto right = pixel_on_pot(model, {reach_mm, y_mm});
  if (!left || !right) return;
  draw->AddLine({left->x, left->y}, {right->x, right->y}, ImGui::GetColorU32(colour),
                0.15f * ImGui::GetFontSize());
  shaded_text(draw,
              {right->x + 0.3f * ImGui::GetFontSize(), right->y - 0.5f * ImGui::GetFontSize()},
              "not proved here", colour);
}

}  // namespace

void draw_marks(const ViewModel& model, const ViewRect& rect, float top_px) {
  const auto& check = model.readings.check();
  if (!check || !model.ui.shows<NoDialog>() || model.readings.fallen()) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({rect.corner_px.x, rect.corner_px.y},
                     {rect.corner_px.x + rect.size_px.x, rect.corner_px.y + rect.size_px.y});
  if (check->fault_mm && panel_open(model.settings, model.ui, "certificate"))
    mark_fault(model, *check->fault_mm, draw);
  const bool open = model.settings.wall_map && model.scene.cut != render::Cut::none;
  if (check->proved && (open || check->thin()) && !model.has_marks())
    mark_thinnest(model, *check, draw);
  if (check->proved && model.settings.wall_map)
    draw_scale(*check, rect, top_px, model.settings.unit);
  draw->PopClipRect();
}

namespace {

/// A circle around the place and a line to its text, kept within the view.
void draw_mark(const ViewModel& model, const ViewRect& rect, const Mark& mark, glm::vec2 at,
               float top) {
  const float em = ImGui::GetFontSize();
  // Only the problem; the dialog lists its source and further places.
  const std::string text =
      wrapped(sentence(mark.text.substr(0, std::min(mark.text.find(';'), mark.text.find(" (")))),
              std::min(16.0f * em, 0.45f * rect.size_px.x));
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float right = rect.corner_px.x + rect.size_px.x;
  const ImVec2 corner(std::max(rect.corner_px.x + em, right - size.x - 1.5f * em), top);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImU32 colour = ImGui::GetColorU32(model.colours().warning);
  const ImVec2 low(corner.x - 0.5f * em, corner.y - 0.4f * em);
  const ImVec2 high(corner.x + size.x + 0.5f * em, corner.y + size.y + 0.4f * em);
  const glm::vec2 foot(0.5f * (low.x + high.x), high.y);
  const float ring = 0.7f * em, away = glm::distance(foot, at);
  if (away > ring) {
    const glm::vec2 edge = at + (ring / away) * (foot - at);
    draw->AddLine({edge.x, edge.y}, {foot.x, foot.y}, colour, 0.12f * em);
  }
  draw_ring(draw, at, ring, model.colours().warning, 0.16f * em);
  draw->AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_PopupBg), 0.3f * em);
  draw->AddRect(low, high, colour, 0.3f * em);
  draw->AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace

void draw_export_marks(const ViewModel& model, const ViewRect& rect, float top_px) {
  if (!model.ui.shows<NoDialog>() || !model.has_marks()) return;
  const float em = ImGui::GetFontSize();
  float top = top_px + 1.2f * em;
  for (const Mark& mark : model.ui.marks) {
    const auto at = pixel_on_pot(model, mark.place_mm);
    if (!at || !rect.holds(*at)) continue;
    draw_mark(model, rect, mark, *at, top);
    top += 6.0f * em;
  }
}

}  // namespace clay::studio
