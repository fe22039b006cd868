#pragma once
// The proof in the plane. For every n >= 3 the n-gon revolve of a profile is closed and
// embedded if each polygon is strictly simple, they are disjoint, and they meet the axis in
// segments of positive length only (each sector is a prism over the profile with rho scaled
// by cos(pi/n), and a homeomorphism takes the smooth revolve to the polygonal one).

#include "claystack/engine/result.hpp"
#include "claystack/export/profile.hpp"

#include <cstddef>

namespace clay::solid {

struct PlanarCertificate {
  std::size_t polygons = 0;
  std::size_t vertices = 0;
  std::size_t axis_segments = 0;
};

/// Exact predicates throughout. The error (kind `unsound`) names the first place that fails. Made
/// for sections of stacks, which have few edges at any one height: more than 1000 are an error.
Result<PlanarCertificate> certify(const Profile& profile);

}  // namespace clay::solid
