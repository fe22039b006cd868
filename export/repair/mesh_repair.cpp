#include "claystack/export/repair.hpp"

#include "claystack/export/proof.hpp"
#include "export/repair/hole_filling.hpp"
#include "export/repair/intersection_repair.hpp"
#include "export/repair/shell_turning.hpp"
#include "export/repair/soup_repair.hpp"
#include "export/repair/surface_making.hpp"

#include <exception>

namespace clay::solid::inline repair {
namespace {

tl::unexpected<Error> nothing_left() {
  return failure(ErrorKind::unsound, "repair leaves nothing: no triangle is part of a surface");
}

/// The stages in their order.
Result<RepairedMesh> repair_unsound(const TriangleMesh& mesh, const RepairOptions& options) {
  RepairedMesh result;
  TriangleMesh soup = mesh;
  clean_soup(soup, options.weld_mm, result.repaired);
  if (soup.triangles.empty()) return nothing_left();
  auto surface = make_surface(soup, result.repaired);
  if (!surface) return tl::make_unexpected(surface.error());
  auto holes = fill_holes(*surface, options.cap_openings);
  if (!holes) return tl::make_unexpected(holes.error());
  result.holes = std::move(*holes);
  note_repair(result.repaired, "hole filled", result.holes.size());
  note_repair(result.repaired, "shell turned", turn_shells(*surface));
  result.mesh = mesh_of(*surface);
  if (result.mesh.triangles.empty()) return nothing_left();
  auto resolved = resolve_intersections(result.mesh, result.repaired);
  if (!resolved) return tl::make_unexpected(resolved.error());
  result.mesh = std::move(*resolved);
  return result;
}

}  // namespace

Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh, const RepairOptions& options) try {
  if (check_mesh(mesh).sound()) return RepairedMesh{mesh, {}, {}};
  if (mesh.triangles.empty() || mesh.triangles.size() > kMaxTriangles)
    return failure(ErrorKind::unsound, "expected 1 to " + std::to_string(kMaxTriangles) +
                                           " triangles to repair, found " +
                                           std::to_string(mesh.triangles.size()));
  return repair_unsound(mesh, options);
} catch (const std::exception& e) {
  return failure(ErrorKind::unsound, std::string("repair failed: ") + e.what());
}

}  // namespace clay::solid::inline repair
