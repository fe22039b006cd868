#pragma once
#include "export/job/prepare.hpp"

#include <functional>
#include <string_view>
#include <vector>

namespace clay::solid::inline job {

/// `run_export` for a standing pot: revolves its section.
Result<ExportReport> export_revolved(const PreparedPot& prepared,
                                     const std::vector<Output>& outputs,
                                     const ExportOptions& options,
                                     const std::function<void(std::string_view)>& progress);

}  // namespace clay::solid::inline job
