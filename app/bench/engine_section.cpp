#include "app/bench/stroke_run.hpp"
#include "app/bench/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace clay::bench {
namespace {

const char* name_of(Variant variant) {
  switch (variant) {
    case Variant::conserving:
      return "conserving";
    case Variant::clay_rules:
      return "clay rules";
    case Variant::paper_scaled:
      return "paper, scaled";
    case Variant::paper:
      return "paper";
    case Variant::literal:
      break;
  }
  return "literal";
}

struct Run {
  Variant variant = Variant::conserving;
  Fineness fineness;
  Outcome outcome;
  Deviation off;
  Spread tick_ns;
  double force_n = 0.0, radius_mm = 0.0;  ///< the largest of the reference
  /// Per ms of session time; at 1 kHz, per tick.
  [[nodiscard]] Spread ns_per_ms() const {
    const double ticks = fineness.rate_hz / 1000.0;
    return {ticks * tick_ns.low, ticks * tick_ns.median, ticks * tick_ns.high};
  }
  [[nodiscard]] double profile_error() const { return off.profile_mean_mm / radius_mm; }
  [[nodiscard]] double force_error() const { return off.force_rms_n / force_n; }
};

/// Runs that differ in one setting, coarse to fine.
struct Series {
  std::string name;   ///< of the curve
  std::string along;  ///< the setting that differs
  std::vector<Run> runs;
};

std::vector<Series> all_series() {
  const std::array<std::size_t, 7> rings{50, 100, 200, 400, 800, 1600, 3200};
  const std::array<int, 6> rates{125, 250, 500, 1000, 2000, 4000};
  const std::array<double, 6> reaches{8.0, 16.0, 24.0, 30.0, 36.0, 40.0};
  std::vector<Series> all;
  const auto series = [&](const char* along, const std::string& name, Variant variant,
                          const auto& values, auto set) {
    Series& made = all.emplace_back(Series{name, along, {}});
    for (const auto value : values) {
      Run& run = made.runs.emplace_back();
      run.variant = variant;
      set(run.fineness, value);
    }
  };
  const auto by_rings = [](Fineness& f, std::size_t n) { f.rings = n; };
  const auto by_rate = [](Fineness& f, int rate) { f.rate_hz = rate; };
  const auto by_reach = [](Fineness& f, double reach) { f.reach_mm = reach; };
  using enum Variant;
  for (const Variant variant : {conserving, clay_rules, paper_scaled, literal})
    series("rings", fmt::format("{}, 50 to 3200 rings", name_of(variant)), variant, rings,
           by_rings);
  for (const Variant variant : {conserving, clay_rules, paper_scaled, paper})
    series("rate", fmt::format("{}, 125 Hz to 4 kHz", name_of(variant)), variant, rates, by_rate);
  series("reach", "conserving, reach 1 to 5 sigma", conserving, reaches, by_reach);
  return all;
}

/// The variant that has the limit. The paper as printed has none, so it is compared with its scaled
/// model.
Variant limit_of(Variant variant) {
  return variant == Variant::paper || variant == Variant::literal ? Variant::paper_scaled : variant;
}

/// Four times as fine as the finest run of a series, extrapolated; the reach has its own reference.
Outcome reference_of(const std::string& along, Variant variant) {
  Fineness fine;
  if (along == "reach") {
    fine.reach_mm = 56.0;
    return play(fine, variant);
  }
  if (along == "rings") fine.rings = 12'800;
  if (along == "rate") fine.rate_hz = 16'000;
  Fineness half = fine;
  if (along == "rings") half.rings /= 2;
  if (along == "rate") half.rate_hz /= 2;
  return extrapolated(play(fine, variant), play(half, variant));
}

void compare(Run& run, const Outcome& reference) {
  run.outcome = play(run.fineness, run.variant);
  run.off = deviation(run.outcome, reference);
  for (const glm::dvec3& force : reference.force_n)
    run.force_n = std::max(run.force_n, glm::length(force));
  for (const double radius : reference.outer_mm) run.radius_mm = std::max(run.radius_mm, radius);
}

void measure(std::vector<Series>& all, const Effort& effort) {
  std::vector<Work> works;
  std::vector<Run*> runs;
  std::map<std::pair<std::string, Variant>, Outcome> references;
  for (Series& series : all) {
    effort.progress(fmt::format("error: {}", series.name));
    const Variant limit = limit_of(series.runs.front().variant);
    auto [reference, missing] = references.try_emplace({series.along, limit});
    if (missing) reference->second = reference_of(series.along, limit);
    for (Run& run : series.runs) {
      compare(run, reference->second);
      works.push_back({series.name, [&run] { return time_of(run.fineness, run.variant); }});
      runs.push_back(&run);
    }
  }
  effort.progress("run time");
  Rounds rounds = rounds_of(effort);
  rounds.least_s = 3e-3;
  const auto seconds = time_rounds(works, rounds);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Spread s = spread_of(seconds[i]);
    const double ns = 1e9 / (1 + ticks_of(runs[i]->fineness.rate_hz));
    runs[i]->tick_ns = {ns * s.low, ns * s.median, ns * s.high};
  }
}

