#pragma once
// The entities of a DXF drawing as lines of points.

#include "app/import/dxf_groups.hpp"
#include "app/import/readers.hpp"

#include <glm/mat2x2.hpp>
#include <optional>

namespace clay::importing {

/// Transform from the coordinates of an entity to those of the page: in mm, with all insertions.
struct DxfPlacement {
  glm::dmat2 turn{1.0};
  glm::dvec2 shift{0.0};

  [[nodiscard]] glm::dvec2 at(glm::dvec2 p) const { return turn * p + shift; }
  [[nodiscard]] glm::dvec2 along(glm::dvec2 v) const { return turn * v; }
  /// First `inner`, then this.
  [[nodiscard]] DxfPlacement after(const DxfPlacement& inner) const {
    return {turn * inner.turn, at(inner.shift)};
  }
};

/// The plane of an entity, by its extrusion direction: seen from above, or from below, which
/// mirrors it. Refuses other directions, which no drawing of a section has.
Result<DxfPlacement> dxf_plane(const DxfEntity& entity, const std::string& name);

/// The line that an entity draws; empty for kinds that draw no outline, such as texts, dimensions
/// and construction lines. Reads LINE, LWPOLYLINE, POLYLINE with the vertices that follow in
/// `groups`, ARC, CIRCLE, ELLIPSE and SPLINE.
Result<std::optional<Line>> dxf_line(const DxfEntity& entity, DxfGroups& groups,
                                     const DxfPlacement& placement, PointLimits& limits,
                                     const std::string& name);

/// The number of the first group with `code`, or `otherwise`.
Result<double> dxf_value(const DxfEntity& entity, int code, double otherwise,
                         const std::string& name);
Result<long> dxf_count(const DxfEntity& entity, int code, long otherwise, const std::string& name);

}  // namespace clay::importing
