// mutate_readers COUNT SAMPLES [SEED]: reads COUNT damaged files of each kind. Fails on a broken
// promise, a crash, 5 s for one of them, or 512 MiB. CONTRIBUTING.md has the command with
// sanitizers.

#include "tests/fuzz/mesh_promise.hpp"
#include "tests/fuzz/mesh_words.hpp"
#include "tests/fuzz/program_readers.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace clay;

std::string current;  // the mutant that is being read

void too_slow(int) {
  if (write(STDERR_FILENO, current.data(), current.size()) < 0) _exit(2);
  _exit(1);
}

void begin(const std::string& bytes) {
  current = bytes;
  alarm(5);
}

long most_mib() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss / 1024;
}

/// False, with a message, if a promise was broken.
bool report(std::string_view name, std::size_t count, const std::optional<std::string>& broken) {
  alarm(0);
  if (broken) {
    std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(name.size()), name.data(), broken->c_str());
    return false;
  }
  std::printf("%.*s: %zu mutants, no fault, %ld MiB\n", static_cast<int>(name.size()), name.data(),
              count, most_mib());
  std::fflush(stdout);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: mutate_readers COUNT SAMPLES [SEED]\n");
    return 2;
  }
  const auto count = std::strtoul(argv[1], nullptr, 10);
  const auto seed = static_cast<unsigned>(argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1);
  std::signal(SIGALRM, too_slow);
  bool kept = true;
  for (const solid::FormatFacts& facts : solid::kFormatFacts) {
#ifndef CLAYSTACK_DRACO
    if (facts.format == solid::MeshFormat::drc) continue;
#endif
    kept &=
        report(facts.name, count, solid::samples::first_broken(facts.format, seed, count, begin));
  }
  for (const samples::TextReader& reader : samples::program_readers(argv[2]))
    kept &= report(reader.name, count, samples::first_broken(reader, seed, count, begin));
  if (most_mib() > 512) {
    std::fprintf(stderr, "expected at most 512 MiB, found %ld\n", most_mib());
    return 1;
  }
  return kept ? 0 : 1;
}
