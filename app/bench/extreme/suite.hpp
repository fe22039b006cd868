#pragma once
// The extreme suite: inputs that a wheel must survive, each with its requirement and an oracle
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
  std::string note;  ///< the measured value, or the first failure
};

struct Case {
  std::string_view name;
  std::string_view what;      ///< the input
  std::string_view required;  ///< the result that passes
  std::string_view oracle;    ///< source of the expected result
  Verdict literal;            ///< expected result of the paper as printed
  Outcome (*run)(Model model);
};

// The parts of the table, in its order.
std::span<const Case> shape_cases();      ///< stacks and tools at the limits of their ranges
std::span<const Case> flow_cases();       ///< kernels, shares, growth
std::span<const Case> input_cases();      ///< invalid poses and times
std::span<const Case> force_cases();      ///< direction, size, energy
std::span<const Case> stability_cases();  ///< the threshold to the ulp, collapse
std::span<const Case> pinch_cases();      ///< two tools at once
std::span<const Case> rule_cases();       ///< the clay rules at their limits
std::span<const Case> step_cases();       ///< one step recomputed; many steps; repeated runs

/// All cases, in the order of the table.
std::span<const Case> cases();

/// The number of ticks of the case `drift`: 10^6, or 10^7 for the full run.
void set_drift_ticks(std::size_t ticks);

}  // namespace clay::extreme
