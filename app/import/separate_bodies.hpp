#pragma once
#include "claystack/export/solid.hpp"

#include <cstddef>

namespace clay::importing {

/// The number of bodies whose boxes do not touch each other, as of two cups side by side. Connected
/// parts with boxes that touch count as one body, as a cup and its handle. 1 for a mesh of more
/// than 1,000 connected parts, which is a scan or a soup.
[[nodiscard]] std::size_t separate_bodies(const solid::TriangleMesh& mesh);

}  // namespace clay::importing
