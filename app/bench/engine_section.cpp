#include "app/bench/stroke_run.hpp"
#include "app/bench/timing.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace clay::bench {
namespace {

enum class Player { conserving, paper, literal };

const char* name_of(Player player) {
  return player == Player::conserving ? "conserving"
         : player == Player::paper    ? "paper"
                                      : "literal";
}

struct Run {
  Player player = Player::conserving;
  Fineness fineness;
  Outcome outcome;
  Deviation off;
  Spread tick_ns;
  /// Per ms of session time; at 1 kHz, per tick.
  [[nodiscard]] Spread ns_per_ms() const {
    const double ticks = fineness.rate_hz / 1000.0;
    return {ticks * tick_ns.low, ticks * tick_ns.median, ticks * tick_ns.high};
  }
};

/// Runs that differ in one setting, coarse to fine.
struct Series {
  std::string name;   ///< of the curve
  std::string along;  ///< the setting that differs
  std::vector<Run> runs;
};

Outcome play(const Run& run) {
  if (run.player == Player::literal) return play_literal(run.fineness);
  return play_engine(run.fineness, run.player == Player::paper ? Model::paper : Model::conserving);
}

double time_of(const Run& run) {
  if (run.player == Player::literal) return time_literal(run.fineness);
  return time_engine(run.fineness, run.player == Player::paper ? Model::paper : Model::conserving);
}

std::vector<Series> all_series() {
  const std::array<std::size_t, 7> rings{50, 100, 200, 400, 800, 1600, 3200};
  const std::array<int, 6> rates{125, 250, 500, 1000, 2000, 4000};
  const std::array<double, 6> reaches{8.0, 16.0, 24.0, 30.0, 36.0, 40.0};
  std::vector<Series> all;
  const auto series = [&](const char* along, const std::string& name, Player player,
                          const auto& values, auto set) {
    Series& made = all.emplace_back(Series{name, along, {}});
    for (const auto value : values) {
      Run& run = made.runs.emplace_back();
      run.player = player;
      set(run.fineness, value);
    }
  };
  const auto by_rings = [](Fineness& f, std::size_t n) { f.rings = n; };
  const auto by_rate = [](Fineness& f, int rate) { f.rate_hz = rate; };
  const auto by_reach = [](Fineness& f, double reach) { f.reach_mm = reach; };
  series("rings", "conserving, 50 to 3200 rings", Player::conserving, rings, by_rings);
  series("rings", "paper, 50 to 3200 rings", Player::paper, rings, by_rings);
  series("rings", "literal, 50 to 3200 rings", Player::literal, rings, by_rings);
  series("rate", "conserving, 125 Hz to 4 kHz", Player::conserving, rates, by_rate);
  series("rate", "paper, 125 Hz to 4 kHz", Player::paper, rates, by_rate);
  series("reach", "conserving, reach 1 to 5 sigma", Player::conserving, reaches, by_reach);
  return all;
}

/// Finer than all of a series; the reach has its own reference.
Outcome reference_of(const std::string& along, const Effort& effort) {
  Fineness fine;
  fine.rings = effort.quick ? 6400 : 12'800;
  fine.rate_hz = effort.quick ? 10'000 : 20'000;
  if (along != "reach") return play_engine(fine, Model::conserving);
  // The effect of the reach is examined separately from the rings.
  fine = Fineness{};
  fine.reach_mm = 56.0;
  return play_engine(fine, Model::conserving);
}

void measure(std::vector<Series>& all, const Effort& effort) {
  std::vector<Work> works;
  std::vector<Run*> runs;
  for (const char* along : {"rings", "rate", "reach"}) {
    effort.progress(fmt::format("error over {}", along));
    const Outcome reference = reference_of(along, effort);
    for (Series& series : all)
      for (Run& run : series.runs)
        if (series.along == along) {
          run.outcome = play(run);
          run.off = deviation(run.outcome, reference);
          works.push_back({series.name, [&run] { return time_of(run); }});
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
               {"force_rms_n", "N"}},
              {},
              "ns per ms: run time for one ms of the session; at 1 kHz, of one tick. Volume: the "
              "maximum error during the stroke; 0: not a single quantum."};
  for (const Series& series : all)
    for (const Run& run : series.runs) {
      const Fineness& f = run.fineness;
      table.rows.push_back({series.along, std::string(name_of(run.player)),
                            static_cast<std::int64_t>(f.rings), std::int64_t{f.rate_hz}, f.reach_mm,
                            run.tick_ns.median, run.tick_ns.range(), run.ns_per_ms().median,
                            run.outcome.volume_error, run.off.profile_max_mm,
                            run.off.profile_mean_mm, run.off.force_max_n, run.off.force_rms_n});
    }
  return table;
}

/// Work-precision diagram: run time over error, as usual in the literature on solvers.
template <class Error>
Plot plot_of(const std::vector<Series>& all, const std::string& id, const char* title,
             const char* label, Error error) {
  Plot plot{id,
            title,
            {"run time for 1 ms of throwing [ns] (at 1 kHz: of one tick)", true},
            {label, true},
            {},
            "Each curve goes from coarse to fine. The spread of the run times is in the table."};
  for (const Series& series : all) {
    // The reach has its own reference, and so its own plot.
    if ((series.along == "reach") != id.ends_with("reach")) continue;
    Curve curve;
    curve.name = series.name;
    for (const Run& run : series.runs) {
      curve.x.push_back(run.ns_per_ms().median);
      curve.y.push_back(error(run));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace

Section engine_section(const Effort& effort) {
  Section section;
  section.id = "engine";
  section.title = "Error against run time";
  auto all = all_series();
  measure(all, effort);
  const auto profile = [](const Run& r) { return r.off.profile_mean_mm; };
  const auto force = [](const Run& r) { return r.off.force_rms_n; };
  const auto volume = [](const Run& r) { return r.outcome.volume_error; };
  const char *const radii = "mean error of the radii [mm]",
                    *const newtons = "root mean square error of the force [N]";
  section.plots = {
      plot_of(all, "engine_profile", "Profile against run time", radii, profile),
      plot_of(all, "engine_force", "Force against run time", newtons, force),
      plot_of(all, "engine_volume", "Volume against run time",
              "largest error of the volume, relative", volume),
      plot_of(all, "engine_profile_reach", "Effect of the kernel's reach", radii, profile)};
  section.tables = {table_of(all)};
  double conserving = 0.0, literal = 0.0;
  for (const Series& series : all)
    for (const Run& run : series.runs)
      if (!(run.outcome.volume_error <= (run.player == Player::literal ? literal : conserving)) &&
          run.player != Player::paper)
        (run.player == Player::literal ? literal : conserving) = run.outcome.volume_error;
  section.values = {
      {"conserving_volume_error", conserving, 0.0, "relative, maximum; 0 is required"},
      {"literal_volume_error", literal, 0.0, "relative, maximum"}};
  section.sound = conserving == 0.0;
  section.summary = fmt::format(
      "Cost of accuracy. A ball presses a hollow cylinder and pulls up its wall within {} "
      "s. "
      "Radii and forces are compared with those of the conserving model at {} rings and {} Hz (for "
      "the kernel's reach: against 7 sigma at 200 rings and 1 kHz). `paper` and literal, the paper "
      "as printed with a running sum for the stress, keep its K per ring and k per tick. The "
      "conserving model's volume is {}.",
      kStrokeS, effort.quick ? 6400 : 12'800, effort.quick ? 10'000 : 20'000,
      conserving == 0.0 ? "conserved to the quantum in every run" : "NOT conserved");
  return section;
}

}  // namespace clay::bench
