#pragma once
// The resolution of a revolve, and the coarser one that meets a limit of triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/section.hpp"

#include <cstddef>

namespace clay::solid::inline job {

/// The requested number of segments, or the smallest one whose chordal error, including the
/// rounding to float32, is within the tolerance. Errors: settings out of range, a tolerance that is
/// too small (the message states the smallest possible one), too many triangles for any mesh.
/// `reach_mm`: largest distance of the solid from the origin, if that exceeds the profile's.
Result<std::size_t> choose_segments(const Profile& profile, double tolerance_mm,
                                    const ExportOptions& options, double reach_mm = 0.0);

/// Several pieces are an error unless permitted; the message names the first rings that do not
/// touch.
Result<void> check_pieces(const std::vector<PieceShape>& shapes, bool allow_pieces);

}  // namespace clay::solid::inline job
