#pragma once
#include "claystack/export/profile.hpp"
#include "claystack/export/triangle_mesh.hpp"

#include <cstddef>

namespace clay::solid {

inline constexpr std::size_t kMinSegments = 3;
inline constexpr std::size_t kMaxSegments = std::size_t{1} << 20;

/// The revolve of a certified profile by `segments` equal steps about the axis, z up (for
/// printers): the profile's y is the mesh's z. Radii carry the equal-volume factor
/// sqrt((2 pi/n) / sin(2 pi/n)), so that the mesh holds exactly the clay of the profile.
/// Each polygon gives a shell where it never meets the axis, else one for each of its stretches
/// between axis segments (a closed cavity is a shell oriented inward). Vertices are shared, with
/// one for each pole; there is no -0. Needs kMinSegments <= segments <= kMaxSegments and
/// triangle_count() <= kMaxTriangles.
TriangleMesh revolve(const Profile& profile, std::size_t segments);

/// How many triangles `revolve` makes.
[[nodiscard]] std::size_t triangle_count(const Profile& profile, std::size_t segments) noexcept;

/// Largest distance [mm] between a circle of radius `radius_mm` and its equal-area n-gon.
[[nodiscard]] double chordal_error_mm(double radius_mm, std::size_t segments) noexcept;

/// The fewest segments (at least 8, a multiple of 4) whose chordal error is within the tolerance;
/// kMaxSegments where even they do not reach it.
[[nodiscard]] std::size_t segments_for(double radius_mm, double tolerance_mm) noexcept;

}  // namespace clay::solid
