#pragma once
// The surfaces of the closed-loop experiments. The arm presses along x, from x > 0.

#include "claystack/engine/scene.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

namespace clay::closed_loop {

class Surface {
 public:
  virtual ~Surface() = default;
  /// The force [N] for a reading.
  virtual glm::dvec3 press(std::int64_t time_us, const glm::dvec3& reading_mm) = 0;
  /// Energy [mJ] stored in the spring with the arm at this position.
  [[nodiscard]] virtual double stored_mj(const glm::dvec3& position_mm) const = 0;
  [[nodiscard]] virtual double stiffness_n_per_mm() const = 0;
  /// Current position of the undeformed surface [mm].
  [[nodiscard]] virtual double face_mm() const = 0;
};

struct WallSpec {
  double stiffness_n_per_mm = 0.0;
  double limit_n = 5.0;   ///< of the force; infinite for a linear wall
  bool one_sided = true;  ///< false: a two-sided spring to x = 0
};
std::unique_ptr<Surface> make_wall(const WallSpec& wall);

struct PressedClay {
  double stiffness_n_per_mm = 0.0;  ///< of the whole contact: K' times its height
  double rate_per_s = 20.0;         ///< of removal; 0: the clay is a spring
  double rib_height_mm = 20.0;
  double wall_mm = 0.0;  ///< of a hollow cylinder; 0: solid
  bool rules = false;    ///< with all clay rules
};
/// A cylinder of 45 mm radius under a vertical rib. The height of contact is the rib's.
SceneSpec clay_scene(const PressedClay& clay);
/// Expects a scene that Wheel::build accepts.
std::unique_ptr<Surface> make_clay(const PressedClay& clay);

}  // namespace clay::closed_loop
