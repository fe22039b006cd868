#pragma once
// A drawing as the right half of a pot's section: where between the axis and the outermost line
// there is clay, at each height. The clay is what lies within the lines by the even-odd rule.

#include "app/import/drawing.hpp"

#include <optional>
#include <string>
#include <vector>

namespace clay::importing {

/// Where the pot's axis is in the drawing.
enum class AxisRule {
  by_itself,  ///< the file's own zero where it has one; the middle of what is the same on both
              ///< sides; otherwise the left end
  left,       ///< the left end of the drawing
  middle,     ///< the middle between its ends; what is left of it is not read
  at,         ///< HalfSectionSettings::axis_mm
};

struct HalfSectionSettings {
  AxisRule axis = AxisRule::by_itself;
  double axis_mm = 0.0;             ///< in the drawing's own coordinates, to the right
  std::optional<double> height_mm;  ///< the drawing is scaled to this height; absent: as it is
};

/// From one height to a higher one both bounds of the clay are straight.
struct Slab {
  double from_mm = 0.0, to_mm = 0.0;              ///< heights, from the foot
  double outer_from_mm = 0.0, outer_to_mm = 0.0;  ///< radii of the outer bound
  double inner_from_mm = 0.0, inner_to_mm = 0.0;  ///< of the bore; 0: solid to the axis
};

struct HalfSection {
  std::vector<Slab> slabs;  ///< bottom to top, without a gap
  double height_mm = 0.0;
  double axis_mm = 0.0;  ///< in the drawing's coordinates, before it was scaled
  AxisRule axis = AxisRule::left;

  [[nodiscard]] double volume_mm3() const noexcept;  ///< of the solid of revolution
};

/// Lines that end within 0.01 mm of each other are joined. Of lines left open, one whose ends are
/// both on the axis is closed along it, and a single other one is taken for the outside of a solid
/// pot. Refuses, naming the place, open ends, clay in two places at one height (a ring has one),
/// heights without clay, and outlines that cross themselves.
Result<HalfSection> half_section(Drawing drawing, const HalfSectionSettings& settings,
                                 const std::string& name);

}  // namespace clay::importing
