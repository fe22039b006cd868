#pragma once
#include "claystack/engine/clay.hpp"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace clay {

/// Pose of a fallen part in the plane of the collapse: x outward, toward the HIP; y up from the
/// wheel head; angle counterclockwise.
struct PlanePose {
  glm::dvec2 centre_mm{0.0};  ///< of mass
  double angle_rad = 0.0;
};

/// A strip of surface around the part's own axis, of a wall or a tread. It is sampled in
/// kDirections on the half in front of the plane of the collapse, which represents both halves.
struct SurfaceStrip {
  double radius_mm = 0.0;
  double height_mm = 0.0;  ///< from the centre of mass, before the collapse
  double outward = 0.0;    ///< radial component of the unit normal
  double upward = 0.0;     ///< axial component of the unit normal
  double area_mm2 = 0.0;   ///< of one sample
};
inline constexpr std::size_t kDirections = 32;

/// The part above a ring, crown included, as one rigid body that moves in a plane through its axis.
class FallenBody {
 public:
  /// O(N) once; the number of strips is bounded for any N.
  FallenBody(const ClayStack& stack, std::size_t failed_ring);

  [[nodiscard]] bool empty() const noexcept { return volume_mm3_ <= 0.0; }
  [[nodiscard]] double volume_mm3() const noexcept { return volume_mm3_; }
  /// Height of the centre of mass above the wheel head, before the collapse.
  [[nodiscard]] double centre_height_mm() const noexcept { return centre_height_mm_; }
  /// Radius of gyration in the plane, about the centre of mass.
  [[nodiscard]] double gyration_mm() const noexcept { return gyration_mm_; }
  /// The largest distance of a point from the centre of mass.
  [[nodiscard]] double reach_mm() const noexcept { return reach_mm_; }
  [[nodiscard]] const std::vector<SurfaceStrip>& surface() const noexcept { return surface_; }

  /// Cosines of the sampled directions, from the outward side to the other.
  [[nodiscard]] static const std::array<double, kDirections>& directions() noexcept;

  /// The lowest point after a rotation by an angle, relative to the centre of mass.
  [[nodiscard]] glm::dvec2 lowest(double angle_rad) const noexcept;

 private:
  struct Band {
    double outer_mm, inner_mm, bottom_mm, top_mm;
  };

  void measure(const ClayStack& stack, std::size_t first);
  void add_outline(const ClayStack& stack, std::size_t first);
  [[nodiscard]] std::vector<Band> bands(const ClayStack& stack, std::size_t first) const;
  void add_surface(const std::vector<Band>& bands, const Ring& failed);
  void add_wall(double radius_mm, const Band& band, double outward);
  void add_tread(double from_mm, double to_mm, double height_mm, double upward);
  void add_difference(const Band& below, const Band& above);

  double volume_mm3_ = 0.0;
  double centre_height_mm_ = 0.0;
  double gyration_mm_ = 0.0;
  double reach_mm_ = 0.0;
  /// Right half, from the bottom up, relative to the centre of mass.
  std::vector<glm::dvec2> hull_;
  std::vector<SurfaceStrip> surface_;
};

}  // namespace clay
