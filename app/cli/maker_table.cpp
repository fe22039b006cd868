#include "app/cli/maker_table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

#ifdef CLAYSTACK_EXPORT
Json state_json(const solid::PotState& state) {
  return {{"diameter_mm", state.size.diameter_mm},
          {"height_mm", state.size.height_mm},
          {"foot_diameter_mm", state.size.foot_diameter_mm},
          {"weight_g", state.weight_g},
          {"capacity_ml", state.capacity_ml},
          {"to_line_ml", state.to_line_ml}};
}

Json balance_json(const solid::Balance& balance) {
  return {{"centre_mm", balance.centre_mm}, {"tipping_deg", balance.tipping_deg}};
}
#endif

/// "500 g as thrown, 364 g fired"; "500 g" if the shrinkage is not known.
template <class Text>
std::string by_state(const Json& numbers, Text text) {
  if (numbers["fired"].is_null()) return text(numbers["thrown"]);
  return text(numbers["thrown"]) + " as thrown, " + text(numbers["fired"]) + " fired";
}

std::string size_text(const Json& state) {
  return fmt::format("{:.1f} mm wide, {:.1f} mm high", number_in(state, "diameter_mm"),
                     number_in(state, "height_mm"));
}

std::string weight_text(const Json& state) {
  return fmt::format("{:.0f} g", number_in(state, "weight_g"));
}

std::string capacity_text(const Json& state) {
  return fmt::format("{:.0f} ml", number_in(state, "capacity_ml"));
}

std::string capacity_row(const Json& numbers) {
  const bool fired = !numbers["fired"].is_null();
  const Json& used = fired ? numbers["fired"] : numbers["thrown"];
  if (number_in(used, "capacity_ml") <= 0.0) return "none: no floor under an open bore";
  return by_state(numbers, capacity_text) +
         fmt::format(" to the brim; {:.0f} ml to {:g} mm below it{}", number_in(used, "to_line_ml"),
                     number_in(numbers, "fill_line_mm"), fired ? ", fired" : "");
}

}  // namespace

#ifdef CLAYSTACK_EXPORT
Json maker_json(const solid::MakerNumbers& numbers) {
  const solid::ClayFigures& clay = numbers.clay;
  Json json = {{"clay",
                {{"density_g_cm3", clay.density_g_cm3},
                 {"shrinkage", clay.shrinkage},
                 {"drying_shrinkage", clay.drying_shrinkage.value_or(0.5 * clay.shrinkage)},
                 {"water", clay.water},
                 {"ignition_loss", clay.ignition_loss}}},
               {"fill_line_mm", numbers.fill_line_mm},
               {"thrown", state_json(numbers.thrown)},
               {"dry", nullptr},
               {"fired", nullptr},
               {"empty", balance_json(numbers.empty)},
               {"full", nullptr}};
  if (numbers.dry) json["dry"] = state_json(*numbers.dry);
  if (numbers.fired) json["fired"] = state_json(*numbers.fired);
  if (numbers.full) json["full"] = balance_json(*numbers.full);
  return json;
}
#endif

void print_maker_table(const Console& console, const Json& numbers, const std::string& wall,
                       const std::string& verdict) {
  const auto row = [&](const char* name, const std::string& text) {
    if (!text.empty()) console.print(fmt::format("{:<10}{}", name, text));
  };
  if (!numbers.is_null()) {
    row("size", by_state(numbers, size_text));
    row("weight", by_state(numbers, weight_text));
    row("capacity", capacity_row(numbers));
  }
  row("wall", wall);
  row("verdict", verdict);
}

}  // namespace clay::cli
