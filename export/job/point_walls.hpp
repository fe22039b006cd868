#pragma once
#include "claystack/export/section.hpp"
#include "export/solid/revolve_layout.hpp"

#include <vector>

namespace clay::solid::inline job {

/// The wall [mm] at each point of `revolve(rule)`, in its order: see `vertex_walls`. `rule` is a
/// layout of this profile.
[[nodiscard]] std::vector<float> walls_of_points(const RevolveLayout& rule, const Profile& profile);

}  // namespace clay::solid::inline job
