#pragma once
#include "claystack/engine/clay.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

namespace clay {

/// Radii that are multiples ("steps") of a precision in whole nanometres. The conversion from steps
/// to quanta uses integers only, so every platform reads the same pot.
class RadiusGrid {
 public:
  /// Below 10 nm, neighbouring radii near the axis have the same square in quanta.
  static constexpr double kFinestMm = 1e-5;
  static constexpr double kCoarsestMm = 1.0;
  /// Upper bound of second differences of radii: twice the largest radius in the finest steps.
  static constexpr std::int64_t kLargestDifference = 1'000'000'000;

  /// Empty if the precision is out of range, or not a whole number of nanometres.
  static std::optional<RadiusGrid> of(double precision_mm) {
    if (!(precision_mm >= kFinestMm && precision_mm <= kCoarsestMm)) return std::nullopt;
    // The division is correctly rounded: n / 10^6 is the double nearest to that decimal.
    const std::int64_t step_nm = std::llround(precision_mm * kNmPerMm);
    if (static_cast<double>(step_nm) / kNmPerMm != precision_mm) return std::nullopt;
    return RadiusGrid(step_nm);
  }

  [[nodiscard]] double radius_mm(std::int64_t steps) const {
    return static_cast<double>(steps * step_nm_) / kNmPerMm;
  }
  /// The square of a radius of 0 to kMaxRadiusMm, to the nearest quantum. A quantum is 5^12 / 2^24
  /// nm2. 5^12 is odd, so no square lies midway between two quanta.
  [[nodiscard]] Quanta square(std::int64_t steps) const {
    constexpr WideQuanta kDivisor = 244'140'625;
    const WideQuanta radius_nm = WideQuanta{steps} * step_nm_;
    return static_cast<Quanta>(((radius_nm * radius_nm << 24) + kDivisor / 2) / kDivisor);
  }
  /// The number of steps nearest to the radius; inverse of `square`.
  [[nodiscard]] std::int64_t steps(Quanta square) const {
    return std::llround(radius_from_quanta(square) * kNmPerMm / static_cast<double>(step_nm_));
  }
  [[nodiscard]] bool holds(Quanta square) const { return this->square(steps(square)) == square; }

 private:
  static constexpr double kNmPerMm = 1e6;
  explicit RadiusGrid(std::int64_t step_nm) : step_nm_(step_nm) {}

  std::int64_t step_nm_;
};

}  // namespace clay
