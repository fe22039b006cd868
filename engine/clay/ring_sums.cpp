#include "engine/clay/ring_sums.hpp"

#include "engine/clay/packs.hpp"

#include <algorithm>

namespace clay {
namespace {

WideQuanta volume_of(const Ring& ring) noexcept { return ring.volume(); }
WideQuanta volume_of(const RingBlock& block) noexcept { return block.volume; }

RingBlock sum(std::span<const RingBlock> parts) noexcept {
  RingBlock block{0, parts.front().least};
  for (const RingBlock& part : parts) {
    block.volume += part.volume;
    block.least = std::min(block.least, part.least);
  }
  return block;
}
RingBlock sum(std::span<const Ring> rings) noexcept { return block_of(rings); }

/// The volumes of n rings, in any order.
template <std::size_t n>
CLAYSTACK_INLINE inline Quantas<n> volumes_of(const Ring* rings) noexcept {
  const auto a = load<Quantas<n>>(rings), b = load<Quantas<n>>(rings + n / 2);
  if constexpr (n == 2)
    return __builtin_shufflevector(a, b, 0, 2) - __builtin_shufflevector(a, b, 1, 3);
  else
    return __builtin_shufflevector(a, b, 0, 4, 2, 6) - __builtin_shufflevector(a, b, 1, 5, 3, 7);
}

/// Of an even number of packs; the second of each two does not wait for the first. The overflow of
/// the sum of 64 bits follows from the sum of the upper halves.
template <std::size_t n>
CLAYSTACK_INLINE inline void add_packs(const Ring* rings, std::size_t count,
                                       RingBlock* block) noexcept {
  Bits<n> sum{}, high{};
  auto least = all_of<Quantas<n>>(block->least), second = least;
  const auto add = [&](Quantas<n> volume, Quantas<n>& smallest) CLAYSTACK_INLINE {
    const auto bits = reinterpret_cast<Bits<n>>(volume);
    sum += bits;
    high += bits >> 32;
    smallest = volume < smallest ? volume : smallest;
  };
  for (std::size_t k = 0; k < count; k += 2 * n) {
    add(volumes_of<n>(rings + k), least);
    add(volumes_of<n>(rings + k + n), second);
  }
  least = second < least ? second : least;
  for (std::size_t k = 0; k < n; ++k) {
    // The lower halves: the rest of the sum, if there are at most 2^32 rings.
    const auto low = static_cast<std::uint64_t>(sum[k] - (high[k] << 32));
    block->volume += (WideQuanta{high[k]} << 32) + WideQuanta{low};
    block->least = std::min(block->least, Quanta{least[k]});
  }
}

/// Recomputes the sums of the blocks that contain parts first..last.
template <class Part>
void sum_parts(std::span<const Part> parts, std::size_t first, std::size_t last,
               std::span<RingBlock> blocks) noexcept {
  constexpr std::size_t fan = RingSums::kFan;
  for (std::size_t k = first / fan; k <= last / fan; ++k)
    blocks[k] = sum(parts.subspan(k * fan, std::min(fan, parts.size() - k * fan)));
}

/// The sum of the parts after the i-th in the same block.
template <class Part>
WideQuanta rest_of_block(std::span<const Part> parts, std::size_t i) noexcept {
  const std::size_t end = std::min(parts.size(), (i / RingSums::kFan + 1) * RingSums::kFan);
  WideQuanta rest = 0;
  for (std::size_t k = i + 1; k < end; ++k) rest += volume_of(parts[k]);
  return rest;
}

}  // namespace

RingBlock block_of(std::span<const Ring> rings) noexcept {
  RingBlock block{0, rings.front().volume()};
  const std::size_t packed = rings.size() / (2 * kWidestPack) * (2 * kWidestPack);
  in_packs([=, from = rings.data(), to = &block](auto n)
               CLAYSTACK_INLINE { add_packs<n>(from, packed, to); });
  for (const Ring& ring : rings.subspan(packed)) {
    block.volume += ring.volume();
    block.least = std::min(block.least, ring.volume());
  }
  return block;
}

RingSums::RingSums(const ClayStack& stack) {
  for (std::size_t parts = stack.max_rings(); levels_.empty() || parts > kFan;)
    levels_.emplace_back(parts = (parts + kFan - 1) / kFan);
  refresh(stack.rings(), 0, stack.size() - 1);
}

void RingSums::refresh(std::span<const Ring> rings, std::size_t first, std::size_t last) noexcept {
  sum_parts(rings, first, last, std::span(levels_[0]));
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    first /= kFan;
    last /= kFan;
    const std::size_t parts = used(rings.size(), level - 1);
    sum_parts(std::span<const RingBlock>(levels_[level - 1]).first(parts), first, last,
              std::span(levels_[level]));
  }
}

WideQuanta RingSums::above(std::span<const Ring> rings, std::size_t i) const noexcept {
  WideQuanta sum = rest_of_block(rings, i);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    i /= kFan;
    const std::size_t parts = used(rings.size(), level);
    sum += rest_of_block(std::span<const RingBlock>(levels_[level]).first(parts), i);
  }
  return sum;
}

}  // namespace clay
