#pragma once
// The section of a pot along its axis: one rigid body, or two after a collapse.

#include "claystack/engine/clay.hpp"

#include <glm/vec2.hpp>
#include <vector>

namespace clay::solid::inline section {

using Outline = std::vector<glm::dvec2>;  // (right, up) in mm, seen along the cut

/// One rigid body as the section view shows it.
struct SectionBody {
  std::vector<Outline> cut;     ///< cut faces: fill by the even-odd rule
  std::vector<Outline> beyond;  ///< the half behind the cut, with the visible bore
  Outline axis;
};

/// The pot, or its standing and fallen parts. A collapsed pot is cut in the plane of its motion,
/// with the HIP to the right.
[[nodiscard]] std::vector<SectionBody> bodies_of(const Pot& pot);

/// Outlines of the fallen part when the pot failed, and after a quarter, half and three quarters of
/// the energy was lost. Empty if the motion is unknown.
[[nodiscard]] std::vector<Outline> ghosts_of(const Pot& pot);

}  // namespace clay::solid::inline section
