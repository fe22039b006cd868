#pragma once
// libm's exp may differ in its last bit between platforms, and one bit changes the clay. These use
// only +, *, / and exact scaling, which IEEE 754 defines exactly.

#include <cmath>

namespace clay {

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
