// Where every gram of the clay is.

#include "app/studio/panels/panels.hpp"
#include "app/studio/panels/widgets.hpp"

#include <fmt/format.h>

namespace clay::studio {

void draw_ledger(AppState& shop) {
  const Palette& colours = shop.colours();
  const Readings& readings = shop.readings;
  if (readings.stack() == nullptr) return faint_text(colours, "No clay on the wheel");
  const ClayAccount& account = readings.account();
  value_row(colours, "At the beginning", mass_text(account.initial_g));
  if (account.added_g != 0.0) value_row(colours, "Put on since", mass_text(account.added_g));
  value_row(colours, "In the stack", mass_text(account.in_stack_g));
  value_row(colours, "Trimmed off", mass_text(account.trimmed_g));
  if (account.outside_g != 0.0) value_row(colours, "Waiting outside", mass_text(account.outside_g));
  const bool sound = account.unaccounted == "0";
  ImGui::TextColored(sound ? colours.good : colours.fault, "%s",
                     fmt::format("Unaccounted for: {} quanta", account.unaccounted).c_str());
  if (!sound) faint_text(colours, fmt::format("{:g} g", account.unaccounted_g));
  if (readings.fallen()) return faint_text(colours, "What has fallen holds nothing.");
  value_row(colours, "Holds, to the brim", capacity_text(account.capacity_mm3));
}

}  // namespace clay::studio
