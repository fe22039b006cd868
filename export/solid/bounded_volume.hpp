#pragma once
#include "claystack/export/solid.hpp"

#include <cmath>

namespace clay::solid {

struct SignedVolume {
  double mm3 = 0.0;
  double error_mm3 = 0.0;  ///< bound of what rounding has done to it
  [[nodiscard]] bool sign_is_certain() const noexcept { return std::abs(mm3) > error_mm3; }
};

/// signed_volume() with a bound on its error: a filter before exact tests of orientation. Indices
/// are in range, points within 1e100 mm.
[[nodiscard]] SignedVolume bounded_volume(const TriangleMesh& mesh) noexcept;

}  // namespace clay::solid
