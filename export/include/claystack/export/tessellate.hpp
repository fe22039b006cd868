#pragma once
#include "claystack/export/profile.hpp"
#include "claystack/export/triangle_mesh.hpp"

#include <cstddef>

namespace clay::solid {

/// The revolve of a profile by `segments` equal steps about the axis, z up (for printers).
/// Radii carry the equal-volume factor sqrt((2 pi/n) / sin(2 pi/n)), so that the mesh holds
/// exactly the clay of the profile. Vertices are shared; there is no -0.
TriangleMesh revolve(const Profile& profile, std::size_t segments);

/// Largest distance [mm] between a circle of radius `radius_mm` and its equal-area n-gon.
[[nodiscard]] double chordal_error_mm(double radius_mm, std::size_t segments) noexcept;

/// The fewest segments (at least 8, a multiple of 4) whose chordal error is within the tolerance.
[[nodiscard]] std::size_t segments_for(double radius_mm, double tolerance_mm) noexcept;

}  // namespace clay::solid
