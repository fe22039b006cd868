#include "core/portable_trig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace clay {
namespace {

/// The unevaluated sum of two doubles: 106 bits. After Dekker, "A floating-point technique for
/// extending the available precision", Numer. Math. 18 (1971).
struct Double2 {
  double high = 0.0;
  double low = 0.0;
};

/// a + b, exactly.
Double2 exact_sum(double a, double b) noexcept {
  const double sum = a + b, b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// Splits a factor into two halves of 26 bits.
Double2 halves(double a) noexcept {
  const double shifted = 134217729.0 * a;  // 2^27 + 1
  const double high = shifted - (shifted - a);
  return {high, a - high};
}

/// a b, exactly.
Double2 exact_product(double a, double b) noexcept {
  const double product = a * b;
  const Double2 x = halves(a), y = halves(b);
  const double rest = ((x.high * y.high - product) + x.high * y.low) + x.low * y.high;
  return {product, rest + x.low * y.low};
}

Double2 operator+(Double2 a, Double2 b) noexcept {
  const Double2 high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const Double2 sum = exact_sum(high.high, high.low + low.high);
  return exact_sum(sum.high, sum.low + low.low);
}

Double2 operator-(Double2 a) noexcept { return {-a.high, -a.low}; }

Double2 operator*(Double2 a, Double2 b) noexcept {
  const Double2 high = exact_product(a.high, b.high);
  return exact_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

Double2 operator/(Double2 a, double b) noexcept {
  const double first = a.high / b;
  const Double2 rest = a + -exact_product(first, b);
  return exact_sum(first, rest.high / b);
}

/// 1 - x/((n-1) n) (1 - x/((n-3)(n-2)) (1 - ...)), from n = `last` down to n = `first`.
Double2 alternating(Double2 x, int first, int last) noexcept {
  Double2 series{1.0, 0.0};
  for (int n = last; n >= first; n -= 2)
    series = Double2{1.0, 0.0} + -(x * series / static_cast<double>(n * (n - 1)));
  return series;
}

/// angle - turns pi/2. The four constants hold enough digits of pi/2 for a relative error of 2^-90
/// even close to a multiple of it.
Double2 reduced(double angle_rad, double turns) noexcept {
  constexpr double kHalfPi[] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54,
                                -0x1.f1976b7ed8fbcp-110, 0x1.4cf98e804177dp-164};
  Double2 rest{angle_rad, 0.0};
  for (const double part : kHalfPi) rest = rest + -exact_product(turns, part);
  return rest;
}

}  // namespace

CosSin cos_sin(double angle_rad) noexcept {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (!(std::abs(angle_rad) <= kMostRad)) return {kNaN, kNaN};
  // The square of such an angle is below half an ulp of 1, and may underflow.
  if (std::abs(angle_rad) < 1e-8) return {1.0, angle_rad};
  constexpr double kPerRad = 0.63661977236758134308;  // 2/pi
  const auto quarter =
      static_cast<std::int64_t>(angle_rad * kPerRad + (angle_rad < 0 ? -0.5 : 0.5));
  const Double2 rest = reduced(angle_rad, static_cast<double>(quarter)), square = rest * rest;
  const double c = alternating(square, 2, 28).high;
  const double s = (rest * alternating(square, 3, 29)).high;
  switch (quarter & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

double length_of(double x, double y) noexcept {
  const double larger = std::max(std::abs(x), std::abs(y));
  if (larger == 0.0 || !(larger <= std::numeric_limits<double>::max())) return larger;
  const double scale = larger > 0x1p500 ? 0x1p-600 : larger < 0x1p-400 ? 0x1p600 : 1.0;
  const Double2 square = exact_product(scale * x, scale * x) + exact_product(scale * y, scale * y);
  const double root = std::sqrt(square.high);
  const Double2 rest = square + -exact_product(root, root);
  return (root + rest.high / (2.0 * root)) / scale;
}

}  // namespace clay
