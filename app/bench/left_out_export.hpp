#pragma once
#include "app/bench/section.hpp"

namespace clay::bench {

/// What the stages of an export cost, and what the job does beside its stages.
void measure_export_stages(Section& section, const Effort& effort);

}  // namespace clay::bench
