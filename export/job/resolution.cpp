#include "export/job/resolution.hpp"

#include "claystack/export/job.hpp"
#include "claystack/export/solid.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace clay::solid::inline job {
namespace {

struct Extent {
  double radius = 0.0;
  double reach = 0.0;  ///< distance from the origin
};

Extent extent_of(const Profile& profile) {
  Extent extent;
  for (const Polygon& polygon : profile.pieces)
    for (const ProfilePoint& p : polygon) {
      extent.radius = std::max(extent.radius, p.rho);
      extent.reach = std::max(extent.reach, std::hypot(p.rho, p.y));
    }
  return extent;
}

Result<std::size_t> segments_within(const Profile& profile, double tolerance_mm, double reach_mm) {
  const Extent extent = extent_of(profile);
  // The vertices lie slightly outside the radius; the factor 2 covers that.
  const double rounding = std::ldexp(2.0 * std::max(extent.reach, reach_mm), -24);
  const double budget = tolerance_mm - rounding;
  const std::size_t segments = segments_for(extent.radius, budget);
  if (budget > 0.0 && chordal_error_mm(extent.radius, segments) <= budget) return segments;
  return failure(ErrorKind::bad_input,
                 "tolerance: expected at least " +
                     sufficient_text(rounding + chordal_error_mm(extent.radius, kMaxSegments)) +
                     " mm for a pot of this size, found " + nine_digit_text(tolerance_mm) + " mm");
}

}  // namespace

Result<std::size_t> choose_segments(const Profile& profile, double tolerance_mm,
                                    const ExportOptions& options, double reach_mm) {
  return options.segments ? Result<std::size_t>(*options.segments)
                          : segments_within(profile, tolerance_mm, reach_mm);
}

Result<void> check_triangles(std::size_t triangles, std::size_t segments,
                             const ExportOptions& options) {
  if (triangles <= kMaxTriangles || options.max_triangles) return {};
  return failure(ErrorKind::bad_input,
                 "expected a mesh of at most " + std::to_string(kMaxTriangles) +
                     " triangles, but " + std::to_string(segments) + " segments make " +
                     std::to_string(triangles) + "; use a larger tolerance or fewer segments");
}

Result<void> check_height(double height_mm) {
  if (height_mm <= double{kMaxCoordinateMm}) return {};
  return failure(ErrorKind::bad_input,
                 "height: expected at most " + nine_digit_text(double{kMaxCoordinateMm}) +
                     " mm for a mesh, found " + nine_digit_text(height_mm) + " mm");
}

double vertex_error_mm(double tolerance_mm, double wall_mm, const std::optional<WallLimit>& limit) {
  if (!limit || !limit->met_by(wall_mm)) return tolerance_mm;
  // A little less than half, for rounding.
  constexpr double kPart = 0.499;
  return std::min(tolerance_mm, kPart * (wall_mm - limit->least_mm()));
}

Result<void> check_pieces(const std::vector<PieceShape>& shapes, bool allow_pieces) {
  if (shapes.size() < 2 || allow_pieces) return {};
  return failure(ErrorKind::unsound,
                 "expected a pot in one piece, found " + std::to_string(shapes.size()) +
                     " that do not touch: rings " + std::to_string(shapes[0].last_ring) + " and " +
                     std::to_string(shapes[1].first_ring) + " are the first that do not touch; " +
                     kPermitPieces + " to export them");
}

}  // namespace clay::solid::inline job
