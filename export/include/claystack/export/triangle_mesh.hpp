#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace clay::solid {

/// The largest mesh that is made, read or checked; its file as binary STL takes 1 GB.
inline constexpr std::size_t kMaxTriangles = 20'000'000;

/// Points [mm] and triangles by index, counterclockwise seen from outside.
struct TriangleMesh {
  std::vector<glm::dvec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  friend bool operator==(const TriangleMesh&, const TriangleMesh&) = default;
};

/// Signed volume [mm^3] by the divergence theorem, summed in double about the first point
/// with compensation; positive for a closed mesh oriented outward. Indices must be in range.
[[nodiscard]] double signed_volume(const TriangleMesh& mesh) noexcept;

}  // namespace clay::solid
