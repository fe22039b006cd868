#pragma once
// One stroke, played by the engine or by the paper as printed, at any fineness: the resulting pot
// and forces, for comparison with the limit of finer runs.

#include "app/bench/literal/literal_paper.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::bench {

inline constexpr double kStrokeS = 2.4;

/// Ticks of the stroke, without the first, which only sets the tool's position.
[[nodiscard]] int ticks_of(int rate_hz);

/// A ball comes in from outside, presses a hollow cylinder of 150 mm at a third of its height,
/// pulls up the wall and moves out again; smooth in time.
[[nodiscard]] glm::dvec3 stroke_mm(double time_s);

struct Fineness {
  std::size_t rings = 200;
  int rate_hz = 1000;
  double reach_mm = 30.0;
};

/// The model that plays the stroke. `paper_scaled` is the paper's model with a stiffness per mm of
/// height and a rate per second, so that it has a limit; `paper` and `literal` keep its K per ring
/// and its k per tick.
enum class Variant { conserving, clay_rules, paper_scaled, paper, literal };

[[nodiscard]] SceneSpec stroke_scene(const Fineness& fineness, Variant variant);

/// The result of a stroke, at positions and times common to all finenesses.
struct Outcome {
  std::vector<double> outer_mm, inner_mm;  ///< radii over height, between the centres of rings
  std::vector<glm::dvec3> force_n;         ///< every 8 ms
  double volume_error = 0.0;               ///< of the body, relative; the maximum during the stroke
  bool collapsed = false;
};

[[nodiscard]] Outcome play(const Fineness& fineness, Variant variant);
/// Duration [s] of the same ticks without recording.
[[nodiscard]] double time_of(const Fineness& fineness, Variant variant);

/// The limit of finer runs, extrapolated from a run and one of half its fineness (Richardson, first
/// order).
[[nodiscard]] Outcome extrapolated(const Outcome& fine, const Outcome& half);

/// Of both surfaces, and of the force vector. The ball leaves a ledge, a jump of the profile, where
/// the maximum error cannot fall below half the jump; the mean error can.
struct Deviation {
  double profile_max_mm = 0.0, profile_mean_mm = 0.0;
  double force_max_n = 0.0, force_rms_n = 0.0;
};
[[nodiscard]] Deviation deviation(const Outcome& outcome, const Outcome& reference);

}  // namespace clay::bench
