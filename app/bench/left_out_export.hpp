#pragma once
#include "app/bench/section.hpp"

namespace clay::bench {

/// The cost of the stages of an export, and of the job outside its stages.
void measure_export_stages(Section& section, const Effort& effort);

}  // namespace clay::bench
