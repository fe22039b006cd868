// Predicates and intervals of CGAL as the page compiles them, without rounding upwards, against
// exact rational numbers: points on a line or plane, moved by at most two units in the last place.
// Prints the number of cases, of exact zeros, and of wrong results; exit status 1 if one is wrong.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Interval_nt.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rational = boost::multiprecision::cpp_rational;
using Place = std::array<double, 3>;

constexpr int kCases = 20'000;
std::mt19937_64 random_bits(20261124);

double uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(random_bits() >> 11) * 0x1p-53;
}

double moved(double number) {
  for (int steps = static_cast<int>(random_bits() % 5) - 2; steps != 0; steps -= steps > 0 ? 1 : -1)
    number = std::nextafter(number, steps > 0 ? HUGE_VAL : -HUGE_VAL);
  return number;
}

Place random_place() { return {uniform(-100, 100), uniform(-100, 100), uniform(-100, 100)}; }

/// Near the line or plane through the others: a weighted sum of them.
template <std::size_t Count>
Place near(const std::array<Place, Count>& others, std::size_t coordinates) {
  std::array<double, Count> weights;
  double rest = 1.0;
  for (std::size_t i = 1; i < Count; ++i) rest -= weights[i] = 0.25 * std::round(uniform(-8, 8));
  weights[0] = rest;
  Place place{};
  for (std::size_t k = 0; k < coordinates; ++k) {
    for (std::size_t i = 0; i < Count; ++i) place[k] += weights[i] * others[i][k];
    place[k] = moved(place[k]);
  }
  return place;
}

int sign_of(const Rational& number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

Rational minor(const Place& a, const Place& b, const Place& o, std::size_t i, std::size_t j) {
  const auto from = [&](const Place& p, std::size_t k) { return Rational(p[k]) - Rational(o[k]); };
  return from(a, i) * from(b, j) - from(a, j) * from(b, i);
}

struct Count {
  const char* what;
  int zeros = 0, wrong = 0;
  void add(int found, int expected) {
    zeros += expected == 0 ? 1 : 0;
    wrong += found != expected ? 1 : 0;
  }
  bool print() const {
    std::printf("%-16s %d cases, %d exact zeros, %d wrong\n", what, kCases, zeros, wrong);
    return wrong == 0;
  }
};

void turn(Count& count) {
  const std::array others = {random_place(), random_place()};
  const Place c = near(others, 2);
  const auto point = [](const Place& p) { return Kernel::Point_2(p[0], p[1]); };
  count.add(CGAL::orientation(point(others[0]), point(others[1]), point(c)),
            sign_of(minor(others[1], c, others[0], 0, 1)));
}

void side(Count& count) {
  const std::array others = {random_place(), random_place(), random_place()};
  const Place d = near(others, 3);
  const auto point = [](const Place& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
  const Place &o = others[0], &a = others[1], &b = others[2];
  const auto height = [&](std::size_t k) { return Rational(d[k]) - Rational(o[k]); };
  const Rational volume = height(0) * minor(a, b, o, 1, 2) + height(1) * minor(a, b, o, 2, 0) +
                          height(2) * minor(a, b, o, 0, 1);
  count.add(CGAL::orientation(point(o), point(a), point(b), point(d)), sign_of(volume));
}

/// Products, near the smallest normal numbers in every other case: 0 if the exact one is inside.
void product(Count& count, bool tiny) {
  const double scale = tiny ? 0x1p-520 : 1.0;
  const double a = scale * uniform(-100, 100), b = scale * uniform(-100, 100);
  const auto interval = CGAL::Interval_nt<true>(a) * CGAL::Interval_nt<true>(b);
  const Rational exact = Rational(a) * Rational(b);
  const bool inside = Rational(interval.inf()) <= exact && exact <= Rational(interval.sup());
  count.wrong += inside ? 0 : 1;
}

}  // namespace

int main() {
  Count turns{"orientation_2"}, sides{"orientation_3"}, products{"interval product"};
  for (int i = 0; i < kCases; ++i) {
    turn(turns);
    side(sides);
    product(products, i % 2 == 1);
  }
  const bool right = turns.print();
  const bool all = sides.print() && right;
  return products.print() && all ? 0 : 1;
}
