#include "claystack/export/fallen.hpp"

#include "claystack/engine/collapse.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/solid.hpp"
#include "export/fallen/mesh_union.hpp"
#include "export/fallen/pockets.hpp"
#include "export/proof/describe.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/proof/verify_file.hpp"
#include "export/solid/seam_cure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <new>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace clay::solid::inline fallen {
namespace {

/// A variation of the upper part's placement for one attempt.
struct Attempt {
  double phase = 0.0;  ///< rotation of its facets about its own axis, in segments
  double nudge = 0.0;  ///< displacement, in units of the float32 rounding
};

/// First as it fell: coinciding faces then merge. Where the parts mirror each other, equally
/// rotated facets intersect in needles, rotated ones (by the golden section and its multiples) do
/// not. Where faces nearly coincide, only a nudge separates them.
constexpr std::array kAttempts{Attempt{0.0, 0.0}, Attempt{0.381966, 0.0}, Attempt{0.763932, 64.0},
                               Attempt{0.145898, 256.0}, Attempt{0.527864, 1024.0}};
constexpr glm::dvec3 kNudge{0.36, 0.48, -0.8};  // a unit vector that is unlikely to lie in a facet

/// Shortest edges on the seam, in units of the float32 rounding. Longer ones leave room for the
/// rounding, but must not reach the short edges of the parts' own walls.
constexpr std::array kShortestEdges{64.0, 256.0, 1024.0, 16.0};

/// From the wheel's frame (y up) to the mesh's frame (z up).
glm::dvec3 upright(const glm::dvec3& p) { return {p.x, -p.z, p.y}; }

/// From the mesh's frame to the wheel's.
glm::dvec3 as_on_wheel(const glm::dvec3& p) { return {p.x, p.z, -p.y}; }

TriangleMesh turned_about_own_axis(TriangleMesh mesh, double angle_rad) {
  if (angle_rad == 0.0) return mesh;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (glm::dvec3& p : mesh.points) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return mesh;
}

TriangleMesh fallen(TriangleMesh mesh, const FallenPlace& place) {
  for (glm::dvec3& p : mesh.points) p = upright(place(as_on_wheel(p)));
  return mesh;
}

Result<void> check_part(const TriangleMesh& mesh, const std::string& name) {
  const MeshReport report = inspect_mesh(rounded_to_float(mesh));
  if (report.sound()) return {};
  return failure(ErrorKind::unsound,
                 "the " + name + " part in float32: found " + describe(report.problems.front()));
}

class Union {
 public:
  Union(const CollapsedParts& parts, const Collapse& collapse, std::size_t segments,
        double tolerance_mm)
      : tolerance_mm_(tolerance_mm),
        step_rad_(2.0 * std::numbers::pi / static_cast<double>(segments)),
        place_(collapse),
        lower_(revolve(parts.lower.profile, segments)),
        upper_(revolve(parts.upper.profile, segments)) {}

  Result<CollapsedSolid> run() {
    const bool any_fell = !upper_.triangles.empty();
    auto sound = check_part(lower_, "lower").and_then([&]() -> Result<void> {
      if (!any_fell) return {};
      return check_part(fallen(upper_, place_), "upper");
    });
    if (!sound) return tl::make_unexpected(sound.error());
    if (!any_fell) return standing();
    Result<CollapsedSolid> solid;
    for (const Attempt& attempt : kAttempts) {
      solid = with(attempt);
      if (solid) break;
    }
    return solid;
  }

 private:
  Result<CollapsedSolid> standing() const {
    CollapsedSolid solid;
    solid.lower_mm3 = solid.union_mm3 = signed_volume(lower_);
    return finished({lower_, 0.0}, std::move(solid));
  }

  Result<CollapsedSolid> with(const Attempt& attempt) const try {
    TriangleMesh upper = fallen(turned_about_own_axis(upper_, attempt.phase * step_rad_), place_);
    const double nudge = attempt.nudge * float_rounding_mm(upper);
    for (glm::dvec3& p : upper.points) p += nudge * kNudge;
    return unite(lower_, upper).and_then([&](const MeshUnion& both) {
      CollapsedSolid solid;
      solid.lower_mm3 = signed_volume(lower_);
      solid.upper_mm3 = signed_volume(upper);
      solid.overlap_mm3 = both.overlap_mm3;
      solid.union_mm3 = signed_volume(both.mesh);
      solid.max_move_mm = nudge;
      return cured(both, solid);
    });
  } catch (const std::bad_alloc&) {
    throw;  // further attempts would fail in the same way
  } catch (const std::logic_error& e) {
    return failure(ErrorKind::io, std::string("union failed: ") + e.what());  // in CGAL
  } catch (const std::exception& e) {
    return failure(ErrorKind::unsound, std::string("the union: ") + e.what());
  }

  Result<CollapsedSolid> cured(const MeshUnion& both, CollapsedSolid solid) const {
    const FilledPockets filled = fill_pockets(both.mesh, both.on_seam, tolerance_mm_);
    solid.pockets = filled.pockets;
    solid.pockets_mm3 = filled.volume_mm3;
    solid.max_move_mm += filled.max_ball_mm;
    const double rounding = float_rounding_mm(filled.mesh);
    Result<CollapsedSolid> result;
    for (const double shortest : kShortestEdges) {
      result = cure_seam(filled.mesh, filled.on_seam, shortest * rounding)
                   .and_then([&](const CuredMesh& mesh) { return finished(mesh, solid); });
      if (result) break;
    }
    return result;
  }

  static Result<CollapsedSolid> finished(const CuredMesh& cured, CollapsedSolid solid) {
    solid.mesh = rounded_to_float(cured.mesh);
    solid.check = inspect_mesh(solid.mesh);
    if (!solid.check.sound())
      return failure(ErrorKind::unsound, "the collapsed pot in float32: found " +
                                             describe(solid.check.problems.front()));
    double rounding = 0.0;
    for (std::size_t v = 0; v < solid.mesh.points.size(); ++v)
      rounding = std::max(rounding, glm::distance(solid.mesh.points[v], cured.mesh.points[v]));
    solid.reshaped_mm = cured.max_move_mm + rounding;
    solid.max_move_mm += solid.reshaped_mm;
    solid.volume_mm3 = signed_volume(solid.mesh);
    for (const double volume : shell_volumes(solid.mesh)) {
      if (volume > 0.0) {
        ++solid.pieces;
      } else {
        ++solid.voids;
        solid.voids_mm3 -= volume;
      }
    }
    return solid;
  }

  double tolerance_mm_;
  double step_rad_;
  FallenPlace place_;
  TriangleMesh lower_;
  TriangleMesh upper_;  ///< before the collapse
};

}  // namespace

Result<CollapsedSolid> collapsed_solid(const CollapsedParts& parts, const Collapse& collapse,
                                       std::size_t segments, double tolerance_mm) try {
  const std::size_t triangles = triangle_count(parts.together(), segments);
  if (triangles > kMaxUnitedTriangles)
    return failure(ErrorKind::bad_input, "expected at most " + std::to_string(kMaxUnitedTriangles) +
                                             " triangles in parts to be united, found " +
                                             std::to_string(triangles) +
                                             "; ask for a larger tolerance or fewer segments");
  return Union(parts, collapse, segments, tolerance_mm).run();
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, "union stopped: not enough memory");
} catch (const std::exception& e) {
  return failure(ErrorKind::io, std::string("union failed: ") + e.what());
}

}  // namespace clay::solid::inline fallen
