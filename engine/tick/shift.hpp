#pragma once
// Motion of the wall, ring by ring, without a change of the clay in a ring.

#include "claystack/engine/clay.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// Limit of the clay that may raise the rim, where a narrow rim closes. No limit by default.
struct RimLimit {
  double ring_mm2 = 1e30;  ///< R^2 - r^2 of the ring by which the rim rises
  bool waits = false;      ///< clay waits above the rim: a press bends the wall and raises nothing

  [[nodiscard]] bool limits() const noexcept { return ring_mm2 < 1e30; }
};

/// Rings that one part of a tick may take out under the rim.
inline constexpr std::size_t kMostSunk = 64;

/// The effect of a shift on the rings from() .. to()-1. Nothing is written: `after` is the later
/// shape of a ring, and redistribution applies it. Storage is reserved once.
class Shift {
 public:
  /// Rings that `lay` hands over at a time, at most.
  static constexpr std::size_t kRows = 128;

  /// Room for this number of rings.
  void reserve(std::size_t rings);
  void clear() noexcept;

  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] std::size_t from() const noexcept { return from_; }
  [[nodiscard]] std::size_t to() const noexcept { return from_ + count_; }

  /// Clay that the shift pushes up; below 0: clay that an outward shift takes from above.
  [[nodiscard]] WideQuanta raised() const noexcept { return raised_total_; }

  /// R^2 and r^2 change alike, by q = u (2 R - u) where the wall is pushed in and u (2 r + u)
  /// where it is pushed out; half of the hoop strain q / (R^2 + r^2) becomes height. A wall that
  /// stretches also takes the clay that it lacks for its minimum from its height.
  [[nodiscard]] Ring after(std::size_t i, const Ring& ring) const noexcept {
    const std::size_t k = i - from_;
    if (k >= count_) return ring;
    return {ring.outer2 + changes_[k].outer2, ring.inner2 + changes_[k].inner2};
  }
  /// The same of the rings from `first` on.
  void move(std::size_t first, std::span<Ring> rings) const noexcept {
    const std::size_t end = std::min(first + rings.size(), to());
    for (std::size_t i = std::max(first, from_); i < end; ++i) {
      rings[i - first].outer2 += changes_[i - from_].outer2;
      rings[i - first].inner2 += changes_[i - from_].inner2;
    }
  }

  /// Of R^2 and r^2 of each ring from() .. to()-1 [quanta].
  [[nodiscard]] std::span<const Ring> changes() const noexcept {
    return std::span(changes_).first(count_);
  }

  struct Push {
    bool outward = false;
    bool hoop = true;
    double min_wall_mm = 0.0;
    /// No ring raises the rim by more height than the ring gains by half of its hoop strain.
    RimLimit rim = {};
    bool stretch = false;  ///< outward, a wall at its minimum keeps its thickness and loses height
  };
  /// Lays the wall's motion about a band. `limit(first, by)` may change the motions of the rings
  /// from `first` on [mm], and so may `least(first, by)`, after the part that trails.
  template <class Limit, class Least>
  void lay(const ClayStack& stack, WallRadii& walls, const Band& band, const Shell& shell,
           const Push& push, Limit limit, Least least) noexcept {
    begin(stack, band, shell);
    walls.cover(stack, from_, to());
    for (std::size_t first = from_; first < to(); first += kRows) {
      alignas(kPackBytes) float by[kRows];
      const std::size_t count = std::min(kRows, to() - first);
      bend(stack.ring_height_mm(), band, shell, first, count, by);
      limit(first, std::span(by).first(count));
      if (shell.trail_below < 1.0 || shell.trail_above < 1.0)
        trail(stack.ring_height_mm(), band, shell, first, count, by);
      least(first, std::span(by).first(count));
      std::fill(by + count, by + in_packs_of(count), 0.0f);
      move(stack, walls, push, first, count, by);
    }
    settle(stack, push.stretch);
  }
  /// Of the rings first..end-1, those that have become thicker keep their thickness: their outer
  /// surface moves by less, and the clay becomes height.
  void keep_thickness(const ClayStack& stack, std::size_t first, std::size_t end) noexcept;

 private:
  void begin(const ClayStack& stack, const Band& band, const Shell& shell) noexcept;
  static void bend(double h, const Band& band, const Shell& shell, std::size_t first,
                   std::size_t count, float* by) noexcept;
  /// The wall behind a moving tool moves less: scales `by` [mm].
  static void trail(double h, const Band& band, const Shell& shell, std::size_t first,
                    std::size_t count, float* by) noexcept;
  /// `by`, of whole packs: motions of the rings [mm], less where the wall is not thin. Afterwards
  /// the changes of R^2 and r^2 [mm^2].
  void move(const ClayStack& stack, const WallRadii& walls, const Push& push, std::size_t first,
            std::size_t count, float* by) noexcept;
  void keep_quanta(std::span<const Ring> rings, std::size_t first, std::size_t count) noexcept;
  void settle(const ClayStack& stack, bool stretch) noexcept;

  std::size_t from_ = 0, count_ = 0;
  std::vector<Ring> changes_;  ///< room for whole packs; R^2 below 0: inward
  WideQuanta raised_total_ = 0;
};

}  // namespace clay
