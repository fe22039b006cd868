#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"
#include "export/job/stages.hpp"

namespace clay::solid::inline job {

/// Writes the solid of a proved section for CAD, proves the section of its surfaces as well, and
/// judges the bytes as read back.
Result<FileReport> write_step(const ProvedSection& section, double counted_volume_mm3,
                              const ExportOptions& options, FileStore& store, Stages& stages);

}  // namespace clay::solid::inline job
