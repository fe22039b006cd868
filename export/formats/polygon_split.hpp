#pragma once
// The triangles of one polygon, which may have holes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::solid::inline formats {

/// `corners` are indices and `points` their places, at least 4; `area` is along the normal. At
/// first `triangles` hold the fan from the first corner. They change if, seen along the axis that
/// the normal is nearest to, the fan has a triangle without area or facing backward, or covers a
/// place twice. The predicates are exact. Returns false, with the fan kept, for a polygon without
/// area, or one that crosses or touches itself; it may pass along an edge twice, there and back, to
/// a hole.
bool split_polygon(const std::vector<std::uint32_t>& corners, const std::vector<glm::dvec3>& points,
                   const glm::dvec3& area, std::span<std::array<std::uint32_t, 3>> triangles);

/// The triangles between an outline and the holes in it, in the orientation of the area. `corners`
/// and `points` are those of all outlines, those of the holes after the outer one; `ends` has the
/// number of corners up to the end of each. Empty if the outlines cross or touch, or a hole is no
/// hole of the outer one.
std::vector<std::array<std::uint32_t, 3>> split_around_holes(
    const std::vector<std::uint32_t>& corners, const std::vector<glm::dvec3>& points,
    const std::vector<std::size_t>& ends, const glm::dvec3& area);

}  // namespace clay::solid::inline formats
