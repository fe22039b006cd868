#pragma once
// Compares whole processes: wall-clock time and peak memory of interleaved runs.

#include <string>
#include <vector>

namespace clay::bench {

struct Contestant {
  std::string name;
  std::vector<std::string> command;  ///< program (searched in PATH) and arguments
};

struct Measured {
  std::string name;
  double median_s = 0.0, min_s = 0.0, max_s = 0.0;
  double median_ratio = 0.0;  ///< to the first contestant, round by round
  double peak_mb = 0.0;
  int status = 0;  ///< of the first run that failed
};

/// Runs every contestant once per round, so that noise affects all equally. Output is discarded.
std::vector<Measured> race(const std::vector<Contestant>& contestants, int rounds);

void print(const std::string& title, const std::vector<Measured>& results);

/// Whether a program of this name is in PATH.
bool installed(const std::string& program);

}  // namespace clay::bench
