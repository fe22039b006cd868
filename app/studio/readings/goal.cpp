#include "app/studio/readings/goal.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::studio {

GoalReading read_goal(const PotGoal& goal, const solid::MakerNumbers& numbers, LengthUnit unit) {
  const solid::PotState& pot = numbers.in_use();
  GoalReading reading;
  const auto add = [&](double asked, double found, const std::string& text) {
    if (asked <= 0.0) return;
    reading.met = reading.met && std::abs(found - asked) <= kGoalPart * asked;
    reading.text += (reading.text.empty() ? "" : ", ") + text;
  };
  const UnitText u = unit_text(unit);
  const auto of_mm = [&](double found, double asked) {
    return fmt::format("{:.{}f} of {:.{}f} {}", found / u.mm, u.digits, asked / u.mm, u.digits,
                       u.name);
  };
  add(goal.holds_ml, pot.capacity_ml,
      fmt::format("holds {:.0f} of {:.0f} ml", pot.capacity_ml, goal.holds_ml));
  add(goal.height_mm, pot.size.height_mm, of_mm(pot.size.height_mm, goal.height_mm) + " high");
  add(goal.diameter_mm, pot.size.diameter_mm,
      of_mm(pot.size.diameter_mm, goal.diameter_mm) + " across");
  if (numbers.fired && !reading.text.empty()) reading.text += " after firing";
  if (!reading.text.empty() && reading.text.front() == 'h') reading.text.front() = 'H';
  return reading;
}

}  // namespace clay::studio
