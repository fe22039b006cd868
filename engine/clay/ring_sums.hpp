#pragma once
// Sums over stretches of a stack, for those who may not read all of it in a tick.

#include "claystack/engine/clay.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// Of some consecutive rings.
struct Stretch {
  WideQuanta volume = 0;
  Quanta least = 0;  ///< volume of the thinnest of them
};

/// Stretches of 64 rings, stretches of 64 such stretches, and so on up to the first level of no
/// more than 64: three levels for the 2^24 rings that a stack can have, at half a byte for a ring.
class RingSums {
 public:
  static constexpr std::size_t kFan = 64;

  RingSums() = default;
  /// O(N). Takes the memory for max_rings() at once: nothing here allocates later.
  explicit RingSums(const ClayStack& stack);

  /// Rings first..last have changed, or are new on top: O(last - first + 64 levels).
  void refresh(std::span<const Ring> rings, std::size_t first, std::size_t last) noexcept;

  /// Of all rings above ring i, in at most 63 additions a level and as many rings.
  [[nodiscard]] WideQuanta above(std::span<const Ring> rings, std::size_t i) const noexcept;

  /// Goes through the stack from the top. scan(first, last, weight) is called for those stretches
  /// of at most 64 rings for which suspect(weight, least) is true of themselves and of every longer
  /// stretch that they are part of. scan's weight is what stands on ring `last`, suspect's that
  /// and the stretch itself; `crown` stands on the top ring.
  template <class Suspect, class Scan>
  void search(std::size_t rings, WideQuanta crown, Suspect suspect, Scan scan) const noexcept {
    const std::size_t top = levels_.size() - 1;
    search(rings, top, 0, used(rings, top), crown, suspect, scan);
  }

 private:
  /// How many stretches of a level so many rings fill or begin.
  [[nodiscard]] static std::size_t used(std::size_t rings, std::size_t level) noexcept {
    for (std::size_t k = 0; k <= level; ++k) rings = (rings + kFan - 1) / kFan;
    return rings;
  }

  /// Stretches first..end-1 of a level. Returns the weight below them.
  template <class Suspect, class Scan>
  WideQuanta search(std::size_t rings, std::size_t level, std::size_t first, std::size_t end,
                    WideQuanta weight, Suspect& suspect, Scan& scan) const noexcept {
    for (std::size_t k = end; k-- > first;) {
      const Stretch& stretch = levels_[level][k];
      const WideQuanta below = weight + stretch.volume;
      if (suspect(below, stretch.least)) {
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

  std::vector<std::vector<Stretch>> levels_;  ///< the shortest stretches first
};

}  // namespace clay
