// Exact numbers of builds without GMP as doubles: truncated, for numerators and denominators of any
// size.

#include "export/solid/exact_point.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace clay::solid {
namespace {

using Whole = boost::multiprecision::cpp_int;
using Exact = boost::multiprecision::cpp_rational;

Whole some_whole(std::mt19937_64& random, int bits) {
  Whole whole = 1;
  for (int i = 0; i < bits; ++i) whole = 2 * whole + static_cast<int>(random() & 1u);
  return whole;
}

TEST(ExactPoint, DoublesAreTruncated) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const int bits =
        static_cast<int>(random() % 3000);  // beyond 1023, doubles of them are infinite
    const Whole numerator = some_whole(random, bits + static_cast<int>(random() % 120));
    const Whole denominator = some_whole(random, bits);
    const int sign = (random() & 1u) != 0 ? 1 : -1;
    const CGAL::Quotient<Whole> quotient(sign * numerator, denominator);
    const double nearest = sign * cgal::double_of(quotient);
    const Exact exact(numerator, denominator);
    EXPECT_LE(Exact(nearest), exact);
    EXPECT_GT(Exact(std::nextafter(nearest, std::numeric_limits<double>::infinity())), exact);
  }
  EXPECT_EQ(cgal::double_of(CGAL::Quotient<Whole>(0, 3)), 0.0);
  EXPECT_EQ(cgal::double_of(CGAL::Quotient<Whole>(-3, 4)), -0.75);
}

}  // namespace
}  // namespace clay::solid
