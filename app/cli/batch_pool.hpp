#pragma once
// Runs commands of this program as processes, several at a time. A process that crashes or takes
// too long ends no other.

#include "claystack/core/result.hpp"

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace clay::cli {

/// Limit on the stored text of a process; the rest is dropped [bytes].
inline constexpr std::size_t kMostOutput = std::size_t{4} << 20;

struct BatchJob {
  std::string id;
  std::vector<std::string> words;  ///< the arguments of claystack: "export", "bowl.pot.json", ...
  std::string after;               ///< id of an earlier job that must end with 0 first; empty: none
};

/// The status of a job that was not run, because the job before it failed.
inline constexpr int kNotRun = -1;

struct BatchOutcome {
  std::size_t job = 0;   ///< index
  int status = kNotRun;  ///< exit status; 128 + signal if one ended the process
  bool timed_out = false;
  double seconds = 0.0;
  bool cut = false;      ///< it printed more than `out` holds
  std::string out, err;  ///< the printed text, the first kMostOutput bytes of each
};

struct BatchPool {
  std::size_t processes = 1;
  std::chrono::duration<double> time_limit{0.0};  ///< of one job; 0: none
  std::map<std::string, int> ended;  ///< statuses of jobs that are not run again, by their ids
};

/// Runs `jobs` in order, at most `pool.processes` at a time, and calls `done` as each ends. A job
/// that waits for another lets those behind it go first; if that one fails, it is not run. Each job
/// waits only for one before it in `jobs`, or one of `pool.ended`. Ends early, after the running
/// jobs, when `done` returns false. Where the system allows fewer processes or descriptors, fewer
/// run at a time. An error: not even one could be started.
Result<void> run_batch(const std::vector<BatchJob>& jobs, const BatchPool& pool,
                       const std::function<bool(const BatchOutcome&)>& done);

}  // namespace clay::cli
