#pragma once
// The energy whose gradient the force must be, written from the model's definition in 50 digits
// and without a line of the engine.

#include "extreme/subject.hpp"

#include <vector>

namespace clay::extreme {

/// Rings as they were before a tick.
struct Section {
  std::vector<Radii> rings;
  std::vector<double> centres_mm;
};
[[nodiscard]] Section section_of(const Subject& subject);

/// E = K/2 sum over the rings of depth^2, depth = max(0, R + f - d) outside, max(0, d + f - r)
/// inside; K in N/mm of one ring; a ring counts while its middle is level with the tool.
class OverlapEnergy {
 public:
  OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm, bool outside);
  /// Of two tools, `gap_mm` apart at their widest, t = 0; the HIP between them.
  OverlapEnergy(ToolShapeSpec shape, Section section, double stiffness_n_per_mm, double gap_mm);

  /// Minus the gradient at `hip_mm`, by central differences [N].
  [[nodiscard]] glm::dvec3 force_n(const glm::dvec3& hip_mm) const;
  /// No ring so near an end of the tool that E has a jump, or that f' is held (tool.hpp).
  [[nodiscard]] bool smooth_at(double hip_y_mm) const;
  [[nodiscard]] std::size_t touched(const glm::dvec3& hip_mm) const;

 private:
  struct Point {
    Fifty x, y, z;
  };
  struct Standing {
    bool outside;
    double from_hip_mm;  ///< along the HIP's radius
  };
  [[nodiscard]] Fifty at(const Point& hip) const;
  [[nodiscard]] Fifty depth(std::size_t i, const Point& hip, const Standing& tool) const;

  ToolShapeSpec shape_;
  Section section_;
  Fifty stiffness_;
  std::vector<Standing> tools_;
};

/// Half the height of a tool, for shapes that are even in t.
[[nodiscard]] double half_height_mm(const ToolShapeSpec& shape);
/// f(t) of a sphere, ellipse or rib, |t| <= half height.
[[nodiscard]] Fifty half_profile(const ToolShapeSpec& shape, const Fifty& t);

}  // namespace clay::extreme
