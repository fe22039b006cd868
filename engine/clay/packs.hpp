#pragma once
// Processes 2 or 4 rows per instruction. GCC does not vectorise loops with several conditions, so
// they are written with vector types. Results equal those of scalar code to the bit.

#include "claystack/engine/clay.hpp"
#include "engine/clay/lanes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

// Vectors go to functions that are always inline: their ABI does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace clay {

/// Vectors for n rows. TwiceFloats: a root or a quotient of 2 n takes as long as of n.
template <std::size_t n>
struct Pack;
template <>
struct Pack<2> {
  using Doubles = double __attribute__((vector_size(16)));
  using Quantas = std::int64_t __attribute__((vector_size(16)));
  using Bits = std::uint64_t __attribute__((vector_size(16)));
  using Floats = float __attribute__((vector_size(8)));
  using TwiceFloats = float __attribute__((vector_size(16)));
};
template <>
struct Pack<4> {
  using Doubles = double __attribute__((vector_size(32)));
  using Quantas = std::int64_t __attribute__((vector_size(32)));
  using Bits = std::uint64_t __attribute__((vector_size(32)));
  using Floats = float __attribute__((vector_size(16)));
  using TwiceFloats = float __attribute__((vector_size(32)));
};
template <std::size_t n>
using Doubles = typename Pack<n>::Doubles;
template <std::size_t n>
using Quantas = typename Pack<n>::Quantas;
template <std::size_t n>
using Bits = typename Pack<n>::Bits;
template <std::size_t n>
using Floats = typename Pack<n>::Floats;
template <std::size_t n>
using TwiceFloats = typename Pack<n>::TwiceFloats;

/// Rows of a vector of doubles or quanta.
template <class Vector>
inline constexpr std::size_t kRowsOf = sizeof(Vector) / sizeof(double);

inline constexpr std::size_t kWidestPack = 4;
inline constexpr std::size_t kWidestFloats = 2 * kWidestPack;
/// Arrays that packs go over begin on this many bytes: a pack that lies in two lines of the cache
/// takes twice as long.
inline constexpr std::size_t kPackBytes = 64;

/// Rows that loops of packs go over: whole packs of any width.
[[nodiscard]] constexpr std::size_t in_packs_of(std::size_t rows) noexcept {
  return (rows + kWidestFloats - 1) / kWidestFloats * kWidestFloats;
}

/// Calls loop(n) with the number of rows of a pack, a constant of the type. The loop and all that
/// it calls are inline.
template <class Loop>
void in_packs(const Loop& loop) noexcept {
#if defined(__x86_64__)
  if (Lanes::four())
    return in_four_lanes([&]() CLAYSTACK_INLINE {
      const Loop own = loop;
      own(std::integral_constant<std::size_t, 4>{});
    });
#endif
  loop(std::integral_constant<std::size_t, 2>{});
}

