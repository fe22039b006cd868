#pragma once
// One stroke of a potter, played by the engine and by the paper as printed, at any fineness: what
// it leaves and what it makes felt, to be held against a finer one.

#include "app/bench/literal/literal_paper.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::bench {

inline constexpr double kStrokeS = 2.4;

/// Ticks of the stroke, without the first, which only says where the tool is.
[[nodiscard]] int ticks_of(int rate_hz);

/// A ball comes in from outside, presses a hollow cylinder of 150 mm at a third of its height,
/// pulls up the wall and goes out again; smooth in time.
[[nodiscard]] glm::dvec3 stroke_mm(double time_s);

struct Fineness {
  std::size_t rings = 200;
  int rate_hz = 1000;
  double reach_mm = 30.0;
};
[[nodiscard]] SceneSpec stroke_scene(const Fineness& fineness, Model model);

/// What is left of a stroke, at places and times that all finenesses have in common.
struct Outcome {
  std::vector<double> outer_mm, inner_mm;  ///< radii over height, between the centres of rings
  std::vector<glm::dvec3> force_n;         ///< every 8 ms
  double volume_error = 0.0;               ///< of the body, relative; the worst on the way
  bool collapsed = false;
};

[[nodiscard]] Outcome play_engine(const Fineness& fineness, Model model);
[[nodiscard]] Outcome play_literal(const Fineness& fineness);
/// Seconds of the same ticks when nothing is written down between them.
[[nodiscard]] double time_engine(const Fineness& fineness, Model model);
[[nodiscard]] double time_literal(const Fineness& fineness);

/// Over both surfaces, and of the length of the force's difference. The ball leaves a ledge, a jump
/// of the profile: there the largest error cannot fall below half the jump, the mean one can.
struct Deviation {
  double profile_max_mm = 0.0, profile_mean_mm = 0.0;
  double force_max_n = 0.0, force_rms_n = 0.0;
};
[[nodiscard]] Deviation deviation(const Outcome& outcome, const Outcome& reference);

}  // namespace clay::bench
