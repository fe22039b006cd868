#pragma once
// The simulated arm against a wall or the clay, tick by tick: what the loop does with energy, and
// whether it comes to rest.

#include "app/bench/closed_loop/surfaces.hpp"
#include "claystack/falcon/passivity.hpp"
#include "claystack/falcon/sim.hpp"

#include <functional>

namespace clay::closed_loop {

struct Experiment {
  falcon::ArmSpec arm;
  falcon::HandSpec hand;
  glm::dvec3 start_m{0.0};
  double seconds = 2.0;
  double settled_s = 0.5;   ///< the end of the run, in which a cycle is looked for
  bool controlled = false;  ///< with the passivity controller
  /// Where the hand means to be at a time [s]; absent: where it began.
  std::function<glm::dvec3(double time_s)> intended;
};

/// Energy that the loop injects between two instants: the work that the displayed force did on the
/// arm, less what the surface's spring gave from its store, less what the arm's own damping took.
/// By the arm's balance this is the gain in kinetic and stored energy, less the hand's work.
struct Outcome {
  double swing_m = 0.0;        ///< peak to peak of x about its trend, in the settled part
  double injected_j = 0.0;     ///< over the whole run
  double tolerance_j = 0.0;    ///< of that: half an encoder step of force along the way in contact
  int cycles = 0;              ///< from one deepest point to the next
  double mean_cycle_j = 0.0;   ///< injected in them, less its tolerance
  double worst_cycle_j = 0.0;  ///< most injected in one of them, less its tolerance
  double settled_w = 0.0;      ///< mean power injected in the settled part
  double settled_tolerance_w = 0.0;
  double final_force_n = 0.0;
  falcon::PassivityState state = falcon::PassivityState::watching;
};

Outcome run(const Experiment& experiment, Surface& surface);

/// A hand that pushes 0.5 N into a wall, from 1 mm before it, until a swing that can die has died.
Experiment wall_experiment(const falcon::SampledLoop& loop, double stiffness_n_per_m,
                           double step_m);
/// A hand that rests 0.5 N on a wall, a tenth off balance, for some twenty swings; exact encoders.
Experiment energy_experiment(const falcon::SampledLoop& loop, double stiffness_n_per_m);
/// A potter's stroke: a hand of 200 N/m that goes into the clay at 3 mm/s, for 5 s.
Experiment clay_experiment(const falcon::SampledLoop& loop, double step_m);

/// What the user is promised: no limit cycle above this, peak to peak.
inline constexpr double kMostSwingM = 2e-4;
/// The Falcon's encoders, in the middle of its workspace.
inline constexpr double kFalconStepM = 5e-5;

/// Stiffness [N/m] where a linear wall, held from both sides, turns from decay to growth: bisected
/// on the growth of a free swing, to `tolerance` of it.
double measured_stable_stiffness(const falcon::SampledLoop& loop, double tolerance);

/// Damping [N s/m] at which a forced motion of one frequency, linear between its samples, takes as
/// much energy from the hand as it gives: what passivity asks of the arm there. The motion repeats
/// after `samples` ticks, in which it swings `waves` times; waves <= samples / 2.
double measured_passive_damping(const falcon::SampledLoop& loop, const falcon::VirtualWall& wall,
                                int waves, int samples);

}  // namespace clay::closed_loop
