#pragma once
// Limit analysis of a part above clay that yields at one pressure. A velocity gains power from the
// weight and costs the threshold times the volume of clay that the part's surface sweeps. Either
// some velocity has positive net power, or the part rests: then pressures from 0 to the threshold
// exist that carry it.

#include "claystack/engine/clay.hpp"
#include "engine/collapse/fallen_body.hpp"

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace clay {

/// (velocity of the centre of mass, angular velocity times the radius of gyration) [mm/s]: the
/// squared length is twice the kinetic energy over the mass.
using Twist = glm::dvec3;

class YieldPower {
 public:
  YieldPower(const ClayStack& stack, std::size_t failed_ring, const FallenBody& body,
             double weight_n, double threshold_kpa);

  /// Finds the surface of the part that lies in the standing clay, or on it.
  void place(const PlanePose& pose);

  /// Net power over the weight [mm/s].
  [[nodiscard]] double net(const Twist& twist) const noexcept;
  /// Power spent on the standing clay over the weight [mm/s].
  [[nodiscard]] double plastic(const Twist& twist) const noexcept;

  /// The initial motion of the released part: the twist whose net power is largest for its kinetic
  /// energy, to within a factor of 2. Zero if the part rests: no twist of kinetic energy m/2 has a
  /// net power above kRest times the weight.
  [[nodiscard]] Twist steepest() const noexcept;

  static constexpr double kRest = 1e-6;

 private:
  struct Touch {
    Twist unit_push;     ///< power of a unit force along the normal = product with the twist
    double share = 0.0;  ///< largest force divided by the weight
  };

  void place(const SurfaceStrip& strip, glm::dvec2 centre_mm, glm::dvec2 turn);
  [[nodiscard]] bool in_clay(glm::dvec2 place_mm, double depth2_mm2) const noexcept;
  [[nodiscard]] Twist support(const Twist& direction) const noexcept;

  const ClayStack& stack_;
  std::size_t failed_;
  const FallenBody& body_;
  double share_per_mm2_;
  double top_mm_;  ///< of the failed ring, with a margin for rounding
  std::vector<Touch> touches_;
};

}  // namespace clay
