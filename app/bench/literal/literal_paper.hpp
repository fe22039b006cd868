#pragma once
// The paper's equations as printed, in floating point and without checks: a reference for speed,
// and for showing that the extreme suite can fail. Not for other uses.

#include <cstddef>
#include <glm/vec3.hpp>
#include <variant>
#include <vector>

namespace clay::bench {

/// f_h(t) = b sqrt(1 - t^2/a^2), section 3; a sphere has a = b. NaN where |t| > a.
struct LiteralEllipse {
  double half_height_mm = 10.0;  ///< a
  double half_width_mm = 10.0;   ///< b
};
/// f_h(t) = b, at any t.
struct LiteralRib {
  double height_mm = 40.0;  ///< h_1
  double radius_mm = 6.0;   ///< b
};
using LiteralTool = std::variant<LiteralEllipse, LiteralRib>;

/// Two versions of the same equations. They agree to rounding, except for a ring level with a pole
/// of the tool, where f_h' is infinite.
enum class LiteralWriting {
  /// M_i summed again for every ring, which is O(N^2); angles by atan, normals by sin and cos.
  as_printed,
  /// An efficient version: M_i as a running sum, normals by one square root.
  eased,
};

/// Settings in the paper's terms. mm, N/mm per ring. Not checked.
struct LiteralScene {
  std::size_t rings = 200;
  double ring_height_mm = 0.75;
  double outer_radius_mm = 45.0;
  double inner_radius_mm = 0.0;
  LiteralTool tool = LiteralEllipse{};
  double removal_fraction = 0.02;  ///< epsilon = k (R - r)
  double inside_share = 0.27;      ///< alpha
  double sigma_mm = 8.0;
  std::size_t kernel_rings = 40;     ///< L_1
  double stiffness_n_per_mm = 0.05;  ///< K, of each ring
  double friction = 0.0;             ///< mu
  double density_g_cm3 = 1.9;
  double max_stress_kg_per_mm2 = 0.0;  ///< beta_T as in section 7, without g; 0: not checked
  std::size_t growth_limit =
      5'000'000;  ///< stops an endless loop of the paper, which is then reported
  LiteralWriting writing = LiteralWriting::as_printed;
};

/// y_i = (i - 1) h: the centroid of the first ring is at the origin.
struct LiteralRing {
  double y_mm = 0.0, outer_mm = 0.0, inner_mm = 0.0;
};

struct LiteralReport {
  glm::dvec3 force_n{0.0};  ///< with the paper's sign, unlimited
  std::size_t rings_touched = 0;
  bool collapsed =
      false;  ///< beta_i > beta_T somewhere; the paper does not say where the rotation ends
  bool endless = false;  ///< the growth loop had to be stopped
  /// Equation (1) or (2) leaves the range of an index, so the formula is undefined in C++; the tick
  /// did nothing.
  bool undefined = false;
};

class LiteralPaper {
 public:
  explicit LiteralPaper(const LiteralScene& scene);
  LiteralPaper(const LiteralScene& scene, std::vector<LiteralRing> rings);

  LiteralReport step(const glm::dvec3& hip_mm);

  [[nodiscard]] const std::vector<LiteralRing>& rings() const { return rings_; }
  [[nodiscard]] double volume() const;  ///< sum of R^2 - r^2, mm^2
  /// P_d(j), j = 1..L_1.
  [[nodiscard]] double weight(std::size_t j) const { return weights_[j - 1]; }
  /// beta_i of section 7, i counted from 0. kg/mm^2
  [[nodiscard]] double stress(std::size_t i) const;

 private:
  struct Contact;
  template <LiteralWriting writing, class Profile>
  LiteralReport tick(const Profile& profile, const glm::dvec3& hip_mm);
  template <LiteralWriting writing, class Profile>
  void touch(const Profile& profile, const glm::dvec3& hip_mm, Contact& contact);
  [[nodiscard]] glm::dvec3 force(const Contact& contact, const glm::dvec3& hip_mm) const;
  void redistribute(const Contact& contact, LiteralReport& report);
  double distribute_up(double inside, double outside, std::size_t top);
  double distribute_down(double inside, double outside, std::size_t bottom);
  void grow(double excess, LiteralReport& report);
  template <LiteralWriting writing>
  [[nodiscard]] bool overstressed() const;

  LiteralScene scene_;
  std::vector<LiteralRing> rings_;
  std::vector<double> weights_;  ///< P_d(1)..P_d(L_1)
  bool hollow_ = false;          ///< false if r_i = 0 for all i
  double last_y_mm_ = 0.0;
  double rise_mm_ = 0.0;  ///< of the last tick with a rise: its sign is that of the velocity
  bool has_last_ = false;
};

}  // namespace clay::bench
