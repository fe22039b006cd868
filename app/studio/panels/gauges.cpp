// What the hand would feel, and what stands on the wheel.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay::studio {
namespace {

double limit_n(const AppState& shop) {
  return shop.potter.has_work() && shop.potter.scene().force ? shop.potter.scene().force->limit_n
                                                             : 5.0;
}

struct Measures {
  double widest_mm = 0.0, grams = 0.0;
};

Measures measures_of(const AppState& shop) {
  const render::PotView& pot = shop.potter.view();
  Measures m;
  double sum_mm2 = 0.0;
  for (const render::Row& row : pot.rows) {
    const double outer = row.outer_mm, inner = row.inner_mm;
    m.widest_mm = std::max(m.widest_mm, 2.0 * outer);
    sum_mm2 += outer * outer - inner * inner;
  }
  if (!pot.rows.empty())
    m.grams = 1e-3 * shop.potter.scene().lump.density_g_cm3 * std::numbers::pi * sum_mm2 *
              pot.height_mm / static_cast<double>(pot.rows.size());
  return m;
}

}  // namespace

void draw_force(AppState& shop) {
  const servo::LiveStatus& status = shop.potter.status();
  const double newtons = shop.potter.throwing() ? glm::length(status.clay_n) : 0.0;
  const double limit = limit_n(shop);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight();
  const float part = static_cast<float>(std::clamp(newtons / limit, 0.0, 1.0));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float round = ImGui::GetStyle().FrameRounding;
  draw->AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                      round);
  const ImVec4 colour = part >= 1.0f ? shop.colours().warning : shop.colours().accent;
  if (part > 0.0f)
    draw->AddRectFilled(at, {at.x + part * width, at.y + height}, ImGui::GetColorU32(colour),
                        round);
  const std::string text = fmt::format("{:.2f} N of {:g} N", newtons, limit);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 corner(at.x + 0.5f * (width - size.x), at.y + 0.5f * (height - size.y));
  const float end = at.x + part * width;  // of the bar: beyond it the ground is another
  const auto text_between = [&](float left, float right, const ImVec4& ink) {
    draw->PushClipRect({left, at.y}, {right, at.y + height}, true);
    draw->AddText(corner, ImGui::GetColorU32(ink), text.c_str());
    draw->PopClipRect();
  };
  text_between(at.x, end, ink_on(colour));
  text_between(end, at.x + width, ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::Dummy({width, height});
  faint_text(shop.colours(), part >= 1.0f              ? "As much as the hand is ever given"
                             : !shop.potter.throwing() ? "No tool in the clay"
                             : status.contact          ? "The clay pushes back"
                                                       : "Beside the clay");
}

void draw_pot(AppState& shop) {
  if (!shop.potter.has_work()) return faint_text(shop.colours(), "No clay on the wheel");
  const Measures m = measures_of(shop);
  const LengthUnit unit = shop.settings.unit;
  const Palette& colours = shop.colours();
  value_row(colours, "Height", length_text(shop.potter.view().height_mm, unit));
  value_row(colours, "Widest", length_text(m.widest_mm, unit));
  value_row(colours, "Clay",
            m.grams < 1000.0 ? fmt::format("{:.0f} g", m.grams)
                             : fmt::format("{:.2f} kg", 1e-3 * m.grams));
}

}  // namespace clay::studio
