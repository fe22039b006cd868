#pragma once
// libm's sine, cosine and hypotenuse may differ in the last bit between platforms, and a fall takes
// that bit into the file of the pot. These use only +, -, *, / and sqrt, which IEEE 754 fixes.

namespace clay {

struct CosSin {
  double cosine = 1.0;
  double sine = 0.0;
};

/// Of an angle of at most kMostRad either way: within 1e-9 ulp of the nearest double, so that the
/// nearest double is missed about once in 10^9 angles. NaN for NaN and for angles beyond.
[[nodiscard]] CosSin cos_sin(double angle_rad) noexcept;
inline constexpr double kMostRad = 1e6;

/// sqrt(x^2 + y^2), as close to the nearest double, without overflow or underflow on the way.
[[nodiscard]] double length_of(double x, double y) noexcept;

}  // namespace clay
