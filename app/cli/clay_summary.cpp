#include "app/cli/clay_summary.hpp"

#ifdef CLAYSTACK_EXPORT
#include "claystack/export/job.hpp"
#endif

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace clay::cli {
namespace {

Json collapse_json(const Collapse& fall) {
  return {{"ring", fall.failed_ring},
          {"stress_kpa", fall.stress_kpa},
          {"threshold_kpa", fall.threshold_kpa},
          {"angle_deg", fall.angle_rad * 180.0 / std::numbers::pi},
          {"shift_mm", {fall.shift_mm.x, fall.shift_mm.y, fall.shift_mm.z}},
          {"energy_lost_mj", fall.energy_lost_mj},
          {"plastic_work_mj", fall.plastic_work_mj}};
}

Json wall_json([[maybe_unused]] const Pot& pot) {
#ifdef CLAYSTACK_EXPORT
  if (!pot.collapse)
    if (const auto report = solid::run_export(pot, {}, {})) return report->walls.min_wall_mm;
#endif
  return nullptr;
}

}  // namespace

const char* name_of(Model model) { return model == Model::paper ? "paper" : "conserving"; }

Json clay_json(const Wheel& wheel, const Pot& pot) {
  const ClayStack& stack = wheel.stack();
  Json json = {
      {"rings", stack.size()},
      {"height_mm", stack.height_mm()},
      {"volume_mm3", stack.volume_mm3()},
      {"trimmed_mm3", static_cast<double>(wheel.ledger().trimmed) * stack.mm3_per_quantum()},
      {"volume_error_quanta", json_count(wheel.ledger().volume_error(stack.recount()))},
      {"min_wall_mm", wall_json(pot)},
      {"collapsed", pot.collapse.has_value()},
  };
  if (pot.collapse) json["collapse"] = collapse_json(*pot.collapse);
  return json;
}

void print_collapse(const Console& console, const Json& summary) {
  if (!summary["collapsed"].get<bool>()) return;
  const Json& fall = summary["collapse"];
  console.print(fmt::format(
      "collapsed: ring {} carried {:.3f} kPa, more than the limit of {:.3f} kPa; the part above "
      "came to rest at {:.0f} degrees and lost {:.1f} mJ, {:.1f} of them by deforming the clay "
      "below",
      fall["ring"].get<std::size_t>(), fall["stress_kpa"].get<double>(),
      fall["threshold_kpa"].get<double>(), fall["angle_deg"].get<double>(),
      fall["energy_lost_mj"].get<double>(), fall["plastic_work_mj"].get<double>()));
}

}  // namespace clay::cli
