#include "claystack/export/repair.hpp"

#include "claystack/export/check.hpp"
#include "core/cancel.hpp"
#include "core/parallel_parts.hpp"
#include "core/text.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/repair/hole_filling.hpp"
#include "export/repair/intersection_repair.hpp"
#include "export/repair/order_keeping.hpp"
#include "export/repair/repair_distance.hpp"
#include "export/repair/shell_turning.hpp"
#include "export/repair/soup_edges.hpp"
#include "export/repair/soup_repair.hpp"
#include "export/repair/stage_report.hpp"
#include "export/repair/surface_making.hpp"
#include "export/repair/thickening.hpp"
#include "export/repair/wrapping.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <glm/geometric.hpp>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline repair {
namespace {

/// Of the reported distances, in sizes of the mesh.
constexpr double kDistanceTolerance = 1e-4;

/// Openings that a wrap enters, in offsets. A wall has a closer fit, `kThickenAlpha`.
constexpr double kWrapAlpha = 10.0;

tl::unexpected<Error> nothing_left() {
  return failure(ErrorKind::unsound, "repair leaves nothing: no triangle is part of a surface");
}

/// Refuses wraps that would take too long, before any work: of a thin wall, or close to the
/// surface.
Result<void> expect_quick_wraps(const TriangleMesh& soup, const RepairOptions& options) {
  const auto expect = [&](std::string_view what, const std::optional<double>& asked_mm,
                          double least_mm) -> Result<void> {
    if (!asked_mm || *asked_mm >= least_mm) return {};
    return failure(ErrorKind::bad_input, std::string(what) + ": expected at least " +
                                             short_number_text(std::ceil(least_mm * 1e4) / 1e4) +
                                             " mm for a surface of " +
                                             short_number_text(area_mm2(soup) / 100.0) +
                                             " cm2, found " + short_number_text(*asked_mm) +
                                             " mm, which would take more "
                                             "than " +
                                             short_number_text(kMostWrapTriangles) + " triangles");
  };
  return expect("thickness of the wall", options.thicken_mm,
                2.0 * least_wrap_offset_mm(soup, kThickenAlpha))
      .and_then([&] {
        return expect("distance of the wrap", options.wrap_mm,
                      least_wrap_offset_mm(soup, kWrapAlpha));
      });
}

/// Each edge has as many triangles in one direction as in the other: the mesh bounds solids, and
/// any opening comes from taking its faces apart, as where two solids share a face.
bool is_closed(const TriangleMesh& soup) {
  bool closed = true;
  for_each_edge(soup, [&](std::span<const SoupEdge> edges) {
    int sum = 0;
    for (const SoupEdge& edge : edges) sum += direction(soup, edge);
    closed = closed && sum == 0;
  });
  return closed;
}

/// The union of closed solids that share edges, as the parts of a stacked cup do. No surface joins
/// all of their triangles, but winding numbers show the enclosed space. Empty for an open soup, and
/// if a solid is inside out: only half-edges can show which one.
std::optional<TriangleMesh> united_solids(TriangleMesh soup, std::vector<Repair>& repaired,
                                          StageReport& stage) {
  if (!is_closed(soup)) return std::nullopt;
  if (signed_volume(soup) < 0.0) {
    for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
    note_repair(repaired, "shell turned", 1);
  }
  auto united = resolve_intersections(soup, Reversed::refused, repaired, stage);
  if (!united) return std::nullopt;
  note_repair(repaired, "solids with common edges united", 1);
  return std::move(*united);
}

/// Fills the holes and turns shells outward.
Result<TriangleMesh> closed_surface(Surface& surface, const TriangleMesh& soup,
                                    const RepairOptions& options, RepairedMesh& report,
                                    StageReport& stage) {
  stage.begin("filling holes");
  auto holes = fill_holes(surface, is_closed(soup)         ? Openings::closed
                                   : options.cap_openings  ? Openings::capped
                                   : options.parts_missing ? Openings::all_refused
                                                           : Openings::refused);
  if (!holes) return tl::make_unexpected(holes.error());
  if (holes->left) {
    // Borders in one place close each other, as where solids share a face.
    TriangleMesh mesh = mesh_of(surface);
    merge_equal_points(mesh);
    drop_collapsed(mesh);
    if (!is_closed(mesh)) return unfilled(*holes->left);
  }
  report.holes = std::move(holes->filled);
  note_repair(report.repaired, "hole filled", report.holes.size());
  stage.begin("turning shells");
  note_repair(report.repaired, "shell turned", turn_shells(surface));
  return mesh_of(surface);
}

/// The stages in their order.
Result<TriangleMesh> repaired(const TriangleMesh& soup, const RepairOptions& options,
                              RepairedMesh& report, StageReport& stage) {
  stage.begin("joining triangles");
  std::vector<Repair> cleaned = report.repaired;
  auto surface = make_surface(soup, report.repaired);
  if (!surface) return tl::make_unexpected(surface.error());
  if (!CGAL::is_closed(*surface))
    if (auto united = united_solids(soup, cleaned, stage)) {
      report.repaired = std::move(cleaned);
      return std::move(*united);
    }
  std::optional<Surface> open;  // without the patches that a refused opening leaves
  if (options.thicken_mm) open = *surface;
  const auto closed = closed_surface(*surface, soup, options, report, stage);
  if (!closed && open)
    return thickened(soup, std::move(*open), *options.thicken_mm, closed.error(), report, stage);
  if (!closed) return closed;
  if (closed->triangles.empty()) return nothing_left();
  return resolve_intersections(*closed, Reversed::accepted, report.repaired, stage);
}

/// A repair, and whether a wrap may succeed where it did not.
struct RepairAttempt {
  Result<TriangleMesh> mesh;
  bool wrap_may_help = false;
};

/// Exceptions of the library become errors. The library may fail to repair a mesh that it can wrap.
RepairAttempt attempted(const TriangleMesh& soup, const RepairOptions& options,
                        RepairedMesh& report, StageReport& stage) try {
  auto mesh = repaired(soup, options, report, stage);
  const bool unsound = !mesh && mesh.error().kind == ErrorKind::unsound;
  return {std::move(mesh), unsound};
} catch (const std::bad_alloc&) {
  throw;  // a wrap needs more memory
} catch (const std::exception& e) {
  return {failure(ErrorKind::io, std::string("repair failed: ") + e.what()), true};
}

TriangleMesh usable(TriangleMesh mesh) {
  drop_unusable(mesh);
  drop_unused_points(mesh);  // their places may not be finite
  return mesh;
}

SurfaceChange change_of_usable(const TriangleMesh& before, const TriangleMesh& after) {
  return surface_change(before, after, kDistanceTolerance * glm::length(extent_of(after).size()));
}

Result<RepairedMesh> repair_unsound(const TriangleMesh& mesh, const RepairOptions& options) {
  RepairedMesh result;
  StageReport stage(options.progress);
  stage.begin("cleaning");
  TriangleMesh soup = mesh;
  clean_soup(soup, options.weld_mm, result.repaired);
  if (soup.triangles.empty()) return nothing_left();
  if (auto quick = expect_quick_wraps(soup, options); !quick)
    return tl::make_unexpected(quick.error());
  RepairAttempt attempt = attempted(soup, options, result, stage);
  Result<TriangleMesh> sound = std::move(attempt.mesh);
  if (attempt.wrap_may_help && options.wrap_mm) {
    result = {};
    stage.begin("wrapping");
    result.wrapped_mm = options.wrap_mm;
    note_repair(result.repaired, "surface replaced by a wrap", 1);
    sound = wrapped_or_error(soup, *options.wrap_mm, kWrapAlpha * *options.wrap_mm, sound.error());
  }
  if (!sound) return tl::make_unexpected(sound.error());
  stage.begin("measuring the change");
  soup = usable(mesh);
  for_each_part(2, [&](std::size_t part) {
    if (part == 0)
      result.mesh = in_order_of(soup, *sound);
    else
      result.change = change_of_usable(soup, *sound);
  });
  return result;
}

Result<RepairedMesh> repair_if_size_fits(const TriangleMesh& mesh, const RepairOptions& options) {
  if (mesh.triangles.empty() || mesh.triangles.size() > kMaxTriangles)
    return failure(ErrorKind::unsound, "expected 1 to " + std::to_string(kMaxTriangles) +
                                           " triangles to repair, found " +
                                           std::to_string(mesh.triangles.size()));
  return repair_unsound(mesh, options);
}

/// Exceptions become errors of the job.
template <class Work>
auto guarded(const std::string& job, const RepairOptions& options, const Work& work)
    -> decltype(work()) try {
  const CancelScope scope(options.cancelled ? &options.cancelled : CancelScope::current());
  return work();
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, job + " stopped: not enough memory");
} catch (const std::exception& e) {
  return failure(ErrorKind::io, job + " failed: " + e.what());
} catch (const Cancelled&) {
  // Without `cancelled`, an enclosing job decides the cancellation.
  if (!options.cancelled) throw;
  return failure(ErrorKind::io, job + " stopped: cancelled");
}

}  // namespace

Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh, const RepairOptions& options) {
  return guarded("repair", options, [&]() -> Result<RepairedMesh> {
    if (options.progress) options.progress("checking", 0.0);
    if (inspect_mesh(mesh).sound()) return RepairedMesh{mesh, {}, {}, {}};
    return repair_if_size_fits(mesh, options);
  });
}

Result<RepairedMesh> repair_unsound_mesh(const TriangleMesh& mesh, const RepairOptions& options) {
  return guarded("repair", options, [&] { return repair_if_size_fits(mesh, options); });
}

Result<SurfaceChange> change_between(const TriangleMesh& before, const TriangleMesh& after) {
  return guarded("measuring the change", {}, [&]() -> Result<SurfaceChange> {
    const TriangleMesh from = usable(before);
    if (from.triangles.empty() || after.triangles.empty()) return SurfaceChange{};
    return change_of_usable(from, after);
  });
}

}  // namespace clay::solid::inline repair
