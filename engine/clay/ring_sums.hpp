#pragma once
// Sums over parts of a stack, for stages that cannot read all of it in a tick.

#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// Sums over a block of consecutive rings.
struct RingBlock {
  WideQuanta volume = 0;
  Quanta least = 0;  ///< volume of the smallest ring
};

/// Of one ring at least.
[[nodiscard]] RingBlock block_of(std::span<const Ring> rings) noexcept;

/// Blocks of 64 rings, blocks of 64 such blocks, and so on up to the first level of at most 64:
/// three levels for the 2^24 rings of the largest stack, half a byte per ring.
class RingSums {
 public:
  static constexpr std::size_t kFan = 64;

  RingSums() = default;
  /// O(N). Allocates for max_rings() at once; no later allocation.
  explicit RingSums(const ClayStack& stack);

  /// Updates the sums after rings first..last changed or were added: O(last - first + 64 levels).
  void refresh(std::span<const Ring> rings, std::size_t first, std::size_t last) noexcept;

  /// Volume of all rings above ring i, with at most 63 additions per level and as many rings.
  [[nodiscard]] WideQuanta above(std::span<const Ring> rings, std::size_t i) const noexcept;

  /// Searches the stack from the top. Calls scan(first, last, weight) for the blocks of at most 64
  /// rings for which suspect(weight, least) is true, for them and for every block that contains
  /// them. The weight of scan is the load on ring `last`; that of suspect also includes the block
  /// itself. `crown` is the load on the top ring.
  template <class Suspect, class Scan>
  void search(std::size_t rings, WideQuanta crown, Suspect suspect, Scan scan) const noexcept {
    const std::size_t top = levels_.size() - 1;
    search(rings, top, 0, used(rings, top), crown, suspect, scan);
  }

 private:
  /// Number of blocks of a level that contain the given number of rings.
  [[nodiscard]] static std::size_t used(std::size_t rings, std::size_t level) noexcept {
    for (std::size_t k = 0; k <= level; ++k) rings = (rings + kFan - 1) / kFan;
    return rings;
  }

  /// Searches blocks first..end-1 of a level. Returns the weight below them.
  template <class Suspect, class Scan>
  WideQuanta search(std::size_t rings, std::size_t level, std::size_t first, std::size_t end,
                    WideQuanta weight, Suspect& suspect, Scan& scan) const noexcept {
    for (std::size_t k = end; k-- > first;) {
      const RingBlock& block = levels_[level][k];
      const WideQuanta below = weight + block.volume;
      if (suspect(below, block.least)) {
        const std::size_t parts = level == 0 ? rings : used(rings, level - 1);
        const std::size_t from = k * kFan, to = from + kFan < parts ? from + kFan : parts;
        if (level == 0)
          scan(from, to - 1, weight);
        else
          search(rings, level - 1, from, to, weight, suspect, scan);
      }
      weight = below;
    }
    return weight;
  }

  std::vector<std::vector<RingBlock>> levels_;  ///< smallest blocks first
};

}  // namespace clay
