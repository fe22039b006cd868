#pragma once
// What a knife along the axis shows of a pot: one rigid body, or two where it fell.

#include "claystack/engine/clay.hpp"

#include <glm/vec2.hpp>
#include <vector>

namespace clay::solid::inline section {

using Outline = std::vector<glm::dvec2>;  // (right, up) in mm, seen along the cut

/// One rigid body as the section view shows it.
struct SectionBody {
  std::vector<Outline> cut;     ///< the clay that the knife met: fill by the even-odd rule
  std::vector<Outline> beyond;  ///< the half behind, whose bore shows
  Outline axis;
};

/// The pot, or what stands and what fell. A fall is cut in its own plane, the HIP to the right.
[[nodiscard]] std::vector<SectionBody> bodies_of(const Pot& pot);

/// Where the fallen part was as the pot failed, and when the first, the second and the third
/// quarter of the energy was lost: outlines. None where the fall is not known.
[[nodiscard]] std::vector<Outline> ghosts_of(const Pot& pot);

}  // namespace clay::solid::inline section
