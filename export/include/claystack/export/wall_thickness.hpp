#pragma once
#include "claystack/export/profile.hpp"

namespace clay::solid {

/// Least thickness [mm] of what a certified profile sweeps, exact for its edges: from bores to the
/// outside, through floors and lids along the axis, and across where there is no bore. Flanges
/// that stick out of a wall are not looked at. For the n-gon revolve, multiply by cos(pi/n): its
/// sectors are the profile with rho scaled so.
[[nodiscard]] double min_wall_mm(const Profile& profile) noexcept;

}  // namespace clay::solid
