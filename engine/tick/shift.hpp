#pragma once
// Moving the wall, ring by ring, without changing how much clay a ring holds.

#include "claystack/engine/clay.hpp"
#include "engine/tick/shell.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// What a shift does to the rings from() .. to()-1. Nothing is written: `after` says what a ring
/// will be, and redistribution makes it so. Storage is reserved once.
class Shift {
 public:
  /// Room for this number of rings.
  void reserve(std::size_t rings);
  void clear() noexcept;

  [[nodiscard]] bool empty() const noexcept { return moved_.empty(); }
  [[nodiscard]] std::size_t from() const noexcept { return from_; }
  [[nodiscard]] std::size_t to() const noexcept { return from_ + moved_.size(); }

  /// Clay that the shift pushes up (outward: takes from above, below 0).
  [[nodiscard]] WideQuanta raised() const noexcept { return raised_total_; }

  /// R^2 and r^2 change alike, by q = u (2 R - u) where the wall is pushed in and u (2 r + u)
  /// where it is pushed out; half of the hoop strain q / (R^2 + r^2) becomes height.
  [[nodiscard]] Ring after(std::size_t i, const Ring& ring) const noexcept {
    const std::size_t k = i - from_;
    if (k >= moved_.size()) return ring;
    return {ring.outer2 + moved_[k], ring.inner2 + moved_[k] + raised_[k]};
  }

  /// Of R^2 of each ring from() .. to()-1, and the clay that it gives up [quanta].
  [[nodiscard]] std::span<const Quanta> moved() const noexcept { return moved_; }
  [[nodiscard]] std::span<const Quanta> raised_of_rings() const noexcept { return raised_; }

  struct Push {
    bool outward = false;
    bool hoop = true;
    double min_wall_mm = 0.0;
  };
  /// Lays the wall's motion about a band. `limit(first, by)` may change how far the rings from
  /// `first` on move [mm].
  template <class Limit>
  void lay(const ClayStack& stack, const Band& band, const Shell& shell, const Push& push,
           Limit limit) noexcept {
    begin(stack, band, shell);
    for (std::size_t first = from_; first < to(); first += kRows) {
      double by[kRows];
      const std::span<double> rows(by, std::min(kRows, to() - first));
      bend(stack.ring_height_mm(), band, shell, first, rows);
      limit(first, rows);
      move(stack, push, first, rows);
    }
    settle(stack);
  }

 private:
  static constexpr std::size_t kRows = 32;
  void begin(const ClayStack& stack, const Band& band, const Shell& shell) noexcept;
  static void bend(double h, const Band& band, const Shell& shell, std::size_t first,
                   std::span<double> by) noexcept;
  void move(const ClayStack& stack, const Push& push, std::size_t first,
            std::span<const double> by) noexcept;
  void settle(const ClayStack& stack) noexcept;

  std::size_t from_ = 0;
  std::vector<Quanta> moved_;   ///< of R^2; below 0 inward
  std::vector<Quanta> raised_;  ///< clay that the ring gives up; below 0: that it gets
  WideQuanta raised_total_ = 0;
};

}  // namespace clay
