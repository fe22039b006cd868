// How thick the walls are, and how thick they must be.

#include "app/render/legend.hpp"
#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

namespace clay::studio {
namespace {

constexpr std::size_t kMostStretches = 3;

void say_where(const PotCheck& check, const Palette& colours, LengthUnit unit) {
  const std::vector<Stretch> stretches = thin_stretches(check);
  for (std::size_t i = 0; i < std::min(stretches.size(), kMostStretches); ++i)
    faint_text(colours,
               fmt::format("Too thin from {} to {}", length_text(stretches[i].from_mm, unit),
                           length_text(stretches[i].to_mm, unit)));
  if (stretches.size() > kMostStretches)
    faint_text(colours, fmt::format("and at {} more heights", stretches.size() - kMostStretches));
}

}  // namespace

void draw_walls(AppState& shop) {
  const Palette& colours = shop.colours();
  ImGui::Checkbox("Thickness as colours", &shop.settings.wall_map);
  ImGui::SetNextItemWidth(-1.0f);
  choose_process(shop, "No process", shop.settings.process);
  const auto& check = shop.readings.check();
  if (shop.readings.stack() == nullptr || !check)
    return faint_text(colours, "No clay on the wheel");
  ImGui::PushStyleColor(ImGuiCol_Text, check->thin()  ? colours.warning
                                       : check->limit ? colours.good
                                                      : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::TextWrapped("%s", wall_text(*check, shop.settings.unit).c_str());
  ImGui::PopStyleColor();
  say_where(*check, colours, shop.settings.unit);
  if (check->limit) faint_text(colours, check->limit->source);
}

}  // namespace clay::studio
