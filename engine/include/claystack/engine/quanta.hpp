#pragma once
// Clay is counted, not measured: squared radii are integers, so that volume is
// moved without rounding and a replay gives the same bits everywhere.

#include <cmath>
#include <cstdint>
#include <string>

namespace clay {

/// A count of 2^-36 mm^2, the unit of squared radii. A ring of height h that
/// spans q quanta holds pi * h * q * 2^-36 mm^3.
using Quanta = std::int64_t;

/// Sums of quanta over a whole stack (up to 2^24 rings of 2^61 quanta).
__extension__ typedef __int128 WideQuanta;

inline constexpr double kQuantaPerMm2 = 68719476736.0;  // 2^36
inline constexpr double kMm2PerQuantum = 1.0 / kQuantaPerMm2;

inline constexpr double kMinRadiusMm = 1e-3;
inline constexpr double kMaxRadiusMm = 5000.0;
inline constexpr std::size_t kMaxRings = std::size_t{1} << 24;

/// The squared radius nearest to `mm2` [mm^2], halves up. Needs 0 <= mm2 < 1.3e8.
[[nodiscard]] inline Quanta quanta_from_mm2(double mm2) noexcept {
  return static_cast<Quanta>(mm2 * kQuantaPerMm2 + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}
[[nodiscard]] inline Quanta quanta_from_radius(double mm) noexcept {
  return quanta_from_mm2(mm * mm);
}
[[nodiscard]] inline double mm2_from_quanta(Quanta q) noexcept {
  return static_cast<double>(q) * kMm2PerQuantum;
}
[[nodiscard]] inline double mm2_from_quanta(WideQuanta q) noexcept {
  return static_cast<double>(q) * kMm2PerQuantum;
}
/// Radius [mm] of a squared radius. IEEE sqrt is exact to half an ulp on every platform.
[[nodiscard]] inline double radius_from_quanta(Quanta q) noexcept {
  return std::sqrt(mm2_from_quanta(q));
}

/// Decimal digits of a wide count, for files and messages.
[[nodiscard]] std::string to_string(WideQuanta q);

}  // namespace clay
