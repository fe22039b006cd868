#pragma once
// The only class that changes a ClayStack. It keeps the running sums; they are up to date again
// when the writer is destroyed, so that a loop can count in a register.

#include "claystack/engine/clay.hpp"

#include <algorithm>
#include <cassert>

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
  /// The ring becomes another one; its clay is counted.
  void replace(std::size_t i, const Ring& ring) noexcept {
    Ring& old = stack_.rings_[i];
    assert(ring.volume() > 0 && ring.inner2 >= 0);
    gained_ += ring.volume() - old.volume();
    opened_ += (ring.inner2 > 0 ? 1u : 0u) - (old.inner2 > 0 ? 1u : 0u);
    old = ring;
  }
  /// Clay along a surface: the outer one, or that of a bore.
  void smear(std::size_t from, std::size_t to, Quanta amount, bool outside) noexcept {
    Quanta& less = outside ? stack_.rings_[from].outer2 : stack_.rings_[to].inner2;
    Quanta& more = outside ? stack_.rings_[to].outer2 : stack_.rings_[from].inner2;
    less -= amount;
    more += amount;
  }
  void put_on_crown(WideQuanta amount) noexcept { stack_.crown_ += amount; }

  /// Step (b) of section 5.1: a new ring above the top one. Capacity for max_rings() is reserved
  /// when the scene is built, so this does not allocate.
  void grow(const Ring& ring) noexcept {
    stack_.rings_.push_back(ring);
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
  void reserve() { stack_.rings_.reserve(stack_.max_rings_); }

 private:
  static inline const Quanta kLargestOuter2 = quanta_from_radius(kMaxRadiusMm);
  ClayStack& stack_;
  WideQuanta gained_ = 0;   ///< by rings, not yet added to the stack's sum
  std::size_t opened_ = 0;  ///< bores opened minus bores closed, modulo 2^64
};

}  // namespace clay
