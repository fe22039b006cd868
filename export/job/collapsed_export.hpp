#pragma once
#include "export/job/prepare.hpp"

namespace clay::solid::inline job {

/// Options that need one profile, such as a finish or a field of walls, are errors (bad_input).
[[nodiscard]] Result<void> check_collapsed_options(const ExportOptions& options);

/// `run_export` for a collapsed pot.
Result<ExportReport> export_collapsed(const PreparedPot& prepared,
                                      const std::vector<Output>& outputs,
                                      const ExportOptions& options,
                                      const std::function<void(std::string_view)>& progress);

}  // namespace clay::solid::inline job
