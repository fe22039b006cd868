#include "engine/tick/wall_radii.hpp"

#include "engine/clay/packs.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cassert>

namespace clay {
namespace {

constexpr double kSlopeWayMm = 0.17;
constexpr double kMostApart = 64.0;              // rings
constexpr std::size_t kSpare = 4 * kWidestPack;  // rows that packs may write and read too

/// R and r of 2 n rings.
template <std::size_t n>
struct Radii {
  TwiceFloats<n> outer, inner;
};

/// Of R and r side by side, ring by ring.
template <std::size_t n>
CLAYSTACK_INLINE inline Radii<n> both_of(TwiceFloats<n> low, TwiceFloats<n> high) noexcept {
  if constexpr (n == 4) {
    // Within the halves of a register, then across: one shuffle would be three.
    const auto across = [](TwiceFloats<4> x) CLAYSTACK_INLINE {
      const auto pairs = reinterpret_cast<Doubles<4>>(x);
      return reinterpret_cast<TwiceFloats<4>>(__builtin_shufflevector(pairs, pairs, 0, 2, 1, 3));
    };
    return {across(__builtin_shufflevector(low, high, 0, 2, 8, 10, 4, 6, 12, 14)),
            across(__builtin_shufflevector(low, high, 1, 3, 9, 11, 5, 7, 13, 15))};
  } else {
    return {__builtin_shufflevector(low, high, 0, 2, 4, 6),
            __builtin_shufflevector(low, high, 1, 3, 5, 7)};
  }
}

/// `small`: all R^2 are below `kSmallQuanta`, as of any pot below 256 mm. Then most of the
/// conversion is not needed.
template <std::size_t n, bool small>
CLAYSTACK_INLINE inline Radii<n> radii_of(const Ring* rings, Quantas<n>& largest) noexcept {
  // R^2 and r^2 of a ring stay side by side until they are floats.
  Floats<n> parts[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const auto squares = load<Quantas<n>>(rings + i * n / 2);
    largest |= squares;
    if constexpr (small)
      parts[i] = floats(small_doubles(squares));
    else
      parts[i] = floats(doubles_of(squares));
  }
  constexpr auto kMm2 = static_cast<float>(kMm2PerQuantum);
  return both_of<n>(root(joined<n>(parts[0], parts[1]) * kMm2),
                    root(joined<n>(parts[2], parts[3]) * kMm2));
}

/// Rings first..last and, beyond the last, the last again. False if they are not small.
template <std::size_t n, bool small>
CLAYSTACK_INLINE inline bool measure_rows(const Ring* rings, std::size_t first, std::size_t last,
                                          std::size_t count, float* outer, float* inner,
                                          float* thickness) noexcept {
  Quantas<n> largest{};
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const std::size_t i = first + k;
    RawRings<2 * n> copies;
    if (i + 2 * n > last + 1)
      for (std::size_t c = 0; c < 2 * n; ++c) copies.data()[c] = rings[std::min(i + c, last)];
    const auto [out, in] =
        radii_of<n, small>(i + 2 * n > last + 1 ? copies.data() : rings + i, largest);
    store(outer + k, out);
    store(inner + k, in);
    store(thickness + k, TwiceFloats<n>(out - in));
  }
  return !any(largest >= kSmallQuanta);
}

}  // namespace

void WallRadii::reserve(const Tool& tool, const ClayStack& stack) {
  const double h = stack.ring_height_mm(), most = static_cast<double>(stack.max_rings());
  // A shell goes half a contact farther than its peak, which may be at the contact's end.
  const double reach = 1.5 * (tool.high() - tool.low()) + 2.0 * kLongestShellMm;
  apart_ = static_cast<std::size_t>(std::clamp(kSlopeWayMm / h, 1.0, kMostApart));
  before_ = apart_ + kSpare;
  half_ = static_cast<std::size_t>(std::min(reach / h, most)) + apart_ + kSpare;
  for (auto* rows : {&outer_, &inner_, &thickness_}) rows->resize(2 * (half_ + before_));
}

void WallRadii::begin(std::size_t ring) noexcept {
  origin_ = ring - std::min(ring, half_);
  from_ = to_ = 0;
}

void WallRadii::cover(const ClayStack& stack, std::size_t first, std::size_t end) noexcept {
  // Slopes need the walls beside them, and packs are whole.
  first -= std::min(first - origin_, apart_);
  end = std::min(end + apart_ + kWidestFloats, stack.size());
  assert(first >= origin_ && end <= origin_ + 2 * half_);
  end = std::min(end, origin_ + 2 * half_);
  if (from_ == to_) from_ = to_ = first;
  if (first < from_) measure(stack, first, from_);
  if (end > to_) measure(stack, to_, end);
  if (first == 0)
    for (std::size_t k = 1; k <= apart_; ++k) {
      thickness_[row(0) - k] = thickness_[row(0)];
      outer_[row(0) - k] = outer_[row(0)];
      inner_[row(0) - k] = inner_[row(0)];
    }
  from_ = std::min(from_, first);
  to_ = std::max(to_, end);
}

void WallRadii::measure(const ClayStack& stack, std::size_t first, std::size_t end) noexcept {
  const std::size_t last = stack.size() - 1;
  // The end ring represents those beyond it, as many as packs of any width measure.
  const std::size_t count = in_packs_of(end + (end > last ? apart_ + kWidestFloats : 0) - first);
  in_packs([=, rings = stack.rings().data(), outer = &outer_[row(first)],
            inner = &inner_[row(first)], thickness = &thickness_[row(first)]](auto n)
               CLAYSTACK_INLINE {
                 if (!measure_rows<n, true>(rings, first, last, count, outer, inner, thickness))
                   measure_rows<n, false>(rings, first, last, count, outer, inner, thickness);
               });
}

}  // namespace clay
