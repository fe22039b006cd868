#pragma once
// The paper's equations as they are printed, in floating point and without a guard: the yardstick
// of speed, and the proof that the extreme suite can fail. Not for use.

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::bench {

/// Settings in the paper's own terms. mm, N/mm per ring.
struct LiteralScene {
  std::size_t rings = 200;
  double ring_height_mm = 0.75;
  double outer_radius_mm = 45.0;
  double inner_radius_mm = 0.0;
  double tool_height_mm = 20.0;                              ///< h_1
  std::function<double(double t)> tool_profile, tool_slope;  ///< f_h, f_h'
  double removal_fraction = 0.02;                            ///< epsilon = k (R - r)
  double inside_share = 0.27;                                ///< alpha
  double sigma_mm = 8.0;
  std::size_t kernel_rings = 40;     ///< L_1
  double stiffness_n_per_mm = 0.05;  ///< K, of each ring
  double friction = 0.0;             ///< mu
  double density_g_cm3 = 1.9;
  double max_stress = 0.0;               ///< beta_T as in section 7, without g; 0: not looked at
  std::size_t growth_limit = 5'000'000;  ///< so that an endless loop of the paper ends: reported
};

struct LiteralRing {
  double y_mm = 0.0, outer_mm = 0.0, inner_mm = 0.0;
};

struct LiteralReport {
  glm::dvec3 force_n{0.0};
  std::size_t rings_touched = 0;
  bool collapsed = false;
  bool endless = false;  ///< the growth loop had to be stopped
};

class LiteralPaper {
 public:
  explicit LiteralPaper(const LiteralScene& scene);
  LiteralReport step(const glm::dvec3& hip_mm);
  [[nodiscard]] const std::vector<LiteralRing>& rings() const { return rings_; }
  [[nodiscard]] double volume() const;  ///< sum of R^2 - r^2, mm^2

 private:
  LiteralScene scene_;
  std::vector<LiteralRing> rings_;
  double last_y_mm_ = 0.0;
  double last_velocity_mm_s_ = 0.0;
  bool moved_ = false;
};

}  // namespace clay::bench
