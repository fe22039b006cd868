#include "app/cli/maker_table.hpp"

#include "core/size_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace clay::cli {
namespace {

#ifdef CLAYSTACK_EXPORT
/// A collapsed pot has neither foot nor capacity; one without a floor or an opening has no
/// capacity.
Json state_json(const solid::PotState& state, bool stands, bool holds) {
  const auto if_standing = [&](double number) { return stands ? Json(number) : Json(nullptr); };
  const auto if_holding = [&](double number) { return holds ? Json(number) : Json(nullptr); };
  return {{"diameter_mm", state.size.diameter_mm},
          {"height_mm", state.size.height_mm},
          {"foot_diameter_mm", if_standing(state.size.foot_diameter_mm)},
          {"weight_g", state.weight_g},
          {"capacity_ml", if_holding(state.capacity_ml)},
          {"to_line_ml", if_holding(state.to_line_ml)},
          {"inside_cm2", if_standing(state.inside_cm2)},
          {"outside_cm2", if_standing(state.outside_cm2)}};
}

Json balance_json(const solid::Balance& balance) {
  return {{"centre_mm", balance.centre_mm}, {"tipping_deg", balance.tipping_deg}};
}
#endif

/// "500 g wet, 364 g fired"; "500 g" if the shrinkage is not known. Sizes and capacities also
/// under the glaze.
template <class Text>
std::string by_state(const Json& numbers, Text text, bool under_glaze = true) {
  const bool fired = !numbers["fired"].is_null();
  const bool glazed = under_glaze && !numbers["glazed"].is_null();
  std::string all = text(numbers["thrown"]);
  if (fired || glazed) all += " wet";
  if (fired) all += ", " + text(numbers["fired"]) + " fired";
  if (glazed) all += ", " + text(numbers["glazed"]) + " glazed";
  return all;
}

/// The state to which the fill line belongs.
const Json& used_state(const Json& numbers) {
  for (const char* state : {"glazed", "fired"})
    if (!numbers[state].is_null()) return numbers[state];
  return numbers["thrown"];
}

std::string extent_text(const Json& state) {
  return fmt::format("{} mm wide, {} mm high", size_text(number_field(state, "diameter_mm"), 1),
                     size_text(number_field(state, "height_mm"), 1));
}

std::string weight_text(const Json& state) {
  return size_text(number_field(state, "weight_g"), 0) + " g";
}

std::string capacity_text(const Json& state) {
  return size_text(number_field(state, "capacity_ml"), 0) + " ml";
}

std::string capacity_row(const Json& numbers) {
  const bool fired = !numbers["fired"].is_null(), glazed = !numbers["glazed"].is_null();
  const Json& used = used_state(numbers);
  if (!numbers["no_capacity"].is_null())
    return "none: " + numbers["no_capacity"].get<std::string>();
  if (used["capacity_ml"].is_null()) return "none: the pot collapsed";
  const std::string to_brim = by_state(numbers, capacity_text) + " to the brim; ";
  const double to_line_ml = number_field(used, "to_line_ml");
  const double line_mm = number_field(numbers, "fill_line_mm");
  if (to_line_ml <= 0.0)
    return to_brim + fmt::format("the fill line, {:g} mm below it, is below the floor", line_mm);
  return to_brim + fmt::format("{} ml to {:g} mm below it{}", size_text(to_line_ml, 0), line_mm,
                               glazed  ? ", glazed"
                               : fired ? ", fired"
                                       : "");
}

/// The surface that glaze may cover, of the pot in use.
std::string surface_row(const Json& numbers) {
  const bool fired = !numbers["fired"].is_null();
  const Json& used = fired ? numbers["fired"] : numbers["thrown"];
  if (used["inside_cm2"].is_null()) return {};
  return fmt::format("{} cm2 inside, {} cm2 outside without the foot{}",
                     size_text(number_field(used, "inside_cm2"), 0),
                     size_text(number_field(used, "outside_cm2"), 0), fired ? ", fired" : "");
}

}  // namespace

#ifdef CLAYSTACK_EXPORT
namespace {

Json maker_json(const solid::MakerNumbers& numbers, bool stands) {
  const solid::ClayFigures& clay = numbers.clay;
  const bool holds = stands && numbers.no_capacity.empty();
  Json json = {{"clay",
                {{"density_g_cm3", clay.density_g_cm3},
                 {"shrinkage", clay.shrinkage},
                 {"drying_shrinkage", clay.drying_shrinkage.value_or(0.5 * clay.shrinkage)},
                 {"water", clay.water},
                 {"ignition_loss", clay.ignition_loss}}},
               {"fill_line_mm", numbers.fill_line_mm},
               {"thrown", state_json(numbers.thrown, stands, holds)},
               {"dry", nullptr},
               {"fired", nullptr},
               {"glazed", nullptr},
               {"no_capacity", nullptr},
               {"empty", nullptr},
               {"full", nullptr}};
  if (numbers.dry) json["dry"] = state_json(*numbers.dry, stands, holds);
  if (numbers.fired) json["fired"] = state_json(*numbers.fired, stands, holds);
  if (numbers.glazed) json["glazed"] = state_json(*numbers.glazed, stands, holds);
  if (!numbers.no_capacity.empty()) json["no_capacity"] = numbers.no_capacity;
  if (stands) json["empty"] = balance_json(numbers.empty);
  if (numbers.full) json["full"] = balance_json(*numbers.full);
  return json;
}

}  // namespace

Json maker_json(const solid::ExportReport& report) {
  if (report.maker) return maker_json(*report.maker, true);
  return report.fallen ? maker_json(*report.fallen, false) : Json(nullptr);
}
#endif

void print_maker_table(const Console& console, const Json& numbers, const std::string& wall,
                       const std::string& verdict) {
  const auto row = [&](const char* name, const std::string& text) {
    if (!text.empty()) console.print(fmt::format("{:<10}{}", name, text));
  };
  if (!numbers.is_null()) {
    row("size", by_state(numbers, extent_text));
    row("weight", by_state(numbers, weight_text, false));
    row("capacity", capacity_row(numbers));
    row("surface", surface_row(numbers));
  }
  row("wall", wall);
  row("verdict", verdict);
}

std::string at_least_mm(double bound_mm, int decimals) {
  return "at least " + bound_text(bound_mm, decimals) + " mm";
}

}  // namespace clay::cli
