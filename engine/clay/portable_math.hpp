#pragma once
// libm's exp may differ in its last bit between platforms, and one bit changes the clay. These use
// only +, *, / and exact scaling, which IEEE 754 defines exactly.

#include <cmath>

namespace clay {

/// exp(x) for x >= 0, such that 1 / exp(x) is right to 1e-11: the series of exp(x / 128) to the
/// fifth power, squared seven times. No branch, no division; +inf where x is large.
[[nodiscard]] inline double exp_of(double x) noexcept {
  const double z = x * (1.0 / 128.0);
  const double e =
      1.0 + z * (1.0 + z * (1.0 / 2 + z * (1.0 / 6 + z * (1.0 / 24 + z * (1.0 / 120)))));
  const double e2 = e * e, e4 = e2 * e2, e8 = e4 * e4, e16 = e8 * e8, e32 = e16 * e16;
  const double e64 = e32 * e32;
  return e64 * e64;
}

[[nodiscard]] inline double exp_neg(double x) noexcept { return 1.0 / exp_of(x); }

/// 1 - exp(-x) for x >= 0, to about 2 ulp, also for tiny x; 1 for x > 40 or +inf.
[[nodiscard]] inline double one_minus_exp_neg(double x) noexcept {
  if (!(x > 0.0)) return 0.0;
  if (x > 40.0) return 1.0;
  int halvings = 0;
  while (x > 0.25) {
    x *= 0.5;
    ++halvings;
  }
  double series = 0.0;  // x - x^2/2! + x^3/3! - ..., by Horner
  for (int n = 14; n >= 1; --n) series = x * (1.0 / n) * (1.0 - series);
  for (; halvings > 0; --halvings) series *= 2.0 - series;  // 1-e^-2x = u (2 - u)
  return series;
}

}  // namespace clay
