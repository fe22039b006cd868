#pragma once
// Runs commands of this program as processes, several at a time. A process that crashes or takes
// too long ends no other.

#include "claystack/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace clay::cli {

/// Limit on the stored text of a process; the rest is dropped [bytes].
inline constexpr std::size_t kMostOutput = std::size_t{4} << 20;

struct BatchJob {
  std::string id;
  std::vector<std::string> words;  ///< the arguments of claystack: "export", "bowl.pot.json", ...
};

struct BatchOutcome {
  std::size_t job = 0;  ///< index
  int status = -1;      ///< exit status; 128 + signal if one ended the process
  bool timed_out = false;
  double seconds = 0.0;
  bool cut = false;      ///< it printed more than `out` holds
  std::string out, err;  ///< the printed text, the first kMostOutput bytes of each
};

struct BatchPool {
  std::size_t processes = 1;
  std::chrono::duration<double> time_limit{0.0};  ///< of one job; 0: none
};

/// Runs `jobs` in order, at most `pool.processes` at a time, and calls `done` as each ends. Ends
/// early, after the running jobs, when `done` returns false. Where the system allows fewer
/// processes or descriptors, fewer run at a time. An error: not even one could be started.
Result<void> run_batch(const std::vector<BatchJob>& jobs, const BatchPool& pool,
                       const std::function<bool(const BatchOutcome&)>& done);

}  // namespace clay::cli
