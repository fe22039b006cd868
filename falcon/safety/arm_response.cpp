#include "falcon/safety/arm_response.hpp"

#include <array>
#include <glm/geometric.hpp>

namespace clay::falcon::inline safety {
namespace {

// With g t <= 1/4 and k t^2 <= 1/16 the omitted terms are below 2^-53 of the first.
constexpr int kTerms = 16;
constexpr double kShort = 0.25;
constexpr int kMostDoublings = 200;

/// Taylor terms of the velocity over a short time t, as a polynomial of s = time / t.
using Series = std::array<double, kTerms>;

Series series(double decay, double spring, double t, double first, double second) noexcept {
  Series terms{first, second * t};
  for (std::size_t n = 2; n < kTerms; ++n) {
    const auto order = static_cast<double>(n);
    terms[n] = -(decay * t * terms[n - 1] + spring * t * t * terms[n - 2] / (order - 1.0)) / order;
  }
  return terms;
}

double sum(const Series& terms) noexcept {
  double total = 0.0;
  for (std::size_t n = kTerms; n-- > 0;) total += terms[n];
  return total;
}

double integral(const Series& terms) noexcept {
  double total = 0.0;
  for (std::size_t n = kTerms; n-- > 0;) total += terms[n] / static_cast<double>(n + 1);
  return total;
}

double derivative(const Series& terms) noexcept {
  double total = 0.0;
  for (std::size_t n = kTerms; n-- > 1;) total += terms[n] * static_cast<double>(n);
  return total;
}

double integral_of_product(const Series& one, const Series& other) noexcept {
  double total = 0.0;
  for (std::size_t i = kTerms; i-- > 0;)
    for (std::size_t j = kTerms; j-- > 0;)
      total += one[i] * other[j] / static_cast<double>(i + j + 1);
  return total;
}

ArmResponse short_response(double decay, double spring, double t) noexcept {
  const Series by_velocity = series(decay, spring, t, 1.0, 0.0);
  const Series by_acceleration = series(decay, spring, t, 0.0, 1.0);
  ArmResponse r;
  r.path = t * glm::dvec2(integral(by_velocity), integral(by_acceleration));
  r.velocity = {sum(by_velocity), sum(by_acceleration)};
  r.acceleration = glm::dvec2(derivative(by_velocity), derivative(by_acceleration)) / t;
  r.square = t * glm::dvec3(integral_of_product(by_velocity, by_velocity),
                            2.0 * integral_of_product(by_velocity, by_acceleration),
                            integral_of_product(by_acceleration, by_acceleration));
  return r;
}

/// The response over twice the time.
ArmResponse twice(const ArmResponse& r) noexcept {
  const auto after = [&r](const glm::dvec2& factors) {
    return factors.x * r.velocity + factors.y * r.acceleration;
  };
  const glm::dvec2 v = r.velocity, a = r.acceleration;
  const glm::dvec3 ww(v.x * v.x, 2.0 * v.x * v.y, v.y * v.y);
  const glm::dvec3 wa(v.x * a.x, v.x * a.y + v.y * a.x, v.y * a.y);
  const glm::dvec3 aa(a.x * a.x, 2.0 * a.x * a.y, a.y * a.y);
  return {r.path + after(r.path), after(r.velocity), after(r.acceleration),
          r.square + r.square.x * ww + r.square.y * wa + r.square.z * aa};
}

}  // namespace

ArmResponse arm_response(double decay_per_s, double spring_per_s2, double time_s) noexcept {
  if (!(time_s > 0.0)) return {};
  double t = time_s;
  int doublings = 0;
  while (doublings < kMostDoublings &&
         (decay_per_s * t > kShort || spring_per_s2 * t * t > kShort * kShort)) {
    t *= 0.5;
    ++doublings;
  }
  ArmResponse response = short_response(decay_per_s, spring_per_s2, t);
  for (; doublings > 0; --doublings) response = twice(response);
  return response;
}

}  // namespace clay::falcon::inline safety
