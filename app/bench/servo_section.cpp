// Stable stiffness of the sampled arm over rate and damping, measured and compared with both
// bounds; energy; the clay; and the effect of the passivity controller. Definitions are in
// docs/haptics.md.

#include "app/bench/closed_loop/closed_loop.hpp"
#include "app/bench/section.hpp"
#include "claystack/falcon/passivity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

namespace clay::bench {
namespace {

using closed_loop::Outcome;
using falcon::SampledLoop;

// The search for a border ends at 0.1 % of the stiffness; forced swings need no search.
constexpr double kMaxBorderErrorPercent = 1.0;

/// The arm of docs/haptics.md: a light handle and one tick of delay.
SampledLoop arm_at(double rate_hz, double damping_ns_per_mm = 0.002) {
  return {rate_hz, 0.1, damping_ns_per_mm, 1};
}

std::vector<double> stiffnesses(bool quick) {
  std::vector<double> k;
  const int per_decade = quick ? 3 : 6;
  for (int n = 0; n <= 4 * per_decade; ++n)
    k.push_back(std::pow(10.0, -1.0 + static_cast<double>(n) / per_decade));
  return k;
}

Outcome at_wall(const SampledLoop& loop, double stiffness, double step_mm, bool controlled) {
  closed_loop::Experiment e = closed_loop::wall_experiment(loop, stiffness, step_mm);
  e.controlled = controlled;
  const auto wall = closed_loop::make_wall({stiffness, 5.0, true});
  return run(e, *wall);
}

Outcome at_clay(const SampledLoop& loop, const closed_loop::PressedClay& pressed, bool controlled) {
  closed_loop::Experiment e = closed_loop::clay_experiment(loop, closed_loop::kFalconStepMm);
  e.controlled = controlled;
  const auto clay = closed_loop::make_clay(pressed);
  return run(e, *clay);
}

/// 0 without a limit cycle; otherwise 0.4 at the limit, up to 1 at 100 times the limit.
double severity(double swing_mm) {
  if (swing_mm <= closed_loop::kMostSwingMm) return 0.0;
  return std::min(1.0, 0.4 + 0.3 * std::log10(swing_mm / closed_loop::kMostSwingMm));
}

struct Verdict {
  double border_error_percent = 0.0;
  double passivity_error_percent = 0.0;
  double worst_controlled_mm = 0.0;
  double worst_stable_cycle_mj = -std::numeric_limits<double>::infinity();
  int stable_cells = 0, buzzing_cells = 0;
};

/// Damping [N s/mm] that the worst of a hundred frequencies up to Nyquist needs to be passive.
double required_damping(const SampledLoop& loop, const falcon::VirtualWall& wall) {
  double required = 0.0;
  for (int waves = 1; waves <= 100; ++waves)
    required = std::max(required, closed_loop::measured_passive_damping(loop, wall, waves, 200));
  return required;
}

/// Measured over predicted, for two-sided linear walls without encoder steps or a hand, as the
/// theory assumes.
Table borders(const Effort& effort, Verdict& verdict) {
  Table table{"servo_borders",
              "Borders of a linear wall, predicted and measured",
              {{"rate", "Hz"},
               {"damping", "N s/mm"},
               {"delay", "ticks"},
               {"passive", "N/mm"},
               {"stable", "N/mm"},
               {"measured", "N/mm"},
               {"error", "%"},
               {"passivity_error", "%"}},
              {},
              "Passive: 2b/((2n+1)T). Stable: Jury's test. Measured: bisection on the growth of a "
              "free swing. Passivity error: damping required by forced swings up to Nyquist, "
              "compared with the theorem."};
  const std::vector<double> rates =
      effort.quick ? std::vector<double>{100, 1000, 8000}
                   : std::vector<double>{100, 250, 500, 1000, 2000, 4000, 8000};
  for (const double rate : rates)
    for (const double damping : {0.001, 0.002, 0.01})
      for (const int delay : {0, 1, 2}) {
        SampledLoop loop = arm_at(rate, damping);
        loop.delay_ticks = delay;
        const double predicted = stable_stiffness(loop);
        const double measured = closed_loop::measured_stable_stiffness(loop, 1e-3);
        const falcon::VirtualWall wall{passive_stiffness(loop), 0.3 * damping};
        const double required = required_damping(loop, wall);
        const double error = 100.0 * (measured / predicted - 1.0);
        const double passivity_error = 100.0 * (required / passive_damping(loop, wall) - 1.0);
        verdict.border_error_percent = std::max(verdict.border_error_percent, std::abs(error));
        verdict.passivity_error_percent =
            std::max(verdict.passivity_error_percent, std::abs(passivity_error));
        table.rows.push_back({rate, damping, static_cast<std::int64_t>(delay),
                              passive_stiffness(loop), predicted, measured, error,
                              passivity_error});
      }
  return table;
}

/// A map of stiffness over rate or damping, with both lines and the measured border.
Map lined_map(std::string id, std::string title, Axis x, std::vector<double> x_values,
              const std::vector<double>& k_values,
              const std::function<SampledLoop(double)>& loop_at) {
  Map map{std::move(id),
          std::move(title),
          std::move(x),
          {"contact stiffness [N/mm]", true},
          {},
          k_values,
          {},
          {},
          "Cells: swing of the arm at the end, 0: at most 0.2 mm, 0.4: just above it, 1: 20 mm or "
          "more."};
  Curve passive{"passive: 2b/((2n+1)T)", {}, {}, {}, {}, true, true};
  Curve stable{"stable: Jury", {}, {}, {}, {}, true, false};
  Curve accepted{"accepted", {}, {}, {}, {}, true, true};
  Curve measured{"measured border", {}, {}, {}, {}, false, false};
  for (const double at : x_values) {
    const SampledLoop loop = loop_at(at);
    for (Curve* curve : {&passive, &stable, &accepted, &measured}) curve->x.push_back(at);
    passive.y.push_back(passive_stiffness(loop));
    stable.y.push_back(stable_stiffness(loop));
    accepted.y.push_back(accepted_stiffness(loop));
    measured.y.push_back(closed_loop::measured_stable_stiffness(loop, 1e-2));
  }
  map.x_values = std::move(x_values);
  map.curves = {passive, stable, accepted, measured};
  return map;
}

template <class Cell>
void fill(Map& map, const Cell& cell) {
  for (const double k : map.y_values) {
    std::vector<double> row;
    for (const double x : map.x_values) row.push_back(cell(x, k));
    map.cells.push_back(std::move(row));
  }
}

using LoopAt = std::function<SampledLoop(double)>;

/// With and without the controller, at a wall.
void add_wall_maps(Section& section, const std::string& id, const Axis& x,
                   const std::vector<double>& x_values, const std::vector<double>& k_values,
                   const LoopAt& loop_at, Verdict& verdict) {
  for (const bool controlled : {false, true}) {
    const std::string suffix = controlled ? "_controlled" : "";
    Map map = lined_map(
        "servo_wall_by_" + id + suffix,
        std::string("Wall, by ") + id + (controlled ? ", with the passivity controller" : ", bare"),
        x, x_values, k_values, loop_at);
    fill(map, [&](double at, double k) {
      const double swing = at_wall(loop_at(at), k, closed_loop::kFalconStepMm, controlled).swing_mm;
      if (controlled) verdict.worst_controlled_mm = std::max(verdict.worst_controlled_mm, swing);
      if (!controlled) verdict.buzzing_cells += swing > closed_loop::kMostSwingMm;
      return severity(swing);
    });
    section.maps.push_back(std::move(map));
  }
}

struct ClayMap {
  const char *id, *title;
  double wall_mm;  ///< 0: solid
  bool rules;
};
constexpr ClayMap kClayMaps[] = {
    {"servo_clay", "Clay that flows at 20/s", 0.0, false},
    {"servo_clay_rules", "Solid clay with the clay rules", 0.0, true},
    {"servo_wall_rules", "A clay wall of 8 mm that bends by the clay rules", 8.0, true}};

void add_clay_maps(Section& section, const std::vector<double>& rates,
                   const std::vector<double>& k_values, Verdict& verdict) {
  for (const ClayMap& shown : kClayMaps)
    for (const bool controlled : {false, true}) {
      Map map = lined_map(
          std::string(shown.id) + (controlled ? "_controlled" : ""),
          std::string(shown.title) + (controlled ? ", with the passivity controller" : ", bare"),
          {"rate [Hz]", true}, rates, k_values, [](double rate) { return arm_at(rate); });
      map.note = "The lines are those of an elastic wall. " + map.note;
      fill(map, [&](double rate, double k) {
        const double swing =
            at_clay(arm_at(rate), {k, 20.0, 20.0, shown.wall_mm, shown.rules}, controlled).swing_mm;
        if (controlled) verdict.worst_controlled_mm = std::max(verdict.worst_controlled_mm, swing);
        return severity(swing);
      });
      section.maps.push_back(std::move(map));
    }
}

/// Energy injected per cycle over the stiffness, relative to the energy stored in the wall at rest.
Plot energy_plot(const std::vector<double>& rates, Verdict& verdict) {
  Plot plot{"servo_energy",
            "Energy that the loop injects in a cycle",
            {"stiffness / border", true},
            {"mean over the cycles / energy stored at rest", false},
            {},
            "Exact encoders; a cycle is from one deepest point to the next. Above zero the loop "
            "feeds energy to the hand. Tolerance: rounding, 1e-13 of the energy passed."};
  for (const double rate : rates) {
    Curve curve{std::to_string(static_cast<int>(rate)) + " Hz", {}, {}, {}, {}, true, false};
    for (double part = 0.2; part < 4.0; part *= 1.1) {
      const SampledLoop loop = arm_at(rate);
      const double k = part * stable_stiffness(loop);
      const auto wall = closed_loop::make_wall({k, 5.0, true});
      const Outcome o = run(closed_loop::energy_experiment(loop, k), *wall);
      if (part < 1.0) {
        ++verdict.stable_cells;
        verdict.worst_stable_cycle_mj = std::max(verdict.worst_stable_cycle_mj, o.mean_cycle_mj);
        if (k < passive_stiffness(loop))
          verdict.worst_stable_cycle_mj = std::max(verdict.worst_stable_cycle_mj, o.worst_cycle_mj);
      }
      curve.x.push_back(part);
      curve.y.push_back(o.mean_cycle_mj / (0.5 * 0.5 * 0.5 / k));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// The largest stiffness of clay before the first limit cycle: searched upward, then between the
/// last stable value and the first unstable one, to 2 %.
double max_stable_clay(double rate, double removal, const std::vector<double>& k_values) {
  const auto swings = [&](double k) {
    return at_clay(arm_at(rate), {k, removal, 20.0}, false).swing_mm > closed_loop::kMostSwingMm;
  };
  const auto first = std::ranges::find_if(k_values, swings);
  if (first == k_values.begin()) return std::numeric_limits<double>::quiet_NaN();
  double stable = *(first - 1);
  if (first == k_values.end()) return stable;
  for (double unstable = *first; unstable > 1.02 * stable;) {
    const double middle = std::sqrt(stable * unstable);
    (swings(middle) ? unstable : stable) = middle;
  }
  return stable;
}

Table clay_table(const std::vector<double>& k_values) {
  Table table{
      "servo_clay_gain",
      "Stable stiffness of clay compared with an elastic wall",
      {{"rate", "Hz"},
       {"removal", "1/s"},
       {"stable_elastic", "N/mm"},
       {"stable_up_to", "N/mm"},
       {"gain", ""}},
      {},
      "Bare loop. Stable: no swing above 0.2 mm in a stroke of 3 mm/s, searched up to 1000 N/mm: a "
      "gain at that stiffness is a lower bound. Gain: stable_up_to over stable_elastic."};
  for (const double rate : {100.0, 1000.0, 4000.0})
    for (const double removal : {0.0, 1.0, 20.0, 100.0}) {
      const double border = stable_stiffness(arm_at(rate));
      const double stable = max_stable_clay(rate, removal, k_values);
      table.rows.push_back({rate, removal, border, stable, stable / border});
    }
  return table;
}

void conclude(Section& section, const Verdict& v) {
  add_at_most(section, "border_error_percent", counted(v.border_error_percent),
              kMaxBorderErrorPercent, "maximum, relative to the stable stiffness");
  add_at_most(section, "passivity_error_percent", counted(v.passivity_error_percent),
              kMaxBorderErrorPercent, "maximum, relative to the required damping");
  section.values.push_back(
      {"stable_cells", static_cast<double>(v.stable_cells), 0.0, "of the energy plot"});
  add_at_most(section, "worst_stable_cycle_mj", counted(v.worst_stable_cycle_mj), 0.0,
              "maximum energy injected in one of them, minus its tolerance");
  add_at_least(section, "buzzing_cells_bare", counted(v.buzzing_cells), 1.0,
               "limit cycle above 0.2 mm without controller");
  add_at_most(section, "worst_swing_controlled_mm", counted(v.worst_controlled_mm),
              closed_loop::kMostSwingMm, "largest limit cycle with it, peak to peak");
}

}  // namespace

Section servo_section(const Effort& effort) {
  Section section;
  section.id = "servo";
  section.title = "The stiff closed loop";
  section.summary =
      "A simulated arm of 0.1 kg, 0.002 N s/mm and a tick of delay against a wall and against "
      "clay, over stiffness, rate and damping: stability, injected energy, and the effect of the "
      "passivity controller. Required: the borders are within 1 % of the theory; below the border "
      "no cycle injects energy on average, and below the passive stiffness no single cycle does; "
      "the controller leaves no limit cycle above 0.2 mm, of which the bare loop has some.";
  Verdict verdict;
  const std::vector<double> k_values = stiffnesses(effort.quick);
  const std::vector<double> rates{100, 250, 500, 1000, 2000, 4000, 8000};
  effort.progress("borders");
  section.tables.push_back(borders(effort, verdict));
  effort.progress("energy");
  section.plots.push_back(energy_plot({100, 1000, 4000}, verdict));
  effort.progress("walls");
  add_wall_maps(
      section, "rate", {"rate [Hz]", true}, rates, k_values,
      [](double rate) { return arm_at(rate); }, verdict);
  add_wall_maps(
      section, "damping", {"damping of the arm [N s/mm]", true},
      {0.0005, 0.001, 0.002, 0.005, 0.01, 0.02}, k_values,
      [](double damping) { return arm_at(1000, damping); }, verdict);
  effort.progress("clay");
  add_clay_maps(section, rates, k_values, verdict);
  section.tables.push_back(clay_table(k_values));
  conclude(section, verdict);
  return section;
}

}  // namespace clay::bench
