#pragma once
// How finely a profile is revolved, and how coarse it must become for a budget of triangles.

#include "claystack/engine/result.hpp"
#include "claystack/export/export_job.hpp"
#include "claystack/export/profile.hpp"

#include <cstddef>

namespace clay::solid {

/// Segments as forced, or the fewest whose chordal error, float32's rounding included, is within
/// the tolerance. Errors: settings out of range, a tolerance that cannot be kept (the least one is
/// named), too many triangles for any mesh.
Result<std::size_t> choose_segments(const Profile& profile, double tolerance_mm,
                                    const ExportOptions& options);

}  // namespace clay::solid
