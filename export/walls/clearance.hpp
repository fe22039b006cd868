#pragma once
// Margins for rounding: displacements of the vertices of a solid that cannot make it intersect
// itself.

#include "claystack/export/section.hpp"

namespace clay::solid::inline walls {

struct Clearance {
  /// Lower bound of the distance between any vertex and any edge, of any piece, not incident to it,
  /// and so between any two edges without a common vertex.
  double distance_mm = 0.0;
  double least_radius_mm = 0.0;  ///< smallest rho > 0 of a vertex
  ProfilePoint at;               ///< a nearest vertex
};

/// The margins of a certified profile.
///
/// A map that is linear on the simplices of a mesh is injective if simplices without a common
/// vertex stay apart; so vertices that move by less than half of their minimum distance leave the
/// mesh embedded. Parts of the n-gon revolve above different parts of the profile are at least as
/// far apart as these with every rho multiplied by `rho_scale`: f cos(pi / n), at most 1, where f
/// is the equal-volume factor. This is `distance_mm`. Parts of one parallel are at least as far
/// apart as its chords, which shrink towards the axis: `least_radius_mm`, also scaled, times
/// sin(2 pi / n) bounds them, and also everything across the axis. Edges on the axis make no
/// surface; they are included like the others, because their ends are poles, and cost nothing,
/// because off the axis no vertex is nearer to it than the smallest radius.
///
/// `distance_mm` is a true lower bound: the possible rounding error is subtracted.
[[nodiscard]] Clearance clearance(const Profile& profile, double rho_scale = 1.0);

/// `clearance(profile, rho_scale).distance_mm`.
[[nodiscard]] double clearance_mm(const Profile& profile, double rho_scale = 1.0);

}  // namespace clay::solid::inline walls
