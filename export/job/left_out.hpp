#pragma once
// What an export did not need to do, why, and (where asked for) what doing it would have cost.

#include "claystack/export/job.hpp"
#include "export/solid/revolve_layout.hpp"

#include <string>
#include <vector>

namespace clay::solid::inline job {

/// Of a pot that stands. `no_smoothing` is the reason why there was none; empty where there was.
std::vector<SkippedStage> left_out(const ClayStack& stack, const std::string& no_smoothing,
                                   const RevolveLayout& rule, bool made_mesh,
                                   const std::vector<Output>& outputs,
                                   const ExportOptions& options);

/// Adds the formats that no output has.
void add_formats_left_out(const std::vector<Output>& outputs, std::vector<SkippedStage>& list);

}  // namespace clay::solid::inline job
