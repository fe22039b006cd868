#pragma once
// The simulated arm against a wall or the clay, tick by tick: what the loop does with energy, and
// whether it comes to rest.

#include "claystack/falcon/passivity.hpp"
#include "claystack/falcon/simulated_arm.hpp"
#include "surfaces.hpp"

#include <functional>

namespace clay::servo {

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
  double worst_cycle_j = 0.0;  ///< most injected in one of them, less its tolerance
  double settled_w = 0.0;      ///< mean power injected in the settled part
  double settled_tolerance_w = 0.0;
  double displayed_w = 0.0;  ///< the same with the arm's damping not counted
  double final_force_n = 0.0;
  falcon::PassivityState state = falcon::PassivityState::watching;
};

Outcome run(const Experiment& experiment, Surface& surface);

/// Stiffness [N/m] where a linear wall, held from both sides, turns from decay to growth: bisected
/// on the growth of a free swing, to `tolerance` of it.
double measured_stable_stiffness(const falcon::SampledLoop& loop, double tolerance);

/// Damping [N s/m] at which a forced motion of one frequency, linear between its samples, takes as
/// much energy from the hand as it gives: what passivity asks of the arm there. The motion repeats
/// after `samples` ticks, in which it swings `waves` times; waves <= samples / 2.
double measured_passive_damping(const falcon::SampledLoop& loop, const falcon::VirtualWall& wall,
                                int waves, int samples);

}  // namespace clay::servo
