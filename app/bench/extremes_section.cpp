#include "app/bench/extreme/suite.hpp"
#include "app/bench/section.hpp"

#include <fmt/format.h>

#include <string>

namespace clay::bench {
namespace {

using extreme::Case;
using extreme::Outcome;
using extreme::Verdict;

constexpr std::size_t kQuickDrift = 1'000'000, kFullDrift = 10'000'000;  // ticks

/// Empty if the paper does not define the case.
Cell cell_of(Verdict verdict) {
  if (verdict == Verdict::not_in_print) return {};
  return verdict == Verdict::passed;
}

std::string note_of(const Outcome& engine, const Outcome& literal) {
  return fmt::format("{} | literal: {}", engine.note, literal.note);
}

struct Tally {
  int failed = 0, literal_failed = 0, literal_ran = 0, unexpected = 0;

  void add(const Case& c, Verdict engine, Verdict literal) {
    failed += engine != Verdict::passed;
    literal_failed += literal == Verdict::failed;
    literal_ran += literal != Verdict::not_in_print;
    unexpected += literal != c.literal;
  }
};

}  // namespace

Section extremes_section(const Effort& effort) {
  extreme::set_drift_ticks(effort.quick ? kQuickDrift : kFullDrift);
  Section section;
  section.id = "extremes";
  section.title = "Extreme cases";
  Table table{"extremes",
              "Extreme cases",
              {{"case", ""}, {"pass", ""}, {"literal_pass", ""}, {"oracle", ""}, {"note", ""}},
              {},
              "literal_pass is empty if the paper does not define the case."};
  Tally tally;
  for (const Case& c : extreme::cases()) {
    effort.progress(c.name);
    const Outcome engine = c.run(extreme::Model::conserving),
                  literal = c.run(extreme::Model::literal);
    tally.add(c, engine.verdict, literal.verdict);
    table.rows.push_back({std::string(c.name), cell_of(engine.verdict), cell_of(literal.verdict),
                          std::string(c.oracle), note_of(engine, literal)});
  }
  section.tables = {std::move(table)};
  section.values = {
      {"cases", static_cast<double>(extreme::cases().size()), 0.0, "in the suite"},
      {"literal_failed", static_cast<double>(tally.literal_failed), 0.0, "of the paper as printed"},
      {"literal_ran", static_cast<double>(tally.literal_ran), 0.0, "that the paper defines"}};
  add_at_most(section, "failed", counted(tally.failed), 0.0, "of the engine");
  add_at_most(section, "unexpected", counted(tally.unexpected), 0.0,
              "verdicts on the paper as printed that differ from the recorded ones");
  section.summary = fmt::format(
      "Each case has a requirement and an oracle outside the engine. The same case judges the "
      "paper as printed: where that fails, the case has shown that it can fail. Of {} cases the "
      "engine fails {}; of the {} that the paper defines, the paper as printed fails {}.",
      extreme::cases().size(), tally.failed, tally.literal_ran, tally.literal_failed);
  return section;
}

}  // namespace clay::bench
