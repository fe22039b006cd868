#pragma once
// Compares the times of several workloads in one run, with Google Benchmark.

#include "app/bench/section.hpp"
#include "app/bench/statistics.hpp"
#include "app/bench/thread_clock.hpp"

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace clay::bench {

/// Runs the workload once and returns the measured seconds, without preparation. On failure NaN,
/// which makes its samples NaN.
struct Work {
  std::string name;
  std::function<double()> once;
};

struct Rounds {
  int count = 15;
  double least_s = 0.01;  ///< a round repeats a workload until this time is measured
};
[[nodiscard]] Rounds rounds_of(const Effort& effort);

/// Seconds of one workload, one number per round: the mean of the repetitions within the round.
using Samples = std::vector<double>;

/// Runs each workload once per round, in an order that changes between rounds, so that other load
/// affects all equally; take ratios round by round (`ratio_of`).
[[nodiscard]] std::vector<Samples> time_rounds(const std::vector<Work>& works,
                                               const Rounds& rounds);

/// Two workloads and their ratio, b over a.
struct Duel {
  Spread a, b, ratio;
};
/// Times the two in direct succession, for differences near the noise.
[[nodiscard]] Duel duel(const Work& a, const Work& b, const Rounds& rounds);

/// CPU time [s] of a call in this thread, without waiting for other programs.
template <class Call>
double work_seconds_of(Call&& call) {
  const double begin = thread_seconds();
  call();
  return thread_seconds() - begin;
}

/// Wall-clock time [s]: for calls of a few ticks, and for work on several threads.
template <class Call>
double seconds_of(Call&& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace clay::bench
