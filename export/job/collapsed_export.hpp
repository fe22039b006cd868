#pragma once
#include "claystack/export/job.hpp"

namespace clay::solid::inline job {

/// `run_export` for a collapsed pot. What asks for a profile (a drain, normals) is an error.
Result<ExportReport> export_collapsed(const Pot& pot, const std::vector<Output>& outputs,
                                      const ExportOptions& options,
                                      const std::function<void(std::string_view)>& progress);

}  // namespace clay::solid::inline job
