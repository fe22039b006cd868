#include "app/bench/hands/pot_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace clay::bench {
namespace {

constexpr double kOpenBoreMm = 2.0, kBoreMm = 0.05;
constexpr double kCutOffMm = 5.0, kGauss = 0.4697;  // sqrt(ln 2 / pi)
constexpr double kSteep = 3.0, kLedgeMm = 1.0;

double square_of_roughness(std::span<const double> profile, double h, std::size_t first,
                           std::size_t end) {
  const auto reach = static_cast<std::ptrdiff_t>(kCutOffMm / h);
  double sum = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    double mean = 0.0, weight = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + k;
      if (j < 0 || j >= std::ssize(profile)) continue;
      const double x = static_cast<double>(k) * h / (kGauss * kCutOffMm);
      const double g = std::exp(-std::numbers::pi * x * x);
      mean += g * profile[static_cast<std::size_t>(j)];
      weight += g;
    }
    const double off = profile[i] - mean / weight;
    sum += off * off;
  }
  return end > first ? sum / static_cast<double>(end - first) : 0.0;
}

void find_ledges(std::span<const double> profile, double h, std::size_t first, PotMeasures& pot) {
  const auto steep = [&](std::size_t i) {
    return std::abs(profile[i + 1] - profile[i]) > kSteep * h;
  };
  for (std::size_t i = first; i + 1 < profile.size(); ++i) {
    if (!steep(i)) continue;
    const double start = profile[i], step = profile[i + 1] - start;
    while (i + 2 < profile.size() && steep(i + 1) && (profile[i + 2] - profile[i + 1]) * step > 0.0)
      ++i;
    const double size = std::abs(profile[i + 1] - start);
    if (size <= kLedgeMm) continue;
    ++pot.ledges;
    if (size > pot.ledge_mm) pot.ledge_up_mm = static_cast<double>(i) * h;
    pot.ledge_mm = std::max(pot.ledge_mm, size);
  }
}

}  // namespace

PotMeasures measure(const ClayStack& stack) {
  PotMeasures pot;
  const double h = stack.ring_height_mm();
  std::vector<double> outer, inner;
  bool in_bore = false;
  for (const Ring& ring : stack.rings()) {
    outer.push_back(ring.outer_mm());
    inner.push_back(ring.inner_mm());
    pot.width_mm = std::max(pot.width_mm, 2.0 * outer.back());
    const bool bore = inner.back() > kBoreMm;
    if (in_bore && !bore) ++pot.cavities;
    in_bore = bore;
  }
  pot.height_mm = stack.height_mm();
  const auto open = std::ranges::find_if(inner, [](double r) { return r > kOpenBoreMm; });
  const auto floor = static_cast<std::size_t>(open - inner.begin());
  const std::size_t size = outer.size();
  const std::size_t wall = std::min(size - 1, floor + static_cast<std::size_t>(10.0 / h));
  double sum = 0.0, squares = 0.0;
  pot.thinnest_mm = std::numeric_limits<double>::infinity();
  for (std::size_t i = wall; i < size; ++i) {
    const double w = outer[i] - inner[i];
    sum += w;
    squares += w * w;
    pot.thinnest_mm = std::min(pot.thinnest_mm, w);
  }
  const auto count = static_cast<double>(size - wall);
  pot.wall_mm = sum / count;
  pot.wall_cv = std::sqrt(std::max(0.0, squares / count - pot.wall_mm * pot.wall_mm)) / pot.wall_mm;
  const auto edge = std::min(size / 2, static_cast<std::size_t>(2.5 / h));
  pot.roughness_um =
      1e3 *
      std::sqrt(0.5 * (square_of_roughness(outer, h, edge, size - edge) +
                       square_of_roughness(inner, h, std::min(wall, size - edge), size - edge)));
  find_ledges(outer, h, 0, pot);
  find_ledges(inner, h, wall, pot);
  pot.neck_mm =
      2.0 * *std::min_element(outer.begin() + static_cast<std::ptrdiff_t>(size / 2), outer.end());
  return pot;
}

}  // namespace clay::bench
