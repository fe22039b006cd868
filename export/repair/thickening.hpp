#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/repair.hpp"
#include "export/repair/half_edge_surface.hpp"
#include "export/repair/stage_report.hpp"

namespace clay::solid::inline repair {

/// The reach of the wrap of a wall, in half its thickness: openings that it enters.
inline constexpr double kThickenAlpha = 2.0;

/// A wall around the open surface, and `soup`, its triangles before they were joined. Fills small
/// holes first. Moves the vertices to both sides; where that gives no sound wall, wraps the soup.
/// `reason` is that why the mesh is open. Sets `thickened` of the report, and adds to `holes` and
/// `repaired`. Errors: `unsound` if no sound wall is found.
Result<TriangleMesh> thickened(const TriangleMesh& soup, Surface surface, double asked_mm,
                               const Error& reason, RepairedMesh& report, StageReport& stage);

/// A wrap if it is sound, otherwise the error with both reasons.
Result<TriangleMesh> wrapped_or_error(const TriangleMesh& soup, double offset_mm, double alpha_mm,
                                      const Error& reason);

}  // namespace clay::solid::inline repair
