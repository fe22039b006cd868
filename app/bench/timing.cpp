#include "app/bench/timing.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace clay::bench {
namespace {

/// Stores the runs instead of printing them.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& reported) override {
    runs.insert(runs.end(), reported.begin(), reported.end());
  }
  std::vector<Run> runs;
};

struct Timed {
  double seconds = 0.0;  ///< of one repetition
  benchmark::IterationCount repetitions = 0;
};

/// `repetitions` = 0: as many as fill `least_s`.
Timed time_once(const Work& work, benchmark::IterationCount repetitions, double least_s) {
  auto* const registered =
      benchmark::RegisterBenchmark(work.name.c_str(), [&work](benchmark::State& state) {
        for (auto _ : state) {
          const double seconds = work.once();
          // Otherwise the library would repeat it forever.
          if (!std::isfinite(seconds)) state.SkipWithError("failed");
          state.SetIterationTime(seconds);
        }
      });
  registered->UseManualTime();
  if (repetitions > 0)
    registered->Iterations(repetitions);
  else
    registered->MinTime(least_s);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, ".");
  benchmark::ClearRegisteredBenchmarks();
  if (collector.runs.empty() || collector.runs.back().error_occurred)
    return {std::numeric_limits<double>::quiet_NaN(), 1};
  const auto& run = collector.runs.back();
  return {run.real_accumulated_time / static_cast<double>(run.iterations), run.iterations};
}

}  // namespace

Rounds rounds_of(const Effort& effort) {
  return effort.quick ? Rounds{15, 0.01} : Rounds{41, 0.05};
}

std::vector<Samples> time_rounds(const std::vector<Work>& works, const Rounds& rounds) {
  std::vector<benchmark::IterationCount> repetitions;
  // The first run determines the number of repetitions; it also warms up and is not counted.
  for (const Work& work : works)
    repetitions.push_back(
        std::max<benchmark::IterationCount>(1, time_once(work, 0, rounds.least_s).repetitions));
  std::vector<Samples> samples(works.size());
  std::vector<std::size_t> order(works.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::minstd_rand shuffle(1);
  for (int round = 0; round < rounds.count; ++round) {
    std::shuffle(order.begin(), order.end(), shuffle);
    for (const std::size_t i : order)
      samples[i].push_back(time_once(works[i], repetitions[i], 0.0).seconds);
  }
  return samples;
}

Duel duel(const Work& a, const Work& b, const Rounds& rounds) {
  const auto samples = time_rounds({a, b}, rounds);
  return {spread_of(samples[0]), spread_of(samples[1]), ratio_of(samples[1], samples[0])};
}

}  // namespace clay::bench
