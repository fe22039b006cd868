#pragma once
// A drawing as the right half of a pot's section: the clay between the axis and the outermost line
// at each height. Clay is the inside of the lines by the even-odd rule.

#include "app/import/drawing.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::importing {

/// Place of the pot's axis in the drawing: as requested, or, in a HalfSection, as found.
enum class AxisRule {
  by_itself,  ///< only in a request: the file's zero if it has one, which gives `at`; otherwise the
              ///< first that fits of `line`, `middle`, `right` and `left`
  left,       ///< the left end of the drawing; by itself: if no other rule applies
  middle,     ///< the middle between its ends; by itself: the mirror line of a symmetric drawing.
              ///< The left half is ignored
  at,         ///< HalfSectionSettings::axis_mm
  right,      ///< the right end; by itself: a straight edge of outlines drawn left of it
  line,       ///< only found: a straight vertical line that no other line meets at its ends
};

struct HalfSectionSettings {
  AxisRule axis = AxisRule::by_itself;
  double axis_mm = 0.0;             ///< in the drawing's x coordinate
  std::optional<double> height_mm;  ///< scales the drawing to this height; empty: no scaling
};

/// A range of heights in which both bounds of the clay are straight.
struct Slab {
  double from_mm = 0.0, to_mm = 0.0;              ///< heights, from the foot
  double outer_from_mm = 0.0, outer_to_mm = 0.0;  ///< radii of the outer bound
  double inner_from_mm = 0.0, inner_to_mm = 0.0;  ///< radii of the bore; 0: solid to the axis
};

struct HalfSection {
  std::vector<Slab> slabs;  ///< bottom to top, without gaps
  double height_mm = 0.0;
  double axis_mm = 0.0;  ///< in the drawing's coordinates, before scaling
  AxisRule axis = AxisRule::left;
  std::vector<std::string> notes;  ///< of the drawing, and of its parts that are not used

  [[nodiscard]] double volume_mm3() const noexcept;  ///< of the solid of revolution
};

/// Floors, feet and rims may rise by this much where rings need level ones.
inline constexpr double kLevelWithinMm = 0.02;

/// Joins lines whose ends are within 0.01 mm of each other, in the lengths of the drawing as it was
/// read: read_half_section reads it in those of the pot. Of the lines left open, one with both
/// ends on the axis is closed along it, and a single other one is used as the outside of a solid
/// pot. Outlines that lie wholly left of the axis are mirrored. Refuses, naming the place, open
/// ends, clay in two places at one height (a ring has one), heights without clay, and
/// self-intersecting outlines.
Result<HalfSection> half_section(Drawing drawing, const HalfSectionSettings& settings,
                                 const std::string& name);

/// Reads a drawing, and its half section. With a height, the drawing is read in the scale of the
/// pot, so that chords (kFlatMm) and the 0.01 mm for ends and the axis are lengths of the pot: a
/// drawing in metres gives the pot of the same drawing in mm. For that scale, everything in the
/// drawing counts, such as an axis line that is longer than the outline; the pot has the height
/// exactly.
Result<HalfSection> read_half_section(std::string_view bytes, const std::string& name,
                                      const std::string& layer,
                                      const HalfSectionSettings& settings);

}  // namespace clay::importing
