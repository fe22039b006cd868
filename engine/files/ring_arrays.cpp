#include "engine/files/ring_arrays.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace clay::files {
namespace {

constexpr double kRadiusToleranceMm = 1e-5;

/// Radii for people, in millionths of a mm.
std::vector<double> radii_mm(const std::vector<Quanta>& squares) {
  std::vector<double> radii;
  radii.reserve(squares.size());
  for (const Quanta square : squares)
    radii.push_back(std::round(radius_from_quanta(square) * 1e6) / 1e6);
  return radii;
}

/// d[i] = radius[i] - 2 radius[i-1] + radius[i-2]; radii before the first count as 0.
std::vector<std::int64_t> second_differences(const std::vector<Quanta>& squares,
                                             const RadiusGrid& grid) {
  std::vector<std::int64_t> differences;
  differences.reserve(squares.size());
  std::int64_t radius = 0, slope = 0;
  for (const Quanta square : squares) {
    const std::int64_t next_slope = grid.steps(square) - radius;
    differences.push_back(next_slope - slope);
    slope = next_slope;
    radius += slope;
  }
  return differences;
}

/// The inverse; ends before the first radius outside `least_mm` to kMaxRadiusMm.
std::vector<Quanta> squares_of(const std::vector<std::int64_t>& differences, const RadiusGrid& grid,
                               double least_mm) {
  std::vector<Quanta> squares;
  squares.reserve(differences.size());
  std::int64_t radius = 0, slope = 0;
  for (const std::int64_t difference : differences) {
    slope += difference;
    radius += slope;
    if (grid.radius_mm(radius) < least_mm || grid.radius_mm(radius) > kMaxRadiusMm) break;
    squares.push_back(grid.square(radius));
  }
  return squares;
}

void expect_radii(ObjectReader& reader, std::string_view name, const std::vector<Quanta>& squares,
                  const std::optional<std::vector<double>>& radii_mm) {
  if (!radii_mm) return;
  reader.expect(radii_mm->size() == squares.size(), name,
                "one radius for each of " + std::to_string(squares.size()) + " rings");
  for (std::size_t i = 0; i < std::min(radii_mm->size(), squares.size()); ++i) {
    const double counted_mm = radius_from_quanta(squares[i]);
    if (std::abs((*radii_mm)[i] - counted_mm) > kRadiusToleranceMm)
      return reader.expect_element(false, name, i,
                                   "the radius that the count of ring " + std::to_string(i) +
                                       " gives, " + number_text(counted_mm) + " mm");
  }
}

}  // namespace

RingArrays ring_arrays(const ClayStack& stack, bool for_people) {
  RingArrays rings;
  for (const Ring& ring : stack.rings()) {
    rings.outer2.push_back(ring.outer2);
    rings.inner2.push_back(ring.inner2);
  }
  if (for_people) {
    rings.outer_mm = radii_mm(rings.outer2);
    rings.inner_mm = radii_mm(rings.inner2);
  }
  return rings;
}

RoundedRingArrays rounded_ring_arrays(const RingArrays& rings, const Rounding& rounding,
                                      const RadiusGrid& grid) {
  return {{rings.outer_mm, rings.inner_mm},
          rounding.to_mm,
          rounding.exact_volume,
          second_differences(rings.outer2, grid),
          second_differences(rings.inner2, grid)};
}

RingArrays exact_rings(const RoundedRingArrays& rounded, const RadiusGrid& grid) {
  return {{rounded.outer_mm, rounded.inner_mm},
          squares_of(rounded.outer_differences, grid, kMinRadiusMm),
          squares_of(rounded.inner_differences, grid, 0.0)};
}

void expect_rings(ObjectReader& reader, const RingArrays& rings, const RingMembers& members) {
  const std::size_t count = rings.outer2.size();
  reader.expect(count >= 1 && count <= kMaxRings, members.outer,
                "1 to " + std::to_string(kMaxRings) + " rings");
  reader.expect(rings.inner2.size() == count, members.inner,
                "one count for each of " + std::to_string(count) + " rings");
  for (std::size_t i = 0; i < std::min(count, rings.inner2.size()); ++i)
    reader.expect_element(rings.inner2[i] < rings.outer2[i], members.inner, i, members.below_outer);
  expect_radii(reader, "outer_mm", rings.outer2, rings.outer_mm);
  expect_radii(reader, "inner_mm", rings.inner2, rings.inner_mm);
}

void expect_rounded_rings(ObjectReader& reader, const RoundedRingArrays& rounded) {
  const auto grid = RadiusGrid::of(rounded.rounded_to_mm);
  if (!grid) return reader.expect(false, "rounded_to_mm", "a whole number of nanometres");
  const RingArrays rings = exact_rings(rounded, *grid);
  reader.expect_element(rings.outer2.size() == rounded.outer_differences.size(),
                        "outer_differences", rings.outer2.size(),
                        "a difference that gives an outer radius from 0.001 to 5000 mm");
  reader.expect_element(rings.inner2.size() == rounded.inner_differences.size(),
                        "inner_differences", rings.inner2.size(),
                        "a difference that gives an inner radius from 0 to 5000 mm");
  expect_rings(reader, rings,
               {"outer_differences", "inner_differences",
                "a difference that gives an inner radius below the outer one"});
}

}  // namespace clay::files
