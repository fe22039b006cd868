#include "app/bench/left_out_export.hpp"

#include "app/bench/bellied_pot.hpp"
#include "app/bench/timing.hpp"
#include "claystack/export/job.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace clay::bench {
namespace {

using solid::ExportOptions;
using solid::MeshFormat;

/// One export into memory.
struct Job {
  std::shared_ptr<const Pot> pot;
  ExportOptions options;
  std::vector<MeshFormat> formats{MeshFormat::stl_binary};

  [[nodiscard]] Result<solid::ExportReport> run() const {
    std::vector<solid::MemoryStore> stores(formats.size());
    std::vector<solid::Output> outputs;
    for (std::size_t k = 0; k < formats.size(); ++k) outputs.push_back({formats[k], &stores[k]});
    return solid::run_export(*pot, outputs, options);
  }
  /// NaN seconds on failure.
  [[nodiscard]] Work work() const {
    return {"export", [job = *this] {
              bool done = false;
              const double seconds = seconds_of([&] { done = job.run().has_value(); });
              return done ? seconds : std::nan("");
            }};
  }
};

struct Pair {
  std::string stage;
  Job out, in;
};

std::vector<Pair> pairs() {
  Job plain;
  plain.pot = std::make_shared<const Pot>(bellied_pot(6.0));
  plain.options.smoothing = solid::Smoothing::none;
  plain.options.tolerance_mm = 0.05;
  std::vector<Pair> pairs;
  const auto add = [&](std::string stage, auto change) {
    Job in = plain;
    change(in);
    pairs.push_back({std::move(stage), plain, std::move(in)});
  };
  add("none: the same job twice", [](Job&) {});
  add("smoothing, fair", [](Job& j) { j.options.smoothing = solid::Smoothing::fair; });
  add("smoothing, exact", [](Job& j) { j.options.smoothing = solid::Smoothing::exact; });
  add("wall field", [](Job& j) { j.options.wall_spacing_mm = 1.0; });
  add("full verification", [](Job& j) { j.options.full_verification = true; });
  add("OBJ as well", [](Job& j) { j.formats.push_back(MeshFormat::obj); });
#ifdef CLAYSTACK_DRACO
  add("Draco as well", [](Job& j) { j.formats.push_back(MeshFormat::drc); });
#endif
  Job solid = plain;
  solid.pot = std::make_shared<const Pot>(bellied_pot(0.0));
  pairs.push_back({"inner shell", solid, plain});
  return pairs;
}

Table empty_table() {
  return {
      "left_out_export",
      "Cost of the stages of an export",
      {{"stage", ""},
       {"out_ms", "ms"},
       {"in_ms", "ms"},
       {"cost_ms", "ms"},
       {"in_over_out", ""},
       {"iqr", ""}},
      {},
      fmt::format("A bellied pot of {} rings as binary STL, into memory, unsmoothed, to 0.05 mm. "
                  "A smooth wall needs fewer facets than its steps, and so may save more time than "
                  "it costs.",
                  kBelliedRings)};
}

/// The share of the job's time outside its stages [%].
Samples unaccounted(const Job& job, int rounds) {
  Samples shares;
  for (int k = 0; k < rounds; ++k) {
    double within = 0.0;
    const double whole = seconds_of([&] {
      const auto report = job.run();
      if (report)
        for (const auto& stage : report->stages) within += stage.seconds;
    });
    shares.push_back(100.0 * (whole - within) / whole);
  }
  return shares;
}

/// Measured by the job itself, as by `claystack export --measure-left-out`.
Table measured_by_the_job(Job job) {
  Table table{"left_out_export_saved",
              "Stages that the job skipped, and the time saved",
              {{"what", ""}, {"why", ""}, {"saved_ms", "ms"}},
              {},
              "Measured once, as by claystack export --measure-left-out."};
  job.options.measure_left_out = true;
  if (const auto report = job.run())
    for (const solid::SkippedStage& item : report->left_out)
      table.rows.push_back(
          {item.what, item.why, item.saved_s ? Cell(1e3 * *item.saved_s) : Cell()});
  return table;
}

}  // namespace

void measure_export_stages(Section& section, const Effort& effort) {
  Rounds rounds = rounds_of(effort);
  rounds.least_s = 1e-4;
  if (effort.quick) rounds.count = 9;
  Table table = empty_table();
  const auto all = pairs();
  for (const Pair& pair : all) {
    effort.progress(pair.stage);
    const Duel d = duel(pair.out.work(), pair.in.work(), rounds);
    table.rows.push_back({pair.stage, 1e3 * d.a.median, 1e3 * d.b.median,
                          1e3 * (d.b.median - d.a.median), d.ratio.median, d.ratio.range()});
    section.require(std::isfinite(d.ratio.median), pair.stage + ": the export failed");
  }
  const Spread rest = spread_of(unaccounted(all[0].out, rounds.count));
  section.values.push_back({"export_unaccounted_percent", rest.median, rest.range(),
                            "of an export's time outside its listed stages"});
  section.summary +=
      fmt::format("An export lists the stages that it runs; {:.1f} % of its time is outside them.",
                  rest.median);
  section.tables.push_back(std::move(table));
  section.tables.push_back(measured_by_the_job(all[0].out));
}

}  // namespace clay::bench
