#pragma once
#include "claystack/export/solid.hpp"
#include "export/solid/area_shares.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace clay::solid {

/// Points on triangles, spread evenly over their area. They do not depend on the pose.
class SurfaceSamples {
 public:
  /// On the whole mesh, which outlives this; it has a triangle with area.
  SurfaceSamples(const TriangleMesh& mesh, std::size_t count);
  /// On some of its triangles, at least one.
  SurfaceSamples(const TriangleMesh& mesh, std::vector<std::uint32_t> triangles, std::size_t count);

  /// The triangle of a sample below `count`. It has area, unless none has.
  [[nodiscard]] std::uint32_t triangle(std::size_t sample) const;
  /// The place in it: weights of its second and third corner, by a sequence of low discrepancy,
  /// also if all samples lie on one triangle.
  [[nodiscard]] static glm::dvec2 weights(std::size_t sample);
  /// That place, rounded.
  [[nodiscard]] glm::dvec3 place(std::size_t sample) const;

 private:
  const TriangleMesh& mesh_;
  std::size_t count_;
  std::vector<std::uint32_t> triangles_;
  AreaShares shares_;
};

}  // namespace clay::solid
