#pragma once
// The rings of a pot in the form of its file: exact, or rounded.

#include "claystack/engine/clay.hpp"
#include "core/json/object_reader.hpp"
#include "engine/clay/radius_grid.hpp"
#include "engine/files/text_codes.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace clay::files {

struct RadiiForPeople {
  std::optional<std::vector<double>> outer_mm, inner_mm;  ///< JSON only
};

struct RingArrays : RadiiForPeople {
  std::vector<Quanta> outer2, inner2;
};

/// Wall radii change slowly from ring to ring: most second differences, counted in steps of the
/// precision, take one byte of CBOR.
struct RoundedRingArrays : RadiiForPeople {
  double rounded_to_mm = 0.0;
  WideQuanta exact_volume = 0;
  std::vector<std::int64_t> outer_differences, inner_differences;
};

/// With radii for people, if requested.
RingArrays ring_arrays(const ClayStack& stack, bool for_people);
RoundedRingArrays rounded_ring_arrays(const RingArrays& rings, const Rounding& rounding,
                                      const RadiusGrid& grid);
/// The inverse; an array ends before the first radius out of range.
RingArrays exact_rings(const RoundedRingArrays& rounded, const RadiusGrid& grid);

/// The names of the radius members, and the error for an inner radius that is too large.
struct RingMembers {
  std::string_view outer, inner, below_outer;
};

/// Checks the rules for rings, for every file encoding.
void expect_rings(ObjectReader& reader, const RingArrays& rings, const RingMembers& members);
void expect_rounded_rings(ObjectReader& reader, const RoundedRingArrays& rounded);

void describe_radii_for_people(auto& io, auto& rings) {
  io.numbers("outer_mm", rings.outer_mm, from(0).to(kMaxRadiusMm));
  io.numbers("inner_mm", rings.inner_mm, from(0).to(kMaxRadiusMm));
}

void describe(auto& io, Is<RingArrays> auto& rings) {
  io.require({"outer2", "inner2"});
  io.integers("outer2", rings.outer2, kSmallestOuter2, kLargestOuter2);
  io.integers("inner2", rings.inner2, 0, kLargestOuter2);
  describe_radii_for_people(io, rings);
  io.check([&](ObjectReader& reader) {
    expect_rings(reader, rings, {"outer2", "inner2", "less than the outer count of the ring"});
  });
}

void describe(auto& io, Is<RoundedRingArrays> auto& rings) {
  constexpr std::int64_t kLargest = RadiusGrid::kLargestDifference;
  io.require({"rounded_to_mm", "exact_volume", "outer_differences", "inner_differences"});
  io.number("rounded_to_mm", rings.rounded_to_mm,
            from(RadiusGrid::kFinestMm).to(RadiusGrid::kCoarsestMm));
  io.template coded<DecimalCode>("exact_volume", rings.exact_volume);
  io.integers("outer_differences", rings.outer_differences, -kLargest, kLargest);
  io.integers("inner_differences", rings.inner_differences, -kLargest, kLargest);
  describe_radii_for_people(io, rings);
  io.check([&](ObjectReader& reader) { expect_rounded_rings(reader, rings); });
}

}  // namespace clay::files
