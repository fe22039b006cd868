#pragma once
// Heights and distances from the axis that the drawing of a standing pot states.

#include "claystack/export/section.hpp"

#include <array>

namespace clay::solid::inline job {

/// Of a section whose foot is at height 0. A piece that stands on another has no part in bore and
/// floor: they are those of the topmost piece.
class SectionMeasures {
 public:
  explicit SectionMeasures(const Profile& profile);

  [[nodiscard]] double radius_mm() const noexcept { return radius_mm_; }  ///< the largest
  [[nodiscard]] double top_mm() const noexcept { return top_mm_; }
  /// Height of the largest radius.
  [[nodiscard]] double widest_at_mm() const;
  /// Radius of the opening at the top; 0: closed.
  [[nodiscard]] double mouth_mm() const;
  /// The highest clay on the axis.
  [[nodiscard]] double floor_mm() const;
  /// The next boundary on the axis below the floor.
  [[nodiscard]] double below_floor_mm() const;
  /// The largest radius at exactly this height.
  [[nodiscard]] double bore_at_mm(double height) const;
  /// The narrowest bore between two heights in the air above the floor.
  [[nodiscard]] double bore_between_mm(double low, double high) const;

 private:
  const Profile& profile_;
  double radius_mm_ = 0.0, top_mm_ = 0.0;
};

/// Readings of a caliper at a height of the section [mm]; the wall is level, not at right angles.
struct CaliperRow {
  double height = 0.0, outer = 0.0, bore = 0.0;  ///< diameters; no bore: 0
  [[nodiscard]] double wall() const noexcept { return 0.5 * (outer - bore); }
};

/// At the heights of 1/6 to 5/6, rounded to mm (above 12 mm of height).
[[nodiscard]] std::array<CaliperRow, 5> caliper_rows(const Profile& profile);

}  // namespace clay::solid::inline job
