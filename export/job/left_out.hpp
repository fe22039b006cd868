#pragma once
// What an export did not need to do, why, and (where asked for) what doing it would have cost.

#include "claystack/export/job.hpp"
#include "export/solid/revolve_rule.hpp"

#include <string>
#include <vector>

namespace clay::solid {

/// Of a pot that stands. `no_smoothing` is the reason why there was none; empty where there was.
std::vector<LeftOut> left_out(const ClayStack& stack, const std::string& no_smoothing,
                              const RevolveRule& rule, bool made_mesh,
                              const std::vector<Output>& outputs, const ExportOptions& options);

/// Adds the formats that no output has.
void add_formats_left_out(const std::vector<Output>& outputs, std::vector<LeftOut>& list);

}  // namespace clay::solid