template <class Vector, class Value>
CLAYSTACK_INLINE inline Vector load(const Value* from) noexcept {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> load_doubles(const double* from) noexcept {
  return load<Doubles<n>>(from);
}
/// The first `count` of n numbers; the others are 0.
template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> load_doubles(const double* from, std::size_t count) noexcept {
  if (count >= n) return load_doubles<n>(from);
  Doubles<n> some{};
  for (std::size_t k = 0; k < count; ++k) some[k] = from[k];
  return some;
}
template <class Vector, class Value>
CLAYSTACK_INLINE inline void store(Value* to, Vector v) noexcept {
  std::memcpy(static_cast<void*>(to), &v, sizeof v);
}

template <class Vector, class Value>
CLAYSTACK_INLINE inline Vector all_of(Value x) noexcept {
  if constexpr (kRowsOf<Vector> == 4)
    return Vector{x, x, x, x};
  else
    return Vector{x, x};
}
template <class Vector>
CLAYSTACK_INLINE inline Vector lesser(Vector a, Vector b) noexcept {
  return a < b ? a : b;
}
template <class Vector>
CLAYSTACK_INLINE inline Vector greater(Vector a, Vector b) noexcept {
  return a > b ? a : b;
}
template <class Vector>
CLAYSTACK_INLINE inline Vector lesser(Vector a, double b) noexcept {
  return lesser(a, all_of<Vector>(b));
}
template <class Vector>
CLAYSTACK_INLINE inline Vector greater(Vector a, double b) noexcept {
  return greater(a, all_of<Vector>(b));
}

/// Of one row.
template <class Vector>
using Number = std::remove_reference_t<decltype(std::declval<Vector&>()[0])>;

/// Combines all rows, by halves: row by row, each would wait for the one before. `fold` is called
/// with vectors and with numbers.
template <class Vector, class Fold>
CLAYSTACK_INLINE inline Number<Vector> folded(Vector x, Fold fold) noexcept {
  constexpr std::size_t n = sizeof x / sizeof x[0];
  if constexpr (n == 8)
    return folded(
        fold(__builtin_shufflevector(x, x, 0, 1, 2, 3), __builtin_shufflevector(x, x, 4, 5, 6, 7)),
        fold);
  else if constexpr (n == 4)
    return folded(fold(__builtin_shufflevector(x, x, 0, 1), __builtin_shufflevector(x, x, 2, 3)),
                  fold);
  else
    return fold(x[0], x[1]);
}
template <class Vector>
CLAYSTACK_INLINE inline Number<Vector> least_of(Vector x) noexcept {
  return folded(x, [](auto a, auto b) CLAYSTACK_INLINE { return a < b ? a : b; });
}
template <class Vector>
CLAYSTACK_INLINE inline Number<Vector> most_of(Vector x) noexcept {
  return folded(x, [](auto a, auto b) CLAYSTACK_INLINE { return a > b ? a : b; });
}
/// Of quanta, or of floats of which the order does not matter.
template <class Vector>
CLAYSTACK_INLINE inline Number<Vector> sum_of(Vector x) noexcept {
  return folded(x, [](auto a, auto b) CLAYSTACK_INLINE { return a + b; });
}
/// Whether a condition holds in some row.
template <class Vector>
CLAYSTACK_INLINE inline bool any(Vector condition) noexcept {
  return folded(condition, [](auto a, auto b) CLAYSTACK_INLINE { return a | b; }) != 0;
}

/// Of doubles or floats.
template <class Vector>
CLAYSTACK_INLINE inline Vector root(Vector x) noexcept {
  Vector r{};
  for (std::size_t k = 0; k < sizeof x / sizeof x[0]; ++k) r[k] = std::sqrt(x[k]);
  return r;
}
template <class Vector>
CLAYSTACK_INLINE inline Floats<kRowsOf<Vector>> floats(Vector x) noexcept {
  return __builtin_convertvector(x, Floats<kRowsOf<Vector>>);
}
/// Not __builtin_convertvector, which GCC does two by two.
template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> doubles(Floats<n> x) noexcept {
  Doubles<n> r{};
  for (std::size_t k = 0; k < n; ++k) r[k] = static_cast<double>(x[k]);
  return r;
}
template <std::size_t n>
CLAYSTACK_INLINE inline TwiceFloats<n> joined(Floats<n> low, Floats<n> high) noexcept {
  if constexpr (n == 4)
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  else
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
template <class Vector>
CLAYSTACK_INLINE inline TwiceFloats<kRowsOf<Vector>> floats(Vector low, Vector high) noexcept {
  return joined<kRowsOf<Vector>>(floats(low), floats(high));
}
template <std::size_t n>
CLAYSTACK_INLINE inline Floats<n> low_half(TwiceFloats<n> x) noexcept {
  if constexpr (n == 4)
    return __builtin_shufflevector(x, x, 0, 1, 2, 3);
  else
    return __builtin_shufflevector(x, x, 0, 1);
}
template <std::size_t n>
CLAYSTACK_INLINE inline Floats<n> high_half(TwiceFloats<n> x) noexcept {
  if constexpr (n == 4)
    return __builtin_shufflevector(x, x, 4, 5, 6, 7);
  else
    return __builtin_shufflevector(x, x, 2, 3);
}
template <std::size_t n>
CLAYSTACK_INLINE inline TwiceFloats<n> load_floats(const float* from) noexcept {
  return load<TwiceFloats<n>>(from);
}
/// The lower and the upper half of 2 n floats, as doubles.
template <std::size_t n>
CLAYSTACK_INLINE inline std::array<Doubles<n>, 2> halves(TwiceFloats<n> x) noexcept {
  return {doubles<n>(low_half<n>(x)), doubles<n>(high_half<n>(x))};
}
/// Roots to single precision: for a length that decides the motion of clay, not its volume.
template <std::size_t n>
CLAYSTACK_INLINE inline Doubles<n> rough_roots(Doubles<n> x) noexcept {
  return doubles<n>(root(floats(x)));
}

/// Quanta >= 0 as doubles, rounded to nearest like a conversion; unlike one it is done in lanes.
template <class Vector>
CLAYSTACK_INLINE inline Doubles<kRowsOf<Vector>> doubles_of(Vector q) noexcept {
  constexpr std::size_t n = kRowsOf<Vector>;
  const auto bits = reinterpret_cast<Bits<n>>(q);
  const auto low = reinterpret_cast<Doubles<n>>((bits & 0xffffffffu) | kLowExponent);
  const auto high = reinterpret_cast<Doubles<n>>((bits >> 32) | kHighExponent);
  return (high - kBothExponents) + low;
}
/// The same of quanta from 0 to below 2^52.
inline constexpr Quanta kSmallQuanta = Quanta{1} << 52;
template <class Vector>
CLAYSTACK_INLINE inline Doubles<kRowsOf<Vector>> small_doubles(Vector q) noexcept {
  constexpr std::size_t n = kRowsOf<Vector>;
  return reinterpret_cast<Doubles<n>>(reinterpret_cast<Bits<n>>(q) | kLowExponent) - 0x1p52;
}
/// The nearest whole number, as a double and as quanta; and without the fraction.
template <class Vector>
CLAYSTACK_INLINE inline Vector nearest(Vector x) noexcept {
  return (x + 0x1.8p52) - 0x1.8p52;
}
template <class Vector>
CLAYSTACK_INLINE inline Quantas<kRowsOf<Vector>> quanta_of(Vector x) noexcept {
  return reinterpret_cast<Quantas<kRowsOf<Vector>>>(x + 0x1.8p52) - std::bit_cast<Quanta>(0x1.8p52);
}
template <class Vector>
CLAYSTACK_INLINE inline Quantas<kRowsOf<Vector>> quanta_below(Vector x) noexcept {
  const Vector size = greater(x, -x), near = nearest(size);
  const Vector whole = near > size ? near - 1.0 : near;
  return quanta_of(x < 0.0 ? -whole : whole);
}

/// Room for rings on the stack. An array of Ring would be set to 0 first, which takes longer than
/// its use.
template <std::size_t most>
class RawRings {
 public:
  [[nodiscard]] Ring* data() noexcept { return reinterpret_cast<Ring*>(bytes_); }
  [[nodiscard]] const Ring* data() const noexcept { return reinterpret_cast<const Ring*>(bytes_); }

 private:
  alignas(Ring) std::byte bytes_[most * sizeof(Ring)];
};

template <std::size_t n>
struct RingPack {
  Quantas<n> outer2, inner2;
};
/// Ring by ring: a load of two rings that have just been written separately would wait until both
/// writes are done.
template <std::size_t n>
CLAYSTACK_INLINE inline RingPack<n> load_rings(const Ring* rings) noexcept {
  const auto a = load<Quantas<2>>(rings), b = load<Quantas<2>>(rings + 1);
  if constexpr (n == 2) {
    return {__builtin_shufflevector(a, b, 0, 2), __builtin_shufflevector(a, b, 1, 3)};
  } else {
    const auto c = load<Quantas<2>>(rings + 2), d = load<Quantas<2>>(rings + 3);
    const Quantas<4> even = __builtin_shufflevector(a, c, 0, 1, 2, 3);
    const Quantas<4> odd = __builtin_shufflevector(b, d, 0, 1, 2, 3);
    return {__builtin_shufflevector(even, odd, 0, 4, 2, 6),
            __builtin_shufflevector(even, odd, 1, 5, 3, 7)};
  }
}
/// The first `count` of n rings; the others repeat the last of them.
template <std::size_t n>
CLAYSTACK_INLINE inline RingPack<n> load_rings(const Ring* rings, std::size_t count) noexcept {
  if (count >= n) return load_rings<n>(rings);
  Ring some[n];
  for (std::size_t k = 0; k < n; ++k) some[k] = rings[k < count ? k : count - 1];
  return load_rings<n>(some);
}
template <std::size_t n>
CLAYSTACK_INLINE inline void store(Ring* rings, const RingPack<n>& pack) noexcept {
  if constexpr (n == 2) {
    store(rings, Quantas<2>(__builtin_shufflevector(pack.outer2, pack.inner2, 0, 2)));
    store(rings + 1, Quantas<2>(__builtin_shufflevector(pack.outer2, pack.inner2, 1, 3)));
  } else {
    store(rings, Quantas<4>(__builtin_shufflevector(pack.outer2, pack.inner2, 0, 4, 1, 5)));
    store(rings + 2, Quantas<4>(__builtin_shufflevector(pack.outer2, pack.inner2, 2, 6, 3, 7)));
  }
}

}  // namespace clay
