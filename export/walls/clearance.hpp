#pragma once
// How far the vertices of a solid may be moved, by rounding, before it could meet itself.

#include "claystack/export/section.hpp"

namespace clay::solid::inline walls {

struct Clearance {
  /// No more than the distance between any vertex and any edge, of any piece, that it does not
  /// belong to, and so between any two edges without a common vertex.
  double distance_mm = 0.0;
  double least_radius_mm = 0.0;  ///< least rho > 0 of a vertex
  ProfilePoint at;               ///< a vertex that is nearest
};

/// The margins of a certified profile.
///
/// A map that is linear on the simplices of a mesh is injective if those without a common vertex
/// keep apart, and so vertices that move by less than half of their least distance leave the
/// mesh embedded. Parts of the n-gon revolve that lie above different parts of the profile are at
/// least as far apart as these are with every rho multiplied by `rho_scale` = cos(pi / n):
/// `distance_mm`. Parts of one parallel are as near as its chords, which shrink towards the axis:
/// `least_radius_mm`, scaled too, times sin(2 pi / n) bounds them, and with it what lies across
/// the axis, which needs no distance of its own. Edges on the axis make no surface; they count
/// like the others, for their ends are poles, and cost nothing, since off the axis no vertex is
/// nearer to it than the least radius.
///
/// `distance_mm` is a true lower bound: what rounding in its computation can add is taken off.
[[nodiscard]] Clearance clearance(const Profile& profile, double rho_scale = 1.0);

/// `clearance(profile, rho_scale).distance_mm`.
[[nodiscard]] double clearance_mm(const Profile& profile, double rho_scale = 1.0);

}  // namespace clay::solid::inline walls
