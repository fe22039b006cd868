#pragma once
// The simulated arm on a wall or on clay, tick by tick: the energy balance of the loop and its
// limit cycles.

#include "app/bench/closed_loop/surfaces.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/falcon/sim.hpp"

#include <functional>

namespace clay::closed_loop {

struct Experiment {
  falcon::ArmSettings arm;
  falcon::HandSettings hand;
  glm::dvec3 start_mm{0.0};
  double seconds = 2.0;
  double settled_s = 0.5;   ///< length of the last part of the run, which is searched for a cycle
  bool controlled = false;  ///< with the passivity controller
  /// The point that the hand aims at, at a time [s]; empty: the start.
  std::function<glm::dvec3(double time_s)> intended;
};

/// Energy that the loop injects between two instants: the work of the displayed force on the arm,
/// minus the energy released by the surface's spring, minus the energy absorbed by the arm's
/// damping. By the arm's energy balance this equals the gain in kinetic and stored energy minus the
/// hand's work.
struct Outcome {
  double swing_mm = 0.0;     ///< peak to peak of x about its trend, in the settled part
  double injected_mj = 0.0;  ///< over the whole run
  double tolerance_mj =
      0.0;         ///< of injected_mj: half an encoder step of force times the path in contact
  int cycles = 0;  ///< from one deepest point to the next
  double mean_cycle_mj = 0.0;   ///< mean per cycle, minus its tolerance
  double worst_cycle_mj = 0.0;  ///< maximum per cycle, minus its tolerance
  double settled_mw = 0.0;      ///< mean power injected in the settled part
  double settled_tolerance_mw = 0.0;
  double final_force_n = 0.0;
  falcon::PassivityState state = falcon::PassivityState::watching;
};

Outcome run(const Experiment& experiment, Surface& surface);

/// A hand that pushes into a wall with 0.5 N, from 1 mm in front of it, until stable swings have
/// decayed.
Experiment wall_experiment(const falcon::SampledLoop& loop, double stiffness_n_per_mm,
                           double step_mm);
/// A hand that rests on a wall with 0.5 N, 10 % off balance, for about twenty swings; exact
/// encoders.
Experiment energy_experiment(const falcon::SampledLoop& loop, double stiffness_n_per_mm);
/// A potter's stroke: a hand of 0.2 N/mm that enters the clay at 3 mm/s, for 5 s.
Experiment clay_experiment(const falcon::SampledLoop& loop, double step_mm);

/// The guaranteed bound: no limit cycle above this, peak to peak.
inline constexpr double kMostSwingMm = 0.2;
/// The Falcon's encoders, in the middle of its workspace.
inline constexpr double kFalconStepMm = 0.05;

/// Stiffness [N/mm] at which a linear wall, held from both sides, changes from decay to growth:
/// bisected on the growth of a free swing, to the relative `tolerance`.
double measured_stable_stiffness(const falcon::SampledLoop& loop, double tolerance);

/// Damping [N s/mm] at which a forced motion of one frequency, linear between its samples, absorbs
/// as much energy from the hand as it returns: the requirement of passivity at that frequency. The
/// motion repeats after `samples` ticks, in which it swings `waves` times; waves <= samples / 2.
double measured_passive_damping(const falcon::SampledLoop& loop, const falcon::VirtualWall& wall,
                                int waves, int samples);

}  // namespace clay::closed_loop
