#pragma once
// The visible parts of an SVG drawing, as a plain drawing: groups and shapes with their geometry
// alone.

#include "app/import/svg_copy.hpp"
#include "claystack/core/result.hpp"

#include <string>
#include <vector>

namespace clay::importing {

struct SvgShapes {
  XmlDocument document;
  std::vector<std::string> notes;  ///< clip paths and masks, which are not applied
  bool unit_stated = false;        ///< a length has a unit such as mm; px is none on paper
};

/// Copies the shapes that are drawn: `use` and `symbol` become groups, style sheets and style
/// attributes are applied, and elements that are not displayed, not visible, of opacity 0, or
/// painted with neither fill nor stroke are left out, as are layers named "construction". `layer`:
/// the label or id of the only layer to copy; empty: all. Each transform is on a separate group, so
/// that it is known before the shape.
Result<SvgShapes> svg_shapes(xmlDoc& drawing, const std::string& layer, const std::string& name);

}  // namespace clay::importing
