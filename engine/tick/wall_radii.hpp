#pragma once
// Radii of the rings about a contact, measured once in a part of a tick for all clay rules.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <vector>

namespace clay {

/// Some neighbouring rings as a part of a tick finds them, to single precision: these lengths
/// decide the motion of clay, not its volume. Storage is reserved once. [mm]
class WallRadii {
 public:
  /// Room for all rings that the rules reach from a contact with the tool.
  void reserve(const Tool& tool, const ClayStack& stack);
  /// Forgets all rings. Those measured next lie about the contact with this ring.
  void begin(std::size_t ring) noexcept;
  /// Measures those of the rings first..end-1 that are not known yet.
  void cover(const ClayStack& stack, std::size_t first, std::size_t end) noexcept;

  /// R, r and R - r of a covered ring and, in order, of those above it. Packs that begin in a
  /// covered ring can be read.
  [[nodiscard]] const float* outer(std::size_t ring) const noexcept { return &outer_[row(ring)]; }
  [[nodiscard]] const float* inner(std::size_t ring) const noexcept { return &inner_[row(ring)]; }
  [[nodiscard]] const float* thickness(std::size_t ring) const noexcept {
    return &thickness_[row(ring)];
  }

  /// Notes that clay was laid on a covered ring. The bore stays as it was measured.
  void thicken(std::size_t ring, double outside_mm, double inside_mm) noexcept {
    outer_[row(ring)] += static_cast<float>(outside_mm);
    thickness_[row(ring)] += static_cast<float>(outside_mm + inside_mm);
  }

  /// Number of rings over which a slope is measured: 0.17 mm, or one ring if that is more. Over
  /// less, the limit of the slope would depend on the height of rings. All rows can be read for
  /// as many rings below and above the covered ones. Beyond an end of the stack they are those of
  /// the end ring.
  [[nodiscard]] std::size_t apart() const noexcept { return apart_; }

 private:
  [[nodiscard]] std::size_t row(std::size_t ring) const noexcept {
    return ring + before_ - origin_;
  }
  void measure(const ClayStack& stack, std::size_t first, std::size_t end) noexcept;

  std::vector<float> outer_, inner_, thickness_;
  std::size_t half_ = 0;    ///< rings below and above the one of `begin`
  std::size_t before_ = 0;  ///< rows before the first ring
  std::size_t apart_ = 1, origin_ = 0;
  std::size_t from_ = 0, to_ = 0;  ///< rings that are known
};

}  // namespace clay
