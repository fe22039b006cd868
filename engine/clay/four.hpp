#pragma once
// Four rows at once, for the loops of the clay rules: of a loop with several conditions GCC does
// all branches, or does it row by row. Without AVX2 it is slow, for GCC then compares row by row.
// No multiplication is fused with an addition, and every operation is one of IEEE 754: the same
// bits as row by row.

#include "claystack/engine/clay.hpp"
#include "engine/clay/lanes.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

// Vectors go to functions that are always inline: their ABI does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace clay {

inline constexpr std::size_t kFour = 4;
using Four = double __attribute__((vector_size(32)));
using FourQuanta = std::int64_t __attribute__((vector_size(32)));
using TwoQuanta = std::int64_t __attribute__((vector_size(16)));
using FourBits = std::uint64_t __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));
using EightFloats = float __attribute__((vector_size(32)));  // a root takes as long as of four

/// Rows that loops of fours go over.
[[nodiscard]] constexpr std::size_t in_fours(std::size_t rows) noexcept {
  return (rows + kFour - 1) / kFour * kFour;
}

template <class Vector, class Value>
CLAYSTACK_INLINE inline Vector load(const Value* from) noexcept {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
CLAYSTACK_INLINE inline Four load_four(const double* from) noexcept { return load<Four>(from); }
template <class Vector, class Value>
CLAYSTACK_INLINE inline void store(Value* to, Vector v) noexcept {
  std::memcpy(static_cast<void*>(to), &v, sizeof v);
}

CLAYSTACK_INLINE inline Four all_of(double x) noexcept { return Four{x, x, x, x}; }
CLAYSTACK_INLINE inline FourQuanta all_of(Quanta q) noexcept { return FourQuanta{q, q, q, q}; }
CLAYSTACK_INLINE inline Four lesser(Four a, Four b) noexcept { return a < b ? a : b; }
CLAYSTACK_INLINE inline Four greater(Four a, Four b) noexcept { return a > b ? a : b; }
CLAYSTACK_INLINE inline Four lesser(Four a, double b) noexcept { return lesser(a, all_of(b)); }
CLAYSTACK_INLINE inline Four greater(Four a, double b) noexcept { return greater(a, all_of(b)); }

CLAYSTACK_INLINE inline double least_of(Four x) noexcept {
  return lesser(lesser(x[0], x[1]), lesser(x[2], x[3]));
}

CLAYSTACK_INLINE inline Four root(Four x) noexcept {
  Four r{};
  for (int k = 0; k < 4; ++k) r[k] = std::sqrt(x[k]);
  return r;
}
CLAYSTACK_INLINE inline FourFloats four_floats(Four x) noexcept {
  return __builtin_convertvector(x, FourFloats);
}
/// Not __builtin_convertvector, which GCC does two by two.
CLAYSTACK_INLINE inline Four four_doubles(FourFloats x) noexcept {
  Four r{};
  for (int k = 0; k < 4; ++k) r[k] = static_cast<double>(x[k]);
  return r;
}
CLAYSTACK_INLINE inline EightFloats eight_floats(Four low, Four high) noexcept {
  return __builtin_shufflevector(four_floats(low), four_floats(high), 0, 1, 2, 3, 4, 5, 6, 7);
}
CLAYSTACK_INLINE inline FourFloats low_half(EightFloats x) noexcept {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3);
}
CLAYSTACK_INLINE inline FourFloats high_half(EightFloats x) noexcept {
  return __builtin_shufflevector(x, x, 4, 5, 6, 7);
}
CLAYSTACK_INLINE inline EightFloats root(EightFloats x) noexcept {
  EightFloats r{};
  for (int k = 0; k < 8; ++k) r[k] = std::sqrt(x[k]);
  return r;
}
/// As `rough_root`.
CLAYSTACK_INLINE inline Four rough_root(Four x) noexcept {
  FourFloats r = four_floats(x);
  for (int k = 0; k < 4; ++k) r[k] = std::sqrt(r[k]);
  return four_doubles(r);
}

/// As `lane_double`; the nearest whole number, as a double and as quanta; and without the fraction.
CLAYSTACK_INLINE inline Four four_doubles(FourQuanta q) noexcept {
  constexpr std::uint64_t kExponent = std::bit_cast<std::uint64_t>(0x1p52);
  const auto bits = reinterpret_cast<FourBits>(q);
  const Four low = reinterpret_cast<Four>((bits & 0xffffffffu) | kExponent) - 0x1p52;
  const Four high = reinterpret_cast<Four>((bits >> 32) | kExponent) - 0x1p52;
  return high * 0x1p32 + low;
}
CLAYSTACK_INLINE inline Four nearest(Four x) noexcept { return (x + 0x1.8p52) - 0x1.8p52; }
CLAYSTACK_INLINE inline FourQuanta four_quanta(Four x) noexcept {
  return reinterpret_cast<FourQuanta>(x + 0x1.8p52) - std::bit_cast<Quanta>(0x1.8p52);
}
CLAYSTACK_INLINE inline FourQuanta four_quanta_below(Four x) noexcept {
  const Four size = greater(x, -x), near = nearest(size);
  const Four whole = near > size ? near - 1.0 : near;
  return four_quanta(x < 0.0 ? -whole : whole);
}

/// first, first + 1, ...
CLAYSTACK_INLINE inline FourQuanta row_numbers(std::size_t first) noexcept {
  return FourQuanta{0, 1, 2, 3} + static_cast<Quanta>(first);
}

/// Whether a condition holds in some row.
CLAYSTACK_INLINE inline bool any(FourQuanta condition) noexcept {
  return (condition[0] | condition[1] | condition[2] | condition[3]) != 0;
}

struct FourRings {
  FourQuanta outer2, inner2;
};
/// Ring by ring: a load of two that have just been written apart would wait until both writes are
/// done.
CLAYSTACK_INLINE inline FourRings load_four(const Ring* rings) noexcept {
  const auto a = load<TwoQuanta>(rings), b = load<TwoQuanta>(rings + 1);
  const auto c = load<TwoQuanta>(rings + 2), d = load<TwoQuanta>(rings + 3);
  const FourQuanta even = __builtin_shufflevector(a, c, 0, 1, 2, 3);
  const FourQuanta odd = __builtin_shufflevector(b, d, 0, 1, 2, 3);
  return {__builtin_shufflevector(even, odd, 0, 4, 2, 6),
          __builtin_shufflevector(even, odd, 1, 5, 3, 7)};
}
/// The first `count` of four rings; the others repeat the last of them.
CLAYSTACK_INLINE inline FourRings load_four(const Ring* rings, std::size_t count) noexcept {
  if (count >= kFour) return load_four(rings);
  Ring some[kFour];
  for (std::size_t k = 0; k < kFour; ++k) some[k] = rings[k < count ? k : count - 1];
  return load_four(some);
}
CLAYSTACK_INLINE inline void store(Ring* rings, const FourRings& four) noexcept {
  store(rings, FourQuanta(__builtin_shufflevector(four.outer2, four.inner2, 0, 4, 1, 5)));
  store(rings + 2, FourQuanta(__builtin_shufflevector(four.outer2, four.inner2, 2, 6, 3, 7)));
}

}  // namespace clay
