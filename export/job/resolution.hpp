#pragma once
// The resolution of a revolve, and the coarser one that meets a limit of triangles.

#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/section.hpp"

#include <cstddef>
#include <optional>

namespace clay::solid::inline job {

/// The requested number of segments, or the smallest one whose chordal error, including the
/// rounding to float32, is within the tolerance. Errors: settings out of range, a tolerance that is
/// too small (the message states the smallest possible one).
/// `reach_mm`: largest distance of the solid from the origin, if that exceeds the profile's.
Result<std::size_t> choose_segments(const Profile& profile, double tolerance_mm,
                                    const ExportOptions& options, double reach_mm = 0.0);

/// An error if that would be too many triangles for any mesh, and no limit makes it coarser.
Result<void> check_triangles(std::size_t triangles, std::size_t segments,
                             const ExportOptions& options);

/// An error if a mesh of that height has coordinates that no reader of meshes accepts. Radii are
/// far below that limit.
Result<void> check_height(double height_mm);

/// Maximum distance of the vertices of a file from their places [mm]: the tolerance, or less if a
/// wall that meets its limit would not meet it in the file. `wall_mm`: lower bound of the wall
/// before its vertices, on both sides of it, are moved.
double vertex_error_mm(double tolerance_mm, double wall_mm, const std::optional<WallLimit>& limit);

/// Several pieces are an error unless permitted; the message names the first rings that do not
/// touch.
Result<void> check_pieces(const std::vector<PieceShape>& shapes, bool allow_pieces);

}  // namespace clay::solid::inline job
