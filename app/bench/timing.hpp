#pragma once
// Several works timed against each other in one run, on Google Benchmark.

#include "app/bench/section.hpp"
#include "app/bench/statistics.hpp"
#include "app/bench/thread_clock.hpp"

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace clay::bench {

/// Does the work once and returns the seconds that count: preparing it need not. NaN where it
/// failed: then its samples are NaN.
struct Work {
  std::string name;
  std::function<double()> once;
};

struct Rounds {
  int count = 15;
  double least_s = 0.01;  ///< a round repeats a work until so much time has counted
};
[[nodiscard]] Rounds rounds_of(const Effort& effort);

/// Seconds of one work, one number a round: each the mean of the repetitions within the round.
using Samples = std::vector<double>;

/// In every round each work once, in an order that changes from round to round: what the machine
/// does besides hits all alike, and ratios are to be taken round by round (`ratio_of`).
[[nodiscard]] std::vector<Samples> time_rounds(const std::vector<Work>& works,
                                               const Rounds& rounds);

/// Two works and their ratio, b over a.
struct Duel {
  Spread a, b, ratio;
};
/// The two alone, in neighbouring moments: for differences near the noise.
[[nodiscard]] Duel duel(const Work& a, const Work& b, const Rounds& rounds);

/// Seconds that this thread works on a call; waiting while the machine does something else is none.
template <class Call>
double work_seconds_of(Call&& call) {
  const double begin = cli::thread_seconds();
  call();
  return cli::thread_seconds() - begin;
}

/// Seconds by the clock on the wall: for calls of a few ticks, and for work on several threads.
template <class Call>
double seconds_of(Call&& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace clay::bench
