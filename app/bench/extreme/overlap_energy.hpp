#pragma once
// The energy whose gradient the force must be, from the definition of the model and without code of
// the engine.

#include "app/bench/extreme/subject.hpp"

#include <vector>

namespace clay::extreme {

/// Rings as they were before a tick.
struct Section {
  std::vector<Radii> rings;
  std::vector<double> centres_mm;
};
[[nodiscard]] Section section_of(const Subject& subject);

/// E = K'/2 times the integral of (depth cos theta)^2 over the common height of tool and clay;
/// depth = max(0, R + f - d) outside, max(0, d + f - r) inside, tan theta = f'; K' in N/mm^2.
/// Integrated by Gauss-Legendre quadrature; the engine sums over rings.
class OverlapEnergy {
 public:
  OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm2, bool outside);
  /// Two tools, `gap_mm` apart at their widest (t = 0), with the HIP between them.
  OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm2, double gap_mm);

  /// Minus the gradient at `hip_mm`, by central differences [N].
  [[nodiscard]] glm::dvec3 force_n(const glm::dvec3& hip_mm) const;

 private:
  struct PlacedTool {
    bool outside;
    double from_hip_mm;  ///< along the radius of the HIP
  };
  [[nodiscard]] double at(const glm::dvec3& hip_mm) const;
  [[nodiscard]] double of_ring(std::size_t i, double hip_y, double d, bool outside) const;

  ToolShapeSpec shape_;
  Section section_;
  double stiffness_, ring_height_;
  std::vector<PlacedTool> tools_;
};

/// Half the height of a tool, for shapes that are even in t.
[[nodiscard]] double half_height_mm(const ToolShapeSpec& shape);
/// f(t) of a sphere, ellipse or rib, |t| <= half height.
[[nodiscard]] Fifty half_profile(const ToolShapeSpec& shape, const Fifty& t);

}  // namespace clay::extreme
