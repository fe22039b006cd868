#pragma once
#include "falcon/safety/arm_response.hpp"

namespace clay::falcon::inline sim {

/// One axis: its forces, and its response over a whole period.
struct ArmAxis {
  double inertia_ns2_per_mm = 1.0;
  double damping_ns_per_mm = 0.0;
  double friction_n = 0.0;
  double hand_stiffness_n_per_mm = 0.0;
  double hand_damping_ns_per_mm = 0.0;
  double period_s = 1e-3;
  ArmResponse response;

  [[nodiscard]] bool guided() const noexcept {
    return hand_stiffness_n_per_mm > 0.0 || hand_damping_ns_per_mm > 0.0;
  }
  [[nodiscard]] ArmResponse response_over(double time_s) const noexcept {
    return arm_response((damping_ns_per_mm + hand_damping_ns_per_mm) / inertia_ns2_per_mm,
                        hand_stiffness_n_per_mm / inertia_ns2_per_mm, time_s);
  }
};

struct AxisState {
  double position_mm = 0.0;
  double velocity_mm_s = 0.0;
  double intended_mm = 0.0;  ///< position of the hand's point
  double damped_mj = 0.0;
  double rubbed_mj = 0.0;
};

/// Advances one period under a constant force, with the hand's point at constant speed.
void move(const ArmAxis& axis, double force_n, double intended_mm_s, AxisState& state) noexcept;

}  // namespace clay::falcon::inline sim
