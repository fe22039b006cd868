#pragma once
// Points of CGAL's exact kernel as doubles. Requires CGAL's headers: do not include this in headers
// that do not.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Quotient.h>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace clay::solid::cgal {

/// Rounds towards zero, as GMP does.
template <class Exact>
[[nodiscard]] double double_of(const Exact& x) {
  return CGAL::to_double(x);
}

/// Exact numbers of builds without GMP, such as the web page. CGAL would divide two doubles, which
/// may both be infinite. Requires a result in the range of normal doubles.
[[nodiscard]] inline double double_of(const CGAL::Quotient<boost::multiprecision::cpp_int>& x) {
  using Whole = boost::multiprecision::cpp_int;
  if (x.numerator() == 0) return 0.0;
  Whole numerator = abs(x.numerator()), denominator = abs(x.denominator());
  const bool negative = (x.numerator() < 0) != (x.denominator() < 0);
  // So that the quotient has 54 or 55 bits.
  const int shift = 54 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
  if (shift > 0)
    numerator <<= shift;
  else
    denominator <<= -shift;
  const auto quotient = static_cast<std::uint64_t>(Whole(numerator / denominator));
  const int excess = quotient >> 54 != 0 ? 2 : 1;
  const double size = std::ldexp(static_cast<double>(quotient >> excess), excess - shift);
  return negative ? -size : size;
}

/// The interval of a lazy number may be as wide as 1e-5 of it, so evaluates it exactly first.
[[nodiscard]] inline glm::dvec3 doubles_of(
    const CGAL::Exact_predicates_exact_constructions_kernel::Point_3& point) {
  const auto& p = point.exact();
  return {double_of(p.x()), double_of(p.y()), double_of(p.z())};
}

}  // namespace clay::solid::cgal
