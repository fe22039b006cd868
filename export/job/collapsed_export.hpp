#pragma once
#include "export/job/prepare.hpp"

namespace clay::solid::inline job {

/// `run_export` for a collapsed pot. Options that need a profile (normals, a field of walls) are
/// errors.
Result<ExportReport> export_collapsed(const PreparedPot& prepared,
                                      const std::vector<Output>& outputs,
                                      const ExportOptions& options,
                                      const std::function<void(std::string_view)>& progress);

}  // namespace clay::solid::inline job
