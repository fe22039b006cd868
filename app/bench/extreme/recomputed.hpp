#pragma once
// A tick recomputed in 50 digits, from docs/model.md or from the paper, ring by ring.

#include "app/bench/extreme/exact.hpp"
#include "app/bench/extreme/overlap_energy.hpp"
#include "app/bench/extreme/subject.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <vector>

namespace clay::extreme {

inline constexpr double kUlp = 0x1p-53;
inline constexpr double kQuantum = 0x1p-36;  // mm^2

/// The expected ring, R^2 and r^2 [mm^2], and the permitted rounding error of each.
struct Expected {
  Fifty outer2 = 0, inner2 = 0;
  double outer_slack = 0.0, inner_slack = 0.0;
};

/// One tick in 50 digits. All indices count from 0.
class Recomputed {
 public:
  Recomputed(Model model, const SceneSpec& scene, Section before, const glm::dvec3& hip,
             const glm::dvec3& moved);

  [[nodiscard]] const std::vector<Expected>& rings() const { return rings_; }
  [[nodiscard]] bool pressed() const { return removed_ > 0; }

 private:
  void use_counts();
  [[nodiscard]] std::size_t reach() const;
  void find_range();
  [[nodiscard]] std::size_t ring_at_centre() const;
  void remove();
  [[nodiscard]] Fifty profile_at(const Fifty& t) const;
  Fifty depth_left(const Fifty& wall, const Fifty& depth, Fifty advance, Fifty part,
                   const Fifty& whole);
  void remove_from(std::size_t i, const Fifty& d, const Fifty& radial_motion);
  double slack_of(const Fifty& outer, const Fifty& f, const Fifty& d) const;
  [[nodiscard]] Fifty distributed(const std::vector<Fifty>& sums, const Fifty& x) const;
  [[nodiscard]] std::vector<Fifty> sums_of_weights() const;
  Fifty distribute(const Fifty& amount, double slack, int direction);

  bool counted_;
  const SceneSpec& scene_;
  Section section_;
  glm::dvec3 hip_, moved_;
  Fifty rise_;  ///< since the last pose, in rings
  Fifty up_offset_ = 0, down_offset_ = 0;
  std::vector<Expected> rings_;
  bool none_ = false, outside_ = true, hollow_ = false;
  std::size_t bottom_ = 0, top_ = 0;
  Fifty removed_ = 0;
  double slack_ = 0.0;
  double exp_slack_ = 0.0;  ///< of the last depth_left [mm]
};

}  // namespace clay::extreme
