#pragma once
#include "claystack/engine/clay_stack.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace clay {

enum class Side { compressive, expansive };

/// A ring that the tool overlaps.
struct RingContact {
  std::uint32_t ring = 0;
  double depth_mm = 0.0;  ///< R + f - d outside, d + f - r inside; > 0
  double slope = 0.0;     ///< f'(t)
};

/// What the tool touches (section 4). `rings` is a subset of bottom..top, ascending; empty when
/// there is no contact. Storage is reserved once, so that a tick allocates nothing.
struct Contact {
  Side side = Side::compressive;
  std::size_t bottom = 0;  ///< candidate range by (1), (2), counted from 0
  std::size_t top = 0;
  double axis_distance_mm = 0.0;  ///< d
  double radial_x = 0.0;          ///< cos psi; (0, 0) on the axis, where there is no direction
  double radial_z = 0.0;          ///< sin psi
  std::vector<RingContact> rings;
};

/// Rings the tool can touch at once, for reserving.
[[nodiscard]] std::size_t most_contacts(const Tool& tool, double ring_height_mm,
                                        std::size_t max_rings);

/// Two stages: candidates by height, equations (1) and (2); then each ring by its radii. The side
/// is decided once, at the tool's centre, by the demarcating circle r_d = (R + r) / 2.
/// The paper puts y = 0 at the centroid of the first ring, we at the wheel head h/2 below.
void find_contact(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm,
                  Contact& contact) noexcept;

/// Both tools of a pinch, at the HIP's height and along its radius: at their widest they reach
/// d + gap/2 from outside and d - gap/2 from inside, so their centres are gap/2 + max f from the
/// HIP. The sides are given, not found. An inner tool that is wider than the bore stands beyond
/// the axis: its distance is counted as any other, its direction is the opposite one. Both contacts
/// have the same candidate range.
void find_pinch(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm, double gap_mm,
                Contact& outer, Contact& inner) noexcept;

}  // namespace clay
