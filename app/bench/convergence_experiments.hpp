#pragma once
// The same session on finer rings and at other rates: the change of the pot and of the force.

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

/// Strokes that together touch, push, open, and cross the rim.
std::vector<Experiment> convergence_experiments();

/// The scene's lump with `factor` times as many rings.
SceneSpec refined(SceneSpec scene, std::size_t factor);
/// The same path with a pose every `period_us`, linear between the poses.
std::vector<Pose> resampled(const std::vector<Pose>& poses, std::int64_t period_us);

struct Played {
  ClayStack stack;
  std::vector<std::int64_t> time_us;
  std::vector<glm::dvec3> force_n;
};
Played played(const SceneSpec& scene, const std::vector<Pose>& poses);

/// Differences of R(y) and r(y), over the common height.
struct ProfileDifference {
  double rms_mm = 0.0;
  /// Maximum distance of a point of one outline from the other (Hausdorff). Where a radius jumps,
  /// as at the floor, R(y) - R'(y) gives the size of the jump, not its displacement.
  double outline_mm = 0.0;
  double height_mm = 0.0;  ///< signed
};
ProfileDifference profile_difference(const ClayStack& stack, const ClayStack& reference);

/// Differences of the force vectors at common times, relative to the reference's maximum.
struct ForceDifference {
  double rms_percent = 0.0, most_percent = 0.0, largest_n = 0.0;
};
ForceDifference force_difference(const Played& run, const Played& reference);

/// A rib jumps `jump_mm` deep into a cylinder and rests there. The wall w decays as w e^(-kappa t)
/// until the remaining depth is the yield depth, then on the logistic curve. The force is K' L
/// times the remaining depth.
struct RestingRib {
  SceneSpec scene;
  std::vector<Pose> poses;
  double jump_mm = 0.0;
  [[nodiscard]] double wall_mm(double t_s) const;
  [[nodiscard]] double force_n(double t_s) const;  ///< at the end of the tick
};
RestingRib resting_rib(double ring_height_mm, double rate_hz);

}  // namespace clay::bench
