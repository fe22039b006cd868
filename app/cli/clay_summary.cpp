#include "app/cli/clay_summary.hpp"

#include "app/cli/maker_table.hpp"
#ifdef CLAYSTACK_EXPORT
#include "claystack/export/job.hpp"
#endif

#include "core/size_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace clay::cli {
namespace {

Json collapse_json(const Collapse& fall, double ring_mm) {
  return {{"ring", fall.failed_ring},
          {"height_mm", (static_cast<double>(fall.failed_ring) + 0.5) * ring_mm},
          {"stress_kpa", fall.stress_kpa},
          {"threshold_kpa", fall.threshold_kpa},
          {"parted", fall.parted()},
          {"angle_deg", fall.angle_rad * 180.0 / std::numbers::pi},
          {"shift_mm", {fall.shift_mm.x, fall.shift_mm.y, fall.shift_mm.z}},
          {"energy_lost_mj", fall.energy_lost_mj},
          {"plastic_work_mj", fall.plastic_work_mj}};
}

#ifdef CLAYSTACK_EXPORT
/// The heights at which the upper piece does not touch the lower one.
Json parted_at(const ClayStack& stack, const std::vector<solid::PieceShape>& pieces) {
  Json heights = Json::array();
  for (std::size_t i = 1; i < pieces.size(); ++i)
    heights.push_back(stack.ring_height_mm() * static_cast<double>(pieces[i].first_ring));
  return heights;
}
#endif

void add_export([[maybe_unused]] const Pot& pot, Json& json) {
  json["min_wall_mm"] = json["maker"] = json["pieces"] = json["parted_at_mm"] = nullptr;
#ifdef CLAYSTACK_EXPORT
  solid::ExportOptions options;
  options.allow_pieces = true;
  const auto report = solid::run_export(pot, {}, options);
  if (!report) return;
  const auto& pieces = report->section.shapes();
  json["pieces"] = report->collapsed ? report->collapsed->pieces : pieces.size();
  if (!report->collapsed) json["parted_at_mm"] = parted_at(pot.stack, pieces);
  if (!report->collapsed) json["min_wall_mm"] = report->walls.min_wall_mm;
  json["maker"] = maker_json(*report);
#endif
}

void print_collapse(const Console& console, const Json& summary) {
  if (!summary["collapsed"].get<bool>()) return;
  const Json& fall = summary["collapse"];
  const auto place = fmt::format("the clay at a height of {:.1f} mm (ring {})",
                                 number_field(fall, "height_mm"), fall["ring"].get<std::size_t>());
  const auto carried = fall["stress_kpa"].get<double>(), most = fall["threshold_kpa"].get<double>();
  const int decimals = decimals_apart(carried, most, 3);
  const std::string reason =
      fall["parted"].get<bool>()
          ? place + " no longer touches the clay above it"
          : fmt::format("{} carried {:.{}f} kPa, more than the limit of {:.{}f} kPa", place,
                        carried, decimals, most, decimals);
  console.print(
      fmt::format("collapsed: {}; the part above came to rest, tilted by {:.0f} degrees; it lost "
                  "{:.1f} mJ of energy, {:.1f} mJ of that by deforming the clay below",
                  reason, std::abs(number_field(fall, "angle_deg")),
                  fall["energy_lost_mj"].get<double>(), fall["plastic_work_mj"].get<double>()));
}

/// "in 3 pieces that do not touch, parted at heights of 20.3 and 41.0 mm".
std::string pieces_text(const Json& summary) {
  constexpr std::size_t kMostShown = 4;
  const Json& heights = summary["parted_at_mm"];
  std::string text;
  for (std::size_t i = 0; i < std::min(heights.size(), kMostShown); ++i)
    text += fmt::format("{}{:.1f}", i == 0 ? "" : ", ", heights[i].get<double>());
  if (heights.size() > kMostShown) text += ", ...";
  return fmt::format(
      "in {} pieces that do not touch, parted at {} {} mm; claystack export --pieces writes them",
      summary["pieces"].get<std::size_t>(), heights.size() == 1 ? "a height of" : "heights of",
      text);
}

std::string verdict_of(const Json& summary) {
  const std::string error =
      fmt::format("volume error {} quanta", summary["volume_error_quanta"].dump());
  if (summary["collapsed"].get<bool>()) return "collapsed; " + error;
  if (summary["maker"].is_null()) return "stands, but cannot be exported; " + error;
  const Json& parted = summary["parted_at_mm"];
  return (parted.is_null() || parted.empty() ? "stands" : pieces_text(summary)) + "; " + error;
}

}  // namespace

const char* name_of(Model model) { return model == Model::paper ? "paper" : "conserving"; }

Json clay_json(const Pot& pot) {
  const ClayStack& stack = pot.stack;
  Json json = {
      {"rings", stack.size()},
      {"height_mm", stack.height_mm()},
      {"volume_mm3", stack.volume_mm3()},
      {"trimmed_mm3", static_cast<double>(pot.ledger.trimmed) * stack.mm3_per_quantum()},
      {"volume_error_quanta", json_count(pot.ledger.volume_error(stack.recount()))},
      {"collapsed", pot.collapse.has_value()},
  };
  add_export(pot, json);
  if (pot.collapse) json["collapse"] = collapse_json(*pot.collapse, stack.ring_height_mm());
  return json;
}

void print_clay(const Console& console, const Json& summary) {
  const std::string size = fmt::format(
      "{} rings, {:.2f} mm high, {:.3f} cm3 of clay, {:.3f} cm3 trimmed",
      summary["rings"].get<std::size_t>(), summary["height_mm"].get<double>(),
      summary["volume_mm3"].get<double>() / 1000.0, summary["trimmed_mm3"].get<double>() / 1000.0);
  console.detail(size);
  print_collapse(console, summary);
  print_maker_table(console, summary["maker"],
                    summary["min_wall_mm"].is_null()
                        ? std::string()
                        : at_least_mm(summary["min_wall_mm"].get<double>(), 2),
                    verdict_of(summary));
}

}  // namespace clay::cli
