#include "engine/collapse/fallen_body.hpp"

#include "core/portable_trig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace clay {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kBands = 96;  // limit of groups of rings, each sampled as one
// Cells per reach, up a wall and along a tread. More along a tread: a rim may rest on its edge.
constexpr double kWallCells = 32.0, kTreadCells = 128.0;

double top_of(const ClayStack& stack, std::size_t ring) noexcept {
  return stack.ring_height_mm() * static_cast<double>(ring + 1);
}

int cells_in(double length_mm, double cell_mm) noexcept {
  return std::max(1, static_cast<int>(std::ceil(length_mm / cell_mm)));
}

double cross(glm::dvec2 a, glm::dvec2 b) noexcept { return a.x * b.y - a.y * b.x; }

}  // namespace

FallenBody::FallenBody(const ClayStack& stack, std::size_t failed_ring) {
  const std::size_t first = failed_ring + 1;
  if (first >= stack.size() && stack.crown() <= 0) return;
  measure(stack, first);
  add_outline(stack, first);
  add_surface(bands(stack, first), stack.rings()[failed_ring]);
}

void FallenBody::measure(const ClayStack& stack, std::size_t first) {
  double volume = 0.0, moment = 0.0, second = 0.0;
  // Heights are relative to the first ring's foot, so that thin parts high up lose no digits.
  const double foot = top_of(stack, first) - stack.ring_height_mm();
  const auto add = [&](double quanta, const Ring& ring, double bottom, double height) {
    const double middle = bottom - foot + 0.5 * height;
    const double across = 0.25 * (mm2_from_quanta(ring.outer2) + mm2_from_quanta(ring.inner2));
    volume += quanta;
    moment += quanta * middle;
    second += quanta * (across + middle * middle + height * height / 12.0);
  };
  const double h = stack.ring_height_mm();
  for (std::size_t i = first; i < stack.size(); ++i) {
    const Ring& ring = stack.rings()[i];
    add(static_cast<double>(ring.volume()), ring, top_of(stack, i) - h, h);
  }
  add(static_cast<double>(stack.crown()), stack.rings().back(),
      h * static_cast<double>(stack.size()), stack.crown_height_mm());
  const double centre = moment / volume;
  volume_mm3_ = volume * stack.mm3_per_quantum();
  centre_height_mm_ = foot + centre;
  gyration_mm_ = std::sqrt(std::max(second / volume - centre * centre, 0.0));
}

void FallenBody::add_outline(const ClayStack& stack, std::size_t first) {
  const auto add = [&](double radius, double height) {
    const glm::dvec2 p{radius, height - centre_height_mm_};
    reach_mm_ = std::max(reach_mm_, glm::length(p));
    while (hull_.size() >= 2 &&
           cross(hull_.back() - hull_[hull_.size() - 2], p - hull_.back()) <= 0.0)
      hull_.pop_back();
    hull_.push_back(p);
  };
  const double h = stack.ring_height_mm();
  for (std::size_t i = std::min(first, stack.size() - 1); i < stack.size(); ++i) {
    const double radius = stack.rings()[i].outer_mm();
    const bool last = i + 1 == stack.size();
    add(radius, i < first ? top_of(stack, i) : top_of(stack, i) - h);
    add(radius, last ? stack.height_mm() : top_of(stack, i));
  }
}

/// The first ring alone, because the part rests on it; then bands of equally many rings, each with
/// the volume of its rings; then the crown.
std::vector<FallenBody::Band> FallenBody::bands(const ClayStack& stack, std::size_t first) const {
  std::vector<Band> result;
  const double h = stack.ring_height_mm();
  const std::size_t count = stack.size() - first;
  const std::size_t together = std::max<std::size_t>(1, (count + kBands - 1) / kBands);
  for (std::size_t i = first; i < stack.size();) {
    const std::size_t end = std::min(stack.size(), i == first ? i + 1 : i + together);
    double outer2 = 0.0, inner2 = 0.0;
    for (std::size_t k = i; k < end; ++k) {
      outer2 += mm2_from_quanta(stack.rings()[k].outer2);
      inner2 += mm2_from_quanta(stack.rings()[k].inner2);
    }
    const double rings = static_cast<double>(end - i);
    result.push_back({std::sqrt(outer2 / rings), std::sqrt(inner2 / rings),
                      h * static_cast<double>(i), h * static_cast<double>(end)});
    i = end;
  }
  if (stack.crown() > 0)
    result.push_back({stack.rings().back().outer_mm(), stack.rings().back().inner_mm(),
                      h * static_cast<double>(stack.size()), stack.height_mm()});
  return result;
}

