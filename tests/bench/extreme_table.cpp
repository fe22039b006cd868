// extreme_table [--full] [CASE]: prints the table of the suite. --full plays 10^7 ticks of drift
// instead of 10^6. Exit status 1 if a case fails on the wheel, 2 if there is no such case.

#include "app/bench/extreme/suite.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace {

using namespace clay::extreme;

const char* word(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "pass";
    case Verdict::failed:
      return "FAIL";
    case Verdict::not_in_print:
      return "-";
  }
  return "";
}

int print(const std::string& only) {
  int failed = 0, literal_failed = 0, literal_ran = 0, count = 0;
  for (const Case& c : cases()) {
    if (!only.empty() && only != c.name) continue;
    const Outcome engine = c.run(Model::conserving), literal = c.run(Model::literal);
    fmt::print("{:<26} {:<4}  {:<4}  {}\n{:<26} {:<4}  {:<4}  {}\n", c.name, word(engine.verdict),
               word(literal.verdict), engine.note, "", "", "", literal.note);
    std::fflush(stdout);  // shows progress
    ++count;
    failed += engine.verdict != Verdict::passed;
    literal_failed += literal.verdict == Verdict::failed;
    literal_ran += literal.verdict != Verdict::not_in_print;
  }
  if (count == 0) {
    fmt::print(stderr, "extreme_table: expected the name of a case, found {}\n", only);
    return 2;
  }
  fmt::print("{} cases, {} failed; the paper as printed fails {} of {}\n", count, failed,
             literal_failed, literal_ran);
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::string only;
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument == "--full")
      set_drift_ticks(10'000'000);
    else
      only = argument;
  }
  return print(only);
}
