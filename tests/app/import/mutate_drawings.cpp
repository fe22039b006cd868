// mutate_drawings COUNT [SEED]: imports COUNT damaged drawings of each format. Fails on a broken
// promise, a crash, 5 s for one of them, or 512 MiB. CONTRIBUTING.md has the command with
// sanitizers.

#include "tests/fuzz/drawing_promise.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

std::string current;  // the mutant that is being imported

void too_slow(int) {
  if (write(STDERR_FILENO, current.data(), current.size()) < 0) _exit(2);
  _exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: mutate_drawings COUNT [SEED]\n");
    return 2;
  }
  const auto count = std::strtoul(argv[1], nullptr, 10);
  const auto seed = static_cast<unsigned>(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  std::signal(SIGALRM, too_slow);
  for (const char* format : {"dxf", "svg", "csv"}) {
    const auto broken =
        clay::importing::samples::first_broken(format, seed, count, [](const std::string& bytes) {
          current = bytes;
          alarm(5);
        });
    if (broken) {
      std::fprintf(stderr, "%s: %s\n", format, broken->c_str());
      return 1;
    }
  }
  alarm(0);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::printf("3 x %lu mutants: no fault, %ld MiB\n", count, used.ru_maxrss / 1024);
  return used.ru_maxrss / 1024 <= 512 ? 0 : 1;
}
