#pragma once
#include "claystack/export/solid.hpp"

#include <cmath>

namespace clay::solid {

struct SignedVolume {
  double mm3 = 0.0;
  double error_mm3 = 0.0;  ///< upper bound of its rounding error
  [[nodiscard]] bool sign_is_certain() const noexcept { return std::abs(mm3) > error_mm3; }
};

/// signed_volume() with a bound of its error: a filter before exact orientation tests. Requires
/// indices in range and points within 1e100 mm.
[[nodiscard]] SignedVolume bounded_volume(const TriangleMesh& mesh) noexcept;

}  // namespace clay::solid
