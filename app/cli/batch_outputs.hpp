#pragma once
// The files that the jobs of a batch write.

#include "app/cli/batch_pool.hpp"
#include "claystack/core/result.hpp"

#include <string>
#include <vector>

namespace clay::cli {

/// Refuses two jobs that write the same file: at the same time, one would replace the output of the
/// other. `path`: of the jobs, for the message.
Result<void> check_job_outputs(const std::vector<BatchJob>& jobs, const std::string& path);

}  // namespace clay::cli
