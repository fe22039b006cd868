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

/// Rings from..last and, beyond the last, the last again.
template <std::size_t n>
CLAYSTACK_INLINE inline RingPack<n> load_up_to(const Ring* rings, std::size_t from,
                                               std::size_t last) noexcept {
  const std::size_t i = from < last ? from : last;
  return load_rings<n>(rings + i, last + 1 - i);
}

template <std::size_t n>
CLAYSTACK_INLINE inline TwiceFloats<n> lengths(Quantas<n> low, Quantas<n> high) noexcept {
  return root(floats(doubles_of(low), doubles_of(high)) * static_cast<float>(kMm2PerQuantum));
}

template <std::size_t n>
CLAYSTACK_INLINE inline void measure_rows(const Ring* rings, std::size_t first, std::size_t last,
                                          std::size_t count, float* outer, float* inner,
                                          float* thickness) noexcept {
  for (std::size_t k = 0; k < count; k += 2 * n) {
    const RingPack<n> low = load_up_to<n>(rings, first + k, last);
    const RingPack<n> high = load_up_to<n>(rings, first + k + n, last);
    const TwiceFloats<n> out = lengths<n>(low.outer2, high.outer2);
    const TwiceFloats<n> in = lengths<n>(low.inner2, high.inner2);
    store(outer + k, out);
    store(inner + k, in);
    store(thickness + k, TwiceFloats<n>(out - in));
  }
}

}  // namespace

void WallRadii::reserve(const Tool& tool, const ClayStack& stack) {
  const double h = stack.ring_height_mm(), most = static_cast<double>(stack.max_rings());
  const double reach = tool.high() - tool.low() + 2.0 * kLongestShellMm;
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
  if (from_ == to_) from_ = to_ = first;
  if (first < from_) measure(stack, first, from_);
  if (end > to_) measure(stack, to_, end);
  if (first == 0)
    for (std::size_t k = 1; k <= apart_; ++k) thickness_[row(0) - k] = thickness_[row(0)];
  from_ = std::min(from_, first);
  to_ = std::max(to_, end);
}

void WallRadii::measure(const ClayStack& stack, std::size_t first, std::size_t end) noexcept {
  assert(first >= origin_ && row(end) + apart_ + kSpare <= outer_.size());
  const std::size_t last = stack.size() - 1;
  // The end ring stands for those beyond it. As many as packs of any width measure.
  const std::size_t count = in_packs_of(end + (end > last ? apart_ + kWidestFloats : 0) - first);
  in_packs([=, rings = stack.rings().data(), outer = &outer_[row(first)],
            inner = &inner_[row(first)], thickness = &thickness_[row(first)]](auto n)
               CLAYSTACK_INLINE {
                 measure_rows<n>(rings, first, last, count, outer, inner, thickness);
               });
}

}  // namespace clay
