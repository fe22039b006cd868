#pragma once
#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "engine/tick/touched_rings.hpp"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace clay {

enum class Side { compressive, expansive };

/// Place of the hand, relative to the tool that it holds.
enum class HandAt { unknown, above, below };

/// The rings that the tool touches (section 4). `rings` are some of bottom..top; none when there is
/// no contact. Storage is reserved once, so that a tick allocates nothing.
///
/// `conserving` resolves the tool's ends to a fraction of a ring: `edges` are parts of rings whose
/// middles lie beyond an end, and the crown. They push back, but yield only as whole rings do; see
/// front.hpp.
struct Contact {
  Side side = Side::compressive;
  std::size_t bottom = 0;  ///< candidate range by (1), (2), counted from 0
  std::size_t top = 0;
  /// Extra distance from the tool's end to the rings below `bottom` and above `top`, in ring
  /// heights; the kernel's table assumes that the end lies in the middle of its ring.
  double down_offset = 0.0, up_offset = 0.0;
  double axis_distance_mm = 0.0;  ///< d
  double approach_mm = 0.0;       ///< of the tool's axis to the wall, since the last pose
  double rise_mm = 0.0;           ///< of the tool since then
  double radial_x = 0.0;          ///< cos psi; (0, 0) on the axis, where there is no direction
  double radial_z = 0.0;          ///< sin psi
  TouchedRings rings;
  std::array<RingContact, 3> edges;
  std::array<int, 3> edge_end{};  ///< +1 at the tool's upper end, -1 at its lower one, 0 at neither
  std::size_t edge_count = 0;
  /// Behind the leading end; see front.hpp. Here `coverage` is the height of a piece in rings.
  std::array<RingContact, 4> front;
  bool has_front = false;
  /// Of the tool's lower and upper end, where they lie in the clay: (depth cos theta)^2 [mm^2]. The
  /// force needs it where a tool ends with a flat face, as a rib does; see front.hpp.
  std::array<double, 2> end_depth2{};
};

[[nodiscard]] inline double wall_mm(const Ring& ring) noexcept {
  return ring.outer_mm() - ring.inner_mm();
}

/// The depth in the ring of a tool with radius f at its height.
[[nodiscard]] inline double depth_of(const Ring& ring, double f, const Contact& contact) noexcept {
  return contact.side == Side::compressive ? ring.outer_mm() + f - contact.axis_distance_mm
                                           : contact.axis_distance_mm + f - ring.inner_mm();
}

/// Rings the tool can touch at once, for reserving.
[[nodiscard]] std::size_t most_contacts(const Tool& tool, double ring_height_mm,
                                        std::size_t max_rings);

/// Two stages: candidates by height, equations (1) and (2); then each ring by its radii. The side
/// is decided once, at the tool's centre, by the demarcating circle r_d = (R + r) / 2.
/// The paper puts y = 0 at the centroid of the first ring, this code at the wheel head, h/2 below.
/// `moved_mm`: of the HIP since the last pose, for `conserving`.
/// `paper` takes (2) as printed, which is a ring more than the tool reaches; `conserving` ends the
/// range with the rings that the tool's ends lie in.
/// `hand`, of the clay rules: a centre in solid clay, such as the floor below a bore, is on the
/// side of the bore on the way to the hand. A centre beside the solid clay is outside.
template <Model model = Model::conserving>
void find_contact(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm,
                  Contact& contact, const glm::dvec3& moved_mm = glm::dvec3(0.0),
                  HandAt hand = HandAt::unknown) noexcept;

/// Both tools of a pinch, at the HIP's height and along its radius: at their widest they reach
/// d + gap/2 from outside and d - gap/2 from inside, so their centres are gap/2 + max f from the
/// HIP. The sides are given, not found. An inner tool that is wider than the bore stands beyond
/// the axis: its distance is counted as any other, its direction is the opposite one. A tool that
/// is clear of a ring, the outer one within its bore (d + f <= r), the inner one beyond its outside
/// (d - f >= R), does not touch it. Both contacts have the same candidate range.
template <Model model = Model::conserving>
void find_pinch(const Tool& tool, const ClayStack& stack, const glm::dvec3& hip_mm, double gap_mm,
                Contact& outer, Contact& inner,
                const glm::dvec3& moved_mm = glm::dvec3(0.0)) noexcept;

}  // namespace clay
