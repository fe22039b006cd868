#pragma once
// The extreme suite: what a wheel must survive, each case with its requirement and an oracle
// outside the engine, run on the engine and, to prove that the suite can fail, on the paper as
// printed.

#include "app/bench/extreme/subject.hpp"

#include <span>
#include <string>
#include <string_view>

namespace clay::extreme {

enum class Verdict { passed, failed, not_in_print };

struct Outcome {
  Verdict verdict = Verdict::passed;
  std::string note;  ///< what was measured, or what went wrong first
};

struct Case {
  std::string_view name;
  std::string_view what;      ///< the input
  std::string_view required;  ///< the result that passes
  std::string_view oracle;    ///< what judges it
  Verdict literal;            ///< what is known of the paper as printed
  Outcome (*run)(Who who);
};

// The parts of the table, in its order.
std::span<const Case> shape_cases();      ///< stacks and tools at the ends of their ranges
std::span<const Case> flow_cases();       ///< kernels, shares, growth
std::span<const Case> input_cases();      ///< poses and times that are no poses and times
std::span<const Case> force_cases();      ///< direction, size, energy
std::span<const Case> stability_cases();  ///< the threshold to the ulp, collapse
std::span<const Case> pinch_cases();      ///< two tools at once
std::span<const Case> step_cases();       ///< one step computed again; many steps; twice the same

/// All of them, in the order of the table.
std::span<const Case> cases();

/// How many ticks the case `drift` plays: 10^6, or 10^7 where there is time.
void set_drift_ticks(std::size_t ticks);

}  // namespace clay::extreme
