#pragma once
// A collapsed pot as one solid: the union of the standing part and the fallen part.

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

/// The standing and the fallen part, each a body of revolution proved in the plane. Heights are
/// those of the whole stack, before the collapse.
struct CollapsedParts {
  StackProfile lower;
  StackProfile upper;  ///< no pieces if no clay stood above the failed ring
  PlanarCertificate lower_certificate;
  PlanarCertificate upper_certificate;
  Smoothing smoothing = Smoothing::none;  ///< as applied, the same for both parts
  std::string no_smoothing;               ///< reason why it was not applied although requested

  /// All pieces, lower ones first.
  [[nodiscard]] Profile together() const;
};

/// Rings 0 to `failed_ring`, and the rest with the crown. If one part cannot be smoothed, both keep
/// their steps. Steps too small for float32 (below 2^-20 of the largest distance from the origin)
/// are levelled as `profile_of` describes; a crown that fell alone and is no higher than that is
/// left out.
///
/// Errors: `bad_input` for a pot that has not collapsed or whose collapse is invalid (no such ring,
/// an axis that is not horizontal); `unsound` as for `profile_of` and `certify`.
Result<CollapsedParts> collapsed_parts(const Pot& pot, Smoothing smoothing, double tolerance_mm);

struct CollapsedSolid {
  TriangleMesh mesh;  ///< z up; every coordinate is a float32, so files store it unchanged
  MeshReport check;   ///< of `mesh`: sound
  /// From exact constructions, each summed in double over its own surface: union = lower + upper -
  /// overlap, and lower + upper is the counted clay.
  double lower_mm3 = 0.0;
  double upper_mm3 = 0.0;
  double overlap_mm3 = 0.0;
  double union_mm3 = 0.0;
  std::size_t pieces = 0;    ///< bodies that do not touch: 2 if the upper part fell clear
  std::size_t voids = 0;     ///< closed cavities, in the parts or trapped between them
  double voids_mm3 = 0.0;    ///< their volume
  std::size_t pockets = 0;   ///< also trapped, but shallower than the tolerance: filled
  double pockets_mm3 = 0.0;  ///< their volume
  double volume_mm3 = 0.0;   ///< of `mesh`: union and pockets, up to rounding
  /// Upper bound of the distance of clay that only the exact union or only `mesh` has from the
  /// surface of the other.
  double max_move_mm = 0.0;
  /// Part of it: upper bound of the displacement of the surface along the seam and by rounding. A
  /// wall may lose twice as much.
  double reshaped_mm = 0.0;
};

/// Both parts revolved in `segments` steps (the upper one possibly rotated against the lower), the
/// upper one moved by `collapse`, and united (CGAL corefinement with exact constructions). Edges
/// and triangle heights along the seam that rounding to float32 might invert are then removed.
/// Where the parts nearly touch, the upper one may be moved by up to 2^-14 of the largest
/// coordinate. Parts that do not touch stay separate shells. Deterministic.
///
/// Requires kMinSegments <= segments <= kMaxSegments. `bad_input` above kMaxUnitedTriangles;
/// `unsound` if a part is lost in float32, or if no attempt gives a sound mesh; the message names
/// the defect of the last attempt.
Result<CollapsedSolid> collapsed_solid(const CollapsedParts& parts, const Collapse& collapse,
                                       std::size_t segments, double tolerance_mm);

}  // namespace clay::solid::inline fallen
