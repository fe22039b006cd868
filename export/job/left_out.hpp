#pragma once
// Skipped stages of an export: the reason, and (if requested) the time that each would have taken.

#include "claystack/export/job.hpp"
#include "export/solid/revolve_layout.hpp"

#include <string>
#include <vector>

namespace clay::solid::inline job {

/// Names of the stages that `measure_left_out` measures.
inline constexpr const char *kSmoothingStage = "smoothing", *kMeshStage = "mesh in memory",
                            *kVerificationStage = "full verification";

/// For a standing pot. `no_smoothing`: why it was not smoothed; empty if it was.
std::vector<SkippedStage> left_out(const ClayStack& stack, const std::string& no_smoothing,
                                   const RevolveLayout& rule, bool made_mesh,
                                   const std::vector<Output>& outputs,
                                   const ExportOptions& options);

/// Measures the skipped stages of a list that take this mesh or the section.
void measure_left_out(std::vector<SkippedStage>& list, const ClayStack& stack,
                      const TriangleMesh& mesh, const ExportOptions& options);

/// Adds the formats that were not requested.
void add_formats_left_out(const std::vector<Output>& outputs, std::vector<SkippedStage>& list);

}  // namespace clay::solid::inline job
