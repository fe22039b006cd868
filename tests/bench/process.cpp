#include "tests/bench/process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>

extern char** environ;

namespace clay::bench {
namespace {

struct Run {
  double seconds = 0.0;
  double peak_mb = 0.0;
  int status = -1;
};

Run run(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t silence;
  posix_spawn_file_actions_init(&silence);
  for (const int stream : {1, 2})
    posix_spawn_file_actions_addopen(&silence, stream, "/dev/null", O_WRONLY, 0);
  Run result;
  const auto begin = std::chrono::steady_clock::now();
  pid_t child = 0;
  if (posix_spawnp(&child, arguments[0], &silence, nullptr, arguments.data(), environ) == 0) {
    rusage usage{};
    wait4(child, &result.status, 0, &usage);
    result.peak_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  posix_spawn_file_actions_destroy(&silence);
  return result;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::vector<Measured> race(const std::vector<Contestant>& contestants, int rounds) {
  std::vector<std::vector<double>> seconds(contestants.size()), ratios(contestants.size());
  std::vector<Measured> results(contestants.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const Run done = run(contestants[i].command);
      seconds[i].push_back(done.seconds);
      ratios[i].push_back(done.seconds / seconds[0].back());
      results[i].peak_mb = std::max(results[i].peak_mb, done.peak_mb);
      if (done.status != 0 && results[i].status == 0) results[i].status = done.status;
    }
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const auto [min, max] = std::minmax_element(seconds[i].begin(), seconds[i].end());
    results[i].name = contestants[i].name;
    results[i].median_s = median(seconds[i]);
    results[i].min_s = *min;
    results[i].max_s = *max;
    results[i].median_ratio = median(ratios[i]);
  }
  return results;
}

void print(const std::string& title, const std::vector<Measured>& results) {
  std::printf("\n%s\n%-44s %10s %22s %8s %9s\n", title.c_str(), "", "median s", "min - max s",
              "ratio", "peak MB");
  for (const Measured& m : results)
    std::printf("%-44s %10.4f %10.4f - %9.4f %8.2f %9.1f%s\n", m.name.c_str(), m.median_s, m.min_s,
                m.max_s, m.median_ratio, m.peak_mb, m.status ? "  FAILED" : "");
}

bool installed(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(std::filesystem::path(folder) / program)) return true;
  return false;
}

}  // namespace clay::bench
