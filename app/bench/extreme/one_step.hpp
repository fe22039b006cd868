#pragma once
#include "app/bench/extreme/suite.hpp"

namespace clay::extreme {

/// Random ticks on random pots, each recomputed in 50 digits from docs/model.md or from the paper,
/// ring by ring, within a bound derived from the roundings of one tick.
Outcome one_step_again(Model model);

}  // namespace clay::extreme
