#pragma once
// The only class that changes a ClayStack. It keeps the running sums; they are up to date again
// when the writer is destroyed, so that a loop can count in a register.

#include "claystack/engine/clay.hpp"
#include "engine/clay/lanes.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>

namespace clay {

class StackWriter {
 public:
  explicit StackWriter(ClayStack& stack) noexcept : stack_(stack) {}
  StackWriter(const StackWriter&) = delete;
  StackWriter& operator=(const StackWriter&) = delete;
  ~StackWriter() {
    stack_.rings_volume_ += gained_;
    stack_.bores_ += opened_;
  }

  void take_outside(std::size_t i, Quanta amount) noexcept {
    stack_.rings_[i].outer2 -= amount;
    gained_ -= amount;
    assert(stack_.rings_[i].volume() > 0);
  }
  void take_inside(std::size_t i, Quanta amount) noexcept {
    opened_ += stack_.rings_[i].inner2 == 0 && amount > 0 ? 1u : 0u;
    stack_.rings_[i].inner2 += amount;
    gained_ -= amount;
    assert(stack_.rings_[i].volume() > 0);
  }
  /// The same of the rings from `first` on. Returns the sum.
  WideQuanta take(std::size_t first, std::span<const Quanta> amounts, bool outside) noexcept {
    Ring* const rings = stack_.rings_.data() + first;
    WideQuanta sum = 0;
    for (std::size_t k = 0; k < amounts.size(); ++k) {
      const Quanta amount = amounts[k];
      if (outside) {
        rings[k].outer2 -= amount;
      } else {
        opened_ += rings[k].inner2 == 0 && amount > 0 ? 1u : 0u;
        rings[k].inner2 += amount;
      }
      assert(rings[k].volume() > 0);
      sum += amount;
    }
    gained_ -= sum;
    return sum;
  }
  /// Each returns the amount that found room: up to the axis inside, up to the largest radius
  /// outside. Amounts are Quanta or WideQuanta. The caller reports their total with `gain`.
  template <class Amount>
  Quanta put_inside(std::size_t i, Amount amount) noexcept {
    const auto placed = static_cast<Quanta>(std::min<Amount>(amount, stack_.rings_[i].inner2));
    stack_.rings_[i].inner2 -= placed;
    if (placed > 0 && stack_.rings_[i].inner2 == 0) [[unlikely]]
      --opened_;
    return placed;
  }
  template <class Amount>
  Quanta put_outside(std::size_t i, Amount amount) noexcept {
    const Quanta room = kLargestOuter2 - stack_.rings_[i].outer2;
    const auto placed = static_cast<Quanta>(std::min<Amount>(amount, room));
    stack_.rings_[i].outer2 += placed;
    return placed;
  }
  void gain(WideQuanta amount) noexcept { gained_ += amount; }
  /// R^2 and r^2 of the rings from `first` on change by these amounts; no bore opens or closes, and
  /// no radius is beyond its limit. The caller reports the clay that they get with `gain`.
  void change(std::size_t first, std::span<const Ring> changes) noexcept {
    in_lanes([rings = stack_.rings_.data() + first, from = changes.data(), count = changes.size()]()
                 CLAYSTACK_INLINE {
#pragma GCC unroll 8
                   for (std::size_t k = 0; k < count; ++k) {
                     rings[k].outer2 += from[k].outer2;
                     rings[k].inner2 += from[k].inner2;
                     assert(rings[k].volume() > 0 && rings[k].inner2 >= 0);
                   }
                 });
  }
  /// Clay along a surface, the outer one or that of a bore: amounts from the rings `from` on to the
  /// rings `to` on. First the losses of all rings, then the gains: otherwise the gain of a ring
  /// would wait for its loss.
  void smear(std::size_t from, std::size_t to, std::span<const Quanta> amounts,
             bool outside) noexcept {
    Ring *const low = stack_.rings_.data() + from, *const high = stack_.rings_.data() + to;
    const std::size_t count = amounts.size();
    if (outside) {
      for (std::size_t k = 0; k < count; ++k) low[k].outer2 -= amounts[k];
      for (std::size_t k = 0; k < count; ++k) high[k].outer2 += amounts[k];
    } else {
      for (std::size_t k = 0; k < count; ++k) low[k].inner2 += amounts[k];
      for (std::size_t k = 0; k < count; ++k) high[k].inner2 -= amounts[k];
    }
  }
  void put_on_crown(WideQuanta amount) noexcept { stack_.crown_ += amount; }

  /// Step (b) of section 5.1: a new ring, the i-th; those above it rise. Capacity for max_rings()
  /// is reserved when the scene is built, so this does not allocate.
  void grow(std::size_t i, const Ring& ring) noexcept {
    stack_.rings_.insert(stack_.rings_.begin() + static_cast<std::ptrdiff_t>(i), ring);
    opened_ += ring.inner2 > 0 ? 1u : 0u;
    gained_ += ring.volume();
  }
  /// The top ring goes into the crown.
  void sink() noexcept {
    const Ring& top = stack_.rings_.back();
    stack_.crown_ += top.volume();
    gained_ -= top.volume();
    opened_ -= top.inner2 > 0 ? 1u : 0u;
    stack_.rings_.pop_back();
  }
  /// Ring i gets these radii; the crown gives or gets the clay. No bore opens or closes.
  void reshape(std::size_t i, const Ring& ring) noexcept {
    const Quanta more = ring.volume() - stack_.rings_[i].volume();
    assert(ring.volume() > 0 && (ring.inner2 > 0) == (stack_.rings_[i].inner2 > 0));
    stack_.rings_[i] = ring;
    stack_.crown_ -= more;
    gained_ += more;
  }
  /// Takes the rings i .. top off, and the crown. Returns their clay.
  WideQuanta cut_above(std::size_t i) noexcept {
    const WideQuanta crown = stack_.crown_, before = gained_;
    while (stack_.rings_.size() > i) sink();
    const WideQuanta cut = before - gained_ + crown;
    stack_.crown_ = 0;
    return cut;
  }
  /// Takes the rings below ring i off; the others are set down. Returns their clay.
  WideQuanta cut_below(std::size_t i) noexcept {
    const WideQuanta before = gained_;
    for (std::size_t k = 0; k < i; ++k) {
      gained_ -= stack_.rings_[k].volume();
      opened_ -= stack_.rings_[k].inner2 > 0 ? 1u : 0u;
    }
    stack_.rings_.erase(stack_.rings_.begin(),
                        stack_.rings_.begin() + static_cast<std::ptrdiff_t>(i));
    return before - gained_;
  }
  void reserve() { stack_.rings_.reserve(stack_.max_rings_); }

 private:
  ClayStack& stack_;
  WideQuanta gained_ = 0;   ///< by rings, not yet added to the stack's sum
  std::size_t opened_ = 0;  ///< bores opened minus bores closed, modulo 2^64
};

}  // namespace clay
