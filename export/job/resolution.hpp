#pragma once
// How finely a profile is revolved, and how coarse it must become for a budget of triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/section.hpp"

#include <cstddef>

namespace clay::solid::inline job {

/// Segments as forced, or the fewest whose chordal error, float32's rounding included, is within
/// the tolerance. Errors: settings out of range, a tolerance that cannot be kept (the least one is
/// named), too many triangles for any mesh.
/// `reach_mm` is that of what becomes of the profile, where that is farther from the origin.
Result<std::size_t> choose_segments(const Profile& profile, double tolerance_mm,
                                    const ExportOptions& options, double reach_mm = 0.0);

/// Several pieces are an error unless allowed; the message names the first rings that part.
Result<void> check_pieces(const std::vector<PieceShape>& shapes, bool allow_pieces);

}  // namespace clay::solid::inline job
