#pragma once
// Directions around a circle.

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace clay::render {

/// Unit vectors at equal angles, counterclockwise from (1, 0). Their bits are the same with every C
/// library, because sine and cosine are not used. `count`: 4 or 12 times a power of two.
[[nodiscard]] std::vector<glm::dvec2> directions_around(std::size_t count);

}  // namespace clay::render
