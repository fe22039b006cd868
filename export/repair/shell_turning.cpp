#include "export/repair/shell_turning.hpp"

#include "core/cancel.hpp"
#include "export/repair/surface_making.hpp"
#include "export/repair/winding_ray.hpp"
#include "export/solid/shell_volumes.hpp"
#include "export/solid/surface_samples.hpp"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace clay::solid::inline repair {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// Of the area of a negative shell: a cavity, such as a pocket or a drain hole, has more than this
/// share in the clay of positive shells. A body that was turned inward and touches others has less.
constexpr double kCavityShare = 0.25;

/// Points at which a negative shell is examined.
constexpr std::size_t kPoints = 32;

/// Shells that may intersect others or themselves: their volumes show their orientation. A negative
/// shell in clay is a cavity, and any other one is turned. A positive shell stays, also inside
/// another one: slicers fill it.
class OrientedShells {
 public:
  OrientedShells(TriangleMesh mesh, const Shells& shells)
      : mesh_(std::move(mesh)),
        shells_(shells),
        volumes_mm3_(volumes_of_shells(mesh_, shells.count,
                                       [&](std::size_t t) { return shells.of_face[t]; })) {}

  std::vector<bool> to_turn() {
    const bool all = std::accumulate(volumes_mm3_.begin(), volumes_mm3_.end(), 0.0) < 0.0;
    std::vector<bool> turn(shells_.count, all);
    if (all) reverse_all();
    if (shells_.count == 1) return turn;
    const WindingRay ray(mesh_);
    std::vector<std::vector<std::uint32_t>> negative(shells_.count);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (volumes_mm3_[shells_.of_face[t]] < 0.0) negative[shells_.of_face[t]].push_back(t);
    for (std::size_t shell = 0; shell < shells_.count; ++shell)
      if (!negative[shell].empty() &&
          !is_cavity(ray, shell, SurfaceSamples(mesh_, std::move(negative[shell]), kPoints)))
        turn[shell] = !all;
    return turn;
  }

 private:
  void reverse_all() {
    for (Triangle& t : mesh_.triangles) std::swap(t[1], t[2]);
    for (double& volume : volumes_mm3_) volume = -volume;
  }

  /// Whether a negative shell removes clay. Inside a cavity it is an island.
  bool is_cavity(const WindingRay& ray, std::size_t shell, const SurfaceSamples& samples) const {
    constexpr auto kFewest = static_cast<std::size_t>(kCavityShare * kPoints);
    std::size_t in_clay = 0;
    bool removes = false;
    for (std::size_t i = 0; i < kPoints && (in_clay <= kFewest || !removes); ++i) {
      if (in_clay + kPoints - i <= kFewest) return false;
      stop_if_cancelled();
      const auto [positive, others] =
          within(ray, shell, samples.triangle(i), SurfaceSamples::weights(i));
      if (positive > 0) ++in_clay;
      if (others > 0) removes = true;
    }
    return in_clay > kFewest && removes;
  }

  struct Windings {
    int positive = 0;  ///< of the positive shells
    int others = 0;    ///< of all other shells
  };
  /// The winding numbers just inside a negative shell, before the front of its triangle. Outside,
  /// a pocket that is flush with a face has no clay at that face.
  Windings within(const WindingRay& ray, std::size_t shell, std::uint32_t t,
                  const glm::dvec2& weights) const {
    const auto& corners = mesh_.triangles[t];
    const ExactPoint a = exact_point(mesh_.points[corners[0]]),
                     b = exact_point(mesh_.points[corners[1]]),
                     c = exact_point(mesh_.points[corners[2]]);
    const ExactKernel::Vector_3 normal = CGAL::normal(a, b, c);
    const ExactPoint from = a + weights.x * (b - a) + weights.y * (c - a);
    const int axis = longest_axis_of(normal);
    Windings windings;
    for (const Crossing& crossed :
         ray.crossings(from, axis, CGAL::sign(normal[axis]) == CGAL::POSITIVE)) {
      const std::size_t other = shells_.of_face[crossed.triangle];
      if (other != shell) windings.others += crossed.winding;
      if (volumes_mm3_[other] > 0.0) windings.positive += crossed.winding;
    }
    return windings;
  }

  TriangleMesh mesh_;
  const Shells& shells_;
  std::vector<double> volumes_mm3_;
};

}  // namespace

std::size_t turn_shells(Surface& surface) {
  if (surface.is_empty() || !CGAL::is_closed(surface)) return 0;
  TriangleMesh mesh = mesh_of(surface);
  const Shells shells(surface);
  const std::vector<bool> turn = OrientedShells(std::move(mesh), shells).to_turn();
  std::vector<Surface::Face_index> faces;
  for (const auto face : surface.faces())
    if (turn[shells.of_face[face]]) faces.push_back(face);
  pmp::reverse_face_orientations(faces, surface);
  return static_cast<std::size_t>(std::count(turn.begin(), turn.end(), true));
}

}  // namespace clay::solid::inline repair
