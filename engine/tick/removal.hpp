#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/shift.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// One tool's contact, and the clay that it removes from each of its rings in this tick [quanta].
/// Storage is reserved once.
struct ToolRemoval {
  Contact contact;
  std::vector<Quanta> removed;
};

/// Clay that has given way, and the part of it that may become height.
struct LooseClay {
  RimLimit rim;
  WideQuanta total = 0;
  double raising = 0.0;  ///< at most, if the rim limits it [quanta]

  void add(Quanta amount, const Ring& left) noexcept {
    total += amount;
    if (rim.limits()) raise(amount, left);
  }
  /// Clay that is squeezed out of a ring raises the rim by no more than it would raise that ring.
  void raise(Quanta amount, const Ring& left) noexcept {
    const double part = rim.ring_mm2 * kQuantaPerMm2 / static_cast<double>(left.volume());
    raising += static_cast<double>(amount) * std::min(1.0, part);
  }
};

/// Delta v of a surface that moves by eps [mm], limited by the clay that the ring can lose.
[[nodiscard]] Quanta take_outside(const Ring& ring, double outer_mm, double eps) noexcept;
[[nodiscard]] Quanta take_inside(const Ring& ring, double inner_mm, double eps) noexcept;

/// The clay that leaves each touched ring this tick, in quanta, parallel to `contact.rings`;
/// equations (3) and (4) with Delta v = eps (2R - eps) outside, eps (2r + eps) inside. Writes
/// nothing else.
///
/// `paper`: eps = k (R - r).
/// `conserving`: by the equation of yielding.hpp, never past the tool's surface and never through
/// the minimum wall. Sets the contact's depths to the rest.
template <Model model>
void compute_removal(const RemovalPlan& plan, const ClayStack& stack, double dt_s, Contact& contact,
                     std::vector<Quanta>& removed) noexcept;

/// Clay rules: parameters for squeezing clay out of rings that a shift has moved.
struct Squeeze {
  double min_wall_mm = 0.0;
  std::size_t floor_rings = 0;   ///< RulesPlan
  bool from_below = false;       ///< the tool trims the foot
  const Shift* shift = nullptr;  ///< none: the rings as they are

  /// Whether ring i is of the floor, which stays closed where it has no bore: the lowest rings, and
  /// for a tool from below the rings next to the bore. Without a bore the pot ends at its rim.
  [[nodiscard]] bool of_floor(std::size_t i, std::span<const Ring> rings) const noexcept {
    if (!from_below) return i < floor_rings;
    const std::size_t above = i + floor_rings;
    return above >= rings.size() || rings[above].inner2 > 0;
  }

  [[nodiscard]] Ring ring(std::size_t i, std::span<const Ring> rings) const noexcept {
    return shift != nullptr ? shift->after(i, rings[i]) : rings[i];
  }
};

/// Clay rules, first half of `compute_removal`: writes to the contact the distance by which each
/// ring gives way (`TouchedRings::give`), by a shift or by being squeezed.
void give_way(const RemovalPlan& plan, const ClayStack& stack, double dt_s,
              Contact& contact) noexcept;
/// Second half: removes the part that the shift has not moved, as far as minimum wall and floor
/// allow. Sets the contact's depths to the rest.
void squeeze_out(const Squeeze& rules, const ClayStack& stack, Contact& contact,
                 std::vector<Quanta>& removed) noexcept;

/// Clay that two tools remove from one wall, each from its own side, until the wall is as thick as
/// the gap. Equations (3) and (4) at once:
///
/// `paper`: k (R - r) each.
/// `conserving`: dR/dt = -kappa (R - r) and dr/dt = kappa (R - r), each until its tool's surface is
/// reached, both until the minimum wall is; solved in closed form, and no faster than a surface
/// yields to one tool near it. Both surfaces move equally: the middle of the wall stays.
template <Model model>
void compute_pinch_removal(const RemovalPlan& plan, const ClayStack& stack, double gap_mm,
                           double dt_s, ToolRemoval& outer, ToolRemoval& inner,
                           const Squeeze* rules = nullptr) noexcept;

}  // namespace clay
