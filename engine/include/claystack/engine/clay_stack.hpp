#pragma once
// The clay: a stack of coaxial rings of one height, and a crown on top.

#include "claystack/engine/quanta.hpp"
#include "claystack/engine/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace clay {

/// One cylindrical element (paper, section 2). 0 <= inner2 < outer2, in quanta of 2^-36 mm^2.
struct Ring {
  Quanta outer2 = 0;  ///< squared outer radius R^2
  Quanta inner2 = 0;  ///< squared inner radius r^2; 0 where there is no bore

  [[nodiscard]] Quanta volume() const noexcept {
    return outer2 - inner2;
  }  ///< normalised: V / (pi h)
  [[nodiscard]] double outer_mm() const noexcept { return radius_from_quanta(outer2); }
  [[nodiscard]] double inner_mm() const noexcept { return radius_from_quanta(inner2); }
  friend bool operator==(const Ring&, const Ring&) = default;
};

/// Rings 0..N-1 from the wheel up (the paper's 1..N). Ring i spans the heights
/// [i h, (i+1) h] in mm above the wheel head; the axis is y. The crown is a last
/// ring of fractional height with the radii of ring N-1: clay too little for a
/// whole ring, counted in normalised quanta like a ring's volume.
///
/// Reading is public; only redistribution writes (StackWriter, private to the engine).
class ClayStack {
 public:
  ClayStack() = default;

  /// `count` equal rings. Refuses N outside [1, 2^24], heights outside [1e-3, 1e3] mm and
  /// radii outside 0 <= r < R, 1e-3 <= R <= 5000 mm.
  static Result<ClayStack> cylinder(std::size_t count, double ring_height_mm, double outer_mm,
                                    double inner_mm, std::size_t max_rings);

  /// Any valid rings, as read from a file. Same limits; the message names the ring.
  static Result<ClayStack> from_rings(double ring_height_mm, std::vector<Ring> rings,
                                      WideQuanta crown, std::size_t max_rings = kMaxRings);

  [[nodiscard]] std::span<const Ring> rings() const noexcept { return rings_; }
  [[nodiscard]] std::size_t size() const noexcept { return rings_.size(); }
  [[nodiscard]] std::size_t max_rings() const noexcept { return max_rings_; }
  [[nodiscard]] double ring_height_mm() const noexcept { return ring_height_mm_; }
  [[nodiscard]] WideQuanta crown() const noexcept { return crown_; }
  [[nodiscard]] double crown_height_mm() const noexcept;
  [[nodiscard]] double height_mm() const noexcept;  ///< with the crown

  /// Rings and crown, kept up to date by every transfer: O(1). Normalised quanta.
  [[nodiscard]] WideQuanta volume() const noexcept { return rings_volume_ + crown_; }
  /// The same counted afresh: O(N). The two are equal, or the engine is broken.
  [[nodiscard]] WideQuanta recount() const noexcept;
  [[nodiscard]] double mm3_per_quantum() const noexcept;  ///< pi h 2^-36
  [[nodiscard]] double volume_mm3() const noexcept;

  /// Some ring has a bore (r > 0). While false, no clay can flow inward.
  [[nodiscard]] bool hollow() const noexcept { return bores_ > 0; }

  friend bool operator==(const ClayStack&, const ClayStack&) = default;

 private:
  friend class StackWriter;

  std::vector<Ring> rings_;
  double ring_height_mm_ = 1.0;
  std::size_t max_rings_ = kMaxRings;
  WideQuanta crown_ = 0;
  WideQuanta rings_volume_ = 0;
  std::size_t bores_ = 0;  ///< rings with r > 0
};

}  // namespace clay
