#pragma once
#include "claystack/export/section.hpp"
#include "export/solid/revolve_layout.hpp"

#include <vector>

namespace clay::solid::inline job {

struct PointWalls {
  std::vector<float> mm;  ///< at each point of `revolve(rule)`, in its order: see `vertex_walls`
  double top_mm = 0.0;    ///< of the scale of colours for them
};

/// `rule` is a layout of this profile.
[[nodiscard]] PointWalls walls_of_points(const RevolveLayout& rule, const Profile& profile);

}  // namespace clay::solid::inline job
