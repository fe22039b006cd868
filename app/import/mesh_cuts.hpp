#pragma once
// A mesh cut by half-planes through its axis.

#include "app/import/deviation.hpp"

#include "claystack/export/solid.hpp"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::importing {

/// Half-planes at equal azimuths. They avoid the azimuths at which meshes have their points.
inline constexpr std::size_t kMeshCuts = 64;
[[nodiscard]] double azimuth_of_cut(std::size_t cut) noexcept;  ///< [rad]

/// Maximum number of segments, at which mesh_cuts stops: several times that of the finest scan.
inline constexpr std::size_t kMostCutSegments = 2'000'000;

/// Rule for cutting an edge of the mesh: `straight` as a chord; `revolved` with a radius between
/// those of its ends, as if it lay on a surface of revolution. With `revolved` the facets of such a
/// surface do not scatter.
enum class Edges { straight, revolved };

/// The segments in which each half-plane meets the triangles: (distance from the axis, height).
/// `points` are those of the mesh with the axis as z.
[[nodiscard]] std::vector<std::vector<Segment>> mesh_cuts(const solid::TriangleMesh& mesh,
                                                          std::span<const glm::dvec3> points,
                                                          Edges edges = Edges::straight);

/// For each half-plane, whether the mesh has a surface all along it: it meets no open edge without
/// another one within 0.05 mm.
[[nodiscard]] std::vector<bool> complete_cuts(const solid::TriangleMesh& mesh,
                                              std::span<const glm::dvec3> points);

/// The clay of the largest area at one height of one cut; none if `outer_mm` is 0.
struct Wall {
  double inner_mm = 0.0, outer_mm = 0.0;
  double all_mm2 = 0.0;  ///< outer^2 - inner^2 of all clay at this height
};

/// At each of the ascending heights. Heights of segments' ends count as just above.
[[nodiscard]] std::vector<Wall> walls_of(const std::vector<Segment>& cut,
                                         std::span<const double> heights_mm);

}  // namespace clay::importing