Table table_of(const std::vector<Series>& all) {
  Table table{"engine_precision",
              "Error and run time of one stroke",
              {{"along", ""},
               {"model", ""},
               {"rings", ""},
               {"rate_hz", "Hz"},
               {"reach_mm", "mm"},
               {"tick_ns", "ns"},
               {"tick_iqr_ns", "ns"},
               {"ns_per_ms", "ns"},
               {"volume_error", "relative"},
               {"profile_max_mm", "mm"},
               {"profile_mean_mm", "mm"},
               {"force_max_n", "N"},
               {"force_rms_n", "N"},
               {"profile_error", "of the largest radius"},
               {"force_error", "of the largest force"}},
              {},
              "ns per ms: run time for one ms of the session; at 1 kHz, of one tick. Volume: the "
              "maximum error during the stroke; 0: not a single quantum."};
  for (const Series& series : all)
    for (const Run& run : series.runs) {
      const Fineness& f = run.fineness;
      table.rows.push_back({series.along, std::string(name_of(run.variant)),
                            static_cast<std::int64_t>(f.rings), std::int64_t{f.rate_hz}, f.reach_mm,
                            run.tick_ns.median, run.tick_ns.range(), run.ns_per_ms().median,
                            run.outcome.volume_error, run.off.profile_max_mm,
                            run.off.profile_mean_mm, run.off.force_max_n, run.off.force_rms_n,
                            run.profile_error(), run.force_error()});
    }
  return table;
}

/// A triangle below the first curve; its long side halves the error when the run time doubles.
Curve order_1(const Curve& curve) {
  constexpr double kBelow = 0.5, kFactor = 8.0;
  const double x = curve.x.front(), y = kBelow * curve.y.front();
  Curve guide{"order 1: half the error for twice the time", {}, {}, {}, {}, true, true};
  guide.x = {x, kFactor * x, x, x};
  guide.y = {y, y / kFactor, y / kFactor, y};
  return guide;
}

/// The label of a point: the setting that differs in its series.
std::string label_of(const Run& run, const std::string& along) {
  if (along == "rings") return fmt::format("N {}", run.fineness.rings);
  if (along == "rate") return fmt::format("{} Hz", run.fineness.rate_hz);
  return fmt::format("{:g} mm", run.fineness.reach_mm);
}

