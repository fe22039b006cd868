#pragma once
// The file of the jobs of a batch.

#include "app/cli/batch_pool.hpp"
#include "claystack/core/result.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace clay::cli {

/// The commands that a job may run.
inline constexpr std::array kRunnable = {"check",  "export",  "import", "plan",
                                         "render", "strokes", "throw"};

/// Wrong lines of a file of jobs that a batch reports.
inline constexpr std::size_t kMostWrongLines = 10;

/// Strict: a wrong line refuses the whole batch before the first job. The error is that of the
/// first wrong line; `wrong` gets the messages of the first kMostWrongLines, that one included, and
/// a message with the number of the others. It stays empty if the file is not one of jobs.
Result<std::vector<BatchJob>> read_jobs(const std::string& path, std::vector<std::string>& wrong);

/// The part of one task of a job array: job K, K + N, ... of "K/N", and the jobs that wait for
/// them. Empty: all.
Result<std::vector<BatchJob>> jobs_of_part(std::vector<BatchJob> jobs, const std::string& part);

}  // namespace clay::cli
