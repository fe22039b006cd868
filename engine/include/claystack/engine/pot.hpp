#pragma once
// A finished (or half finished) pot as a value: what a session leaves on the wheel.

#include "claystack/engine/clay_stack.hpp"
#include "claystack/engine/ledger.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

namespace clay {

/// A collapse (paper, section 7): the rings above `failed_ring` moved as one rigid body in the
/// upright plane through the pot's axis and `pivot_mm`, the HIP when it happened: first
/// turned about a horizontal axis through the pivot, then shifted (FallenPlace).
struct Collapse {
  std::size_t failed_ring = 0;  ///< index of the ring that yielded; it stays below
  glm::dvec3 pivot_mm{0.0};
  glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit, horizontal; right-handed turn
  double angle_rad = 0.0;          ///< within a full turn either way
  double stress_kpa = 0.0;         ///< at the failed ring
  glm::dvec3 shift_mm{0.0};
  double threshold_kpa = 0.0;    ///< the stress that the clay bears; 0: not known
  double energy_lost_mj = 0.0;   ///< potential energy, by the upper part
  double plastic_work_mj = 0.0;  ///< of that, spent on the lower clay; the rest was damped
  friend bool operator==(const Collapse&, const Collapse&) = default;
};

/// Of a pot whose radii are whole multiples of a precision: rounded_pot.
struct Rounding {
  double to_mm = 0.0;           ///< the precision
  WideQuanta exact_volume = 0;  ///< clay in the stack before it was rounded, normalised quanta
  friend bool operator==(const Rounding&, const Rounding&) = default;
};

/// What clay at the crown's height has received more than the top ring did since it grew, outside
/// and inside [quanta]. A copy of the top ring would be what the rim was a ring lower.
struct Rim {
  WideQuanta outside = 0, inside = 0;
  friend bool operator==(const Rim&, const Rim&) = default;
};

/// When collapsed, `stack` still holds all rings in their order: 0..failed_ring stand,
/// the others (and the crown) are turned by `collapse`.
struct Pot {
  ClayStack stack;
  Ledger ledger;
  Model model = Model::conserving;
  double density_g_cm3 = 1.9;
  std::optional<Collapse> collapse;
  std::optional<Rounding> rounding;
  Rim rim{};  ///< for who throws on; of the paper's model none
  friend bool operator==(const Pot&, const Pot&) = default;
};

}  // namespace clay