void FallenBody::add_surface(const std::vector<Band>& bands, const Ring& failed) {
  // Cells of the foot end at the failed ring's radii, so the area resting on that ring is exact.
  const Band& foot = bands.front();
  std::array edges{foot.inner_mm, std::clamp(failed.inner_mm(), foot.inner_mm, foot.outer_mm),
                   std::clamp(failed.outer_mm(), foot.inner_mm, foot.outer_mm), foot.outer_mm};
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    add_tread(edges[k], edges[k + 1], foot.bottom_mm, -1.0);
  for (std::size_t k = 0; k < bands.size(); ++k) {
    add_wall(bands[k].outer_mm, bands[k], 1.0);
    if (bands[k].inner_mm > 0.0) add_wall(bands[k].inner_mm, bands[k], -1.0);
    if (k + 1 < bands.size()) add_difference(bands[k], bands[k + 1]);
  }
  add_tread(bands.back().inner_mm, bands.back().outer_mm, bands.back().top_mm, 1.0);
}

/// Adds treads where one band extends beyond the other.
void FallenBody::add_difference(const Band& below, const Band& above) {
  const auto without = [&](const Band& a, const Band& b, double upward) {
    add_tread(a.inner_mm, std::min(a.outer_mm, b.inner_mm), below.top_mm, upward);
    add_tread(std::max(a.inner_mm, b.outer_mm), a.outer_mm, below.top_mm, upward);
  };
  without(below, above, 1.0);
  without(above, below, -1.0);
}

void FallenBody::add_wall(double radius_mm, const Band& band, double outward) {
  const double height = band.top_mm - band.bottom_mm;
  const int cells = cells_in(height, reach_mm_ / kWallCells);
  const double cell = height / cells;
  const double area = 2.0 * kPi * radius_mm * cell / kDirections;
  for (int k = 0; k < cells; ++k)
    surface_.push_back(
        {radius_mm, band.bottom_mm + (k + 0.5) * cell - centre_height_mm_, outward, 0.0, area});
}

void FallenBody::add_tread(double from_mm, double to_mm, double height_mm, double upward) {
  if (!(to_mm > from_mm)) return;
  const int cells = cells_in(to_mm - from_mm, reach_mm_ / kTreadCells);
  const double cell = (to_mm - from_mm) / cells;
  for (int k = 0; k < cells; ++k) {
    const double radius = from_mm + (k + 0.5) * cell;
    surface_.push_back({radius, height_mm - centre_height_mm_, 0.0, upward,
                        2.0 * kPi * radius * cell / kDirections});
  }
}

const std::array<double, kDirections>& FallenBody::directions() noexcept {
  static const auto cosines = [] {
    std::array<double, kDirections> result{};
    for (std::size_t k = 0; k < kDirections; ++k)
      result[k] = cos_sin(kPi * (static_cast<double>(k) + 0.5) / kDirections).cosine;
    return result;
  }();
  return cosines;
}

glm::dvec2 FallenBody::lowest(double angle_rad) const noexcept {
  const auto [cosine, sine] = cos_sin(angle_rad);
  const double c = cosine, s = sine;  // Clang 14: a lambda cannot capture a structured binding
  // The left half is the right half rotated the other way.
  const auto lowest_of_half = [&](double side) {
    const auto falls = [&](const glm::dvec2& edge) { return side * s * edge.x + c * edge.y < 0.0; };
    std::size_t low = 0, high = hull_.size() - 1;
    if (side * s >= 0.0) {  // convex upward: one end is lowest
      if (falls(hull_.back() - hull_.front())) low = high;
    } else {
      while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (falls(hull_[middle + 1] - hull_[middle]))
          low = middle + 1;
        else
          high = middle;
      }
    }
    const double x = side * hull_[low].x, y = hull_[low].y;
    return glm::dvec2{c * x - s * y, s * x + c * y};
  };
  const glm::dvec2 right = lowest_of_half(1.0), left = lowest_of_half(-1.0);
  return right.y < left.y ? right : left;
}

}  // namespace clay