/// Work-precision diagram: run time over error, as usual in the literature on solvers.
template <class Error>
Plot plot_of(const std::vector<Series>& all, const std::string& along, const std::string& id,
             const char* title, const char* label, Error error) {
  Plot plot{
      id,
      title,
      {"run time for 1 ms of throwing [ns] (at 1 kHz: of one tick)", true},
      {label, true},
      {},
      "Each curve goes from coarse to fine; the points state the rings, the rate or the reach. "
      "Bars: quartiles of the run time."};
  for (const Series& series : all) {
    if (series.along != along) continue;
    Curve curve;
    curve.name = series.name;
    for (const Run& run : series.runs) {
      const Spread ns = run.ns_per_ms();
      curve.x.push_back(ns.median);
      curve.x_low.push_back(ns.low);
      curve.x_high.push_back(ns.high);
      curve.labels.push_back(label_of(run, along));
      curve.y.push_back(error(run));
    }
    plot.curves.push_back(std::move(curve));
  }
  if (along != "reach") plot.curves.push_back(order_1(plot.curves.front()));
  return plot;
}

double largest_volume_error(const std::vector<Series>& all, Variant variant) {
  double largest = 0.0;
  for (const Series& series : all)
    for (const Run& run : series.runs)
      // Not max: a NaN must be kept and shown.
      if (run.variant == variant && !(run.outcome.volume_error <= largest))
        largest = run.outcome.volume_error;
  return largest;
}

/// The requirements: the pots stand, and the conserving model keeps the volume to the quantum.
void judge(const std::vector<Series>& all, Section& section) {
  for (const Series& series : all)
    for (const Run& run : series.runs)
      section.require(!run.outcome.collapsed,
                      fmt::format("{}, {}: required a standing pot, found a collapsed one",
                                  series.name, label_of(run, series.along)));
  const double conserving = largest_volume_error(all, Variant::conserving);
  const double rules = largest_volume_error(all, Variant::clay_rules);
  add_at_most(section, "conserving_volume_error", counted(conserving), 0.0, "relative, maximum");
  add_at_most(section, "clay_rules_volume_error", counted(rules), 0.0, "relative, maximum");
  section.values.push_back({"literal_volume_error", largest_volume_error(all, Variant::literal),
                            0.0, "relative, maximum"});
}

}  // namespace

Section engine_section(const Effort& effort) {
  Section section;
  section.id = "engine";
  section.title = "Error against run time";
  auto all = all_series();
  measure(all, effort);
  const auto profile = [](const Run& r) { return r.profile_error(); };
  const auto force = [](const Run& r) { return r.force_error(); };
  const auto volume = [](const Run& r) { return r.outcome.volume_error; };
  const char *const radii = "mean error of the radii, of the largest radius",
                    *const newtons = "RMS error of the force, of the largest force";
  section.plots = {
      plot_of(all, "rings", "engine_profile_rings", "Profile: 50 to 3200 rings", radii, profile),
      plot_of(all, "rings", "engine_force_rings", "Force: 50 to 3200 rings", newtons, force),
      plot_of(all, "rate", "engine_profile_rate", "Profile: 125 Hz to 4 kHz", radii, profile),
      plot_of(all, "rate", "engine_force_rate", "Force: 125 Hz to 4 kHz", newtons, force),
      plot_of(all, "rings", "engine_volume", "Volume against run time",
              "largest error of the volume, relative", volume),
      plot_of(all, "reach", "engine_profile_reach", "Effect of the kernel's reach", radii,
              profile)};
  section.tables = {table_of(all)};
  judge(all, section);
  section.summary = fmt::format(
      "Cost of accuracy. A ball presses a hollow cylinder and pulls up its wall within {} s. Each "
      "model is compared with its own limit, extrapolated (Richardson, first order) from runs "
      "2 times and 4 times as fine as its finest here. `paper, scaled` is the paper's model with "
      "a stiffness per mm and a rate per second, which gives it a limit; `paper` and `literal` (as "
      "printed, with a running sum for the stress) keep its K per ring and k per tick, and are "
      "compared with that limit. Volume in the conserving model, with and without clay rules: {}.",
      kStrokeS, section.sound() ? "exact to the quantum in every run" : "NOT conserved");
  return section;
}

}  // namespace clay::bench
