#pragma once
// The same session on finer rings and at other rates: what changes of the pot and of the force.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace clay::bench {

struct Experiment {
  std::string name;
  SceneSpec scene;
  std::vector<Pose> poses;  ///< at 1 kHz
};

/// Strokes that between them touch, push, open, and pass the rim.
std::vector<Experiment> convergence_experiments();

/// The scene's lump in `factor` times as many rings.
SceneSpec refined(SceneSpec scene, std::size_t factor);
/// The same way of the tool, a pose every `period_us`: straight between the poses.
std::vector<Pose> resampled(const std::vector<Pose>& poses, std::int64_t period_us);

struct Played {
  ClayStack stack;
  std::vector<std::int64_t> time_us;
  std::vector<glm::dvec3> force_n;
};
Played played(const SceneSpec& scene, const std::vector<Pose>& poses);

/// Of R(y) and r(y), over the height that both have.
struct ProfileDifference {
  double rms_mm = 0.0;
  /// Greatest distance of a point of one section's outline from the other's (Hausdorff): where a
  /// radius jumps, as at the floor, R(y) - R'(y) says how high the jump is, not how far it moved.
  double outline_mm = 0.0;
  double height_mm = 0.0;  ///< signed
};
ProfileDifference profile_difference(const ClayStack& stack, const ClayStack& reference);

/// Of the force vectors at the times that both have, relative to the reference's largest.
struct ForceDifference {
  double rms_percent = 0.0, most_percent = 0.0, largest_n = 0.0;
};
ForceDifference force_difference(const Played& run, const Played& reference);

/// A rib leaps `leap_mm` deep into a cylinder and stands: until it is the yield depth from its
/// surface the wall w decays as w e^(-kappa t), from there as the logistic curve that ends there.
/// The force is K' L times what is left of the depth.
struct StandingRib {
  SceneSpec scene;
  std::vector<Pose> poses;
  double leap_mm = 0.0;
  [[nodiscard]] double wall_mm(double t_s) const;
  [[nodiscard]] double force_n(double t_s) const;  ///< at the end of the tick
};
StandingRib standing_rib(double ring_height_mm, double rate_hz);

}  // namespace clay::bench
