#pragma once
// libm's sine, cosine and hypotenuse may differ in the last bit between platforms, and a collapse
// writes that bit to the pot file, an export to a certificate. These use only +, -, *, / and sqrt,
// which IEEE 754 defines exactly.

namespace clay {

struct CosSin {
  double cosine = 1.0;
  double sine = 0.0;
};

/// For angles of magnitude at most kMostRad: within 1e-9 ulp of the nearest double, so about one
/// result in 10^9 is not the nearest. NaN for NaN and for larger angles.
[[nodiscard]] CosSin cos_sin(double angle_rad) noexcept;
inline constexpr double kMostRad = 1e6;

/// sqrt(x^2 + y^2), with the same accuracy, without intermediate overflow or underflow.
[[nodiscard]] double length_of(double x, double y) noexcept;

}  // namespace clay
