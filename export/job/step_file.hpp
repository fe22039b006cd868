#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"
#include "export/job/stages.hpp"

namespace clay::solid::inline job {

/// Writes the solid of a proved section for CAD, proves the section of its surfaces as well, and
/// judges the bytes as read back. Curves lie within the tolerance, or closer if a wall that meets
/// its limit would not meet it in the file.
Result<FileReport> write_step(const ExportReport& report, const ExportOptions& options,
                              FileStore& store, Stages& stages);

}  // namespace clay::solid::inline job
