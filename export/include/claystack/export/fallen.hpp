#pragma once
// A collapsed pot as one solid: the union of what stands and of what fell over it.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <string>

namespace clay::solid::inline fallen {

/// The most triangles of both parts together: exact numbers take ten times the memory of doubles.
inline constexpr std::size_t kMaxUnitedTriangles = 4'000'000;

/// What stands and what fell, each as a body of revolution that is proved in the plane. Heights
/// are those of the whole stack, before the fall.
struct CollapsedParts {
  StackProfile lower;
  StackProfile upper;  ///< no pieces where no clay stood above the failed ring
  PlanarCertificate lower_certificate;
  PlanarCertificate upper_certificate;
  Smoothing smoothing = Smoothing::none;  ///< as done, for both parts alike
  std::string no_smoothing;               ///< why not, where it was asked for and not done

  /// All pieces, lower ones first.
  [[nodiscard]] Profile together() const;
};

/// Rings 0 to `failed_ring`, and the rest with the crown. Where one part cannot be smoothed, the
/// steps of both stay as they are. Steps that float32 cannot hold (below 2^-20 of the largest
/// distance from the origin) are levelled as `profile_of` describes; so is a crown that fell by
/// itself and is no higher than that: it is left out.
///
/// Errors: `bad_input` for a pot that has not collapsed or whose collapse is none (no such ring,
/// an axis that is not horizontal); `unsound` as `profile_of` and `certify`.
Result<CollapsedParts> collapsed_parts(const Pot& pot, Smoothing smoothing, double tolerance_mm);

struct CollapsedSolid {
  TriangleMesh mesh;  ///< z up; every coordinate is a float32, so that files hold it as it is
  MeshReport check;   ///< of `mesh`: sound
  /// By exact constructions, each summed in double over its own surface:
  /// union = lower + upper - overlap, and lower + upper is the counted clay.
  double lower_mm3 = 0.0;
  double upper_mm3 = 0.0;
  double overlap_mm3 = 0.0;
  double union_mm3 = 0.0;
  std::size_t pieces = 0;    ///< bodies that do not touch: 2 where the upper part fell clear
  std::size_t voids = 0;     ///< closed cavities, of the parts or trapped between them
  double voids_mm3 = 0.0;    ///< what they hold
  std::size_t pockets = 0;   ///< trapped too, but less deep than the tolerance: filled
  double pockets_mm3 = 0.0;  ///< what they held
  double volume_mm3 = 0.0;   ///< of `mesh`: union and pockets, but for the rounding
  double max_move_mm = 0.0;  ///< of the surface from the exact union to `mesh`, at most
};

/// Both parts revolved by `segments` (the upper one perhaps out of step with the lower), the upper
/// one moved by `collapse`, and united (CGAL corefinement with exact constructions). Edges and
/// heights of triangles along the seam that rounding to float32 might turn over are then removed.
/// Where parts all but touch, the upper one may be nudged by up to 2^-14 of the largest
/// coordinate. Parts that do not touch stay shells of their own. The same mesh every time.
///
/// Needs kMinSegments <= segments <= kMaxSegments. `bad_input` beyond kMaxUnitedTriangles;
/// `unsound` when a part is lost in float32, or when no attempt gives a sound mesh; the message
/// tells what the last one lacked.
Result<CollapsedSolid> collapsed_solid(const CollapsedParts& parts, const Collapse& collapse,
                                       std::size_t segments, double tolerance_mm);

}  // namespace clay::solid::inline fallen
