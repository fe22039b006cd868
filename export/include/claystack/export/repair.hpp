#pragma once
#include "claystack/core/result.hpp"
#include "claystack/export/solid.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline repair {

// ---- mesh repair ---------------------------------------------------------------------
// Repairs of foreign meshes.

/// One kind of repair, and its number.
struct Repair {
  std::string what;  ///< "hole filled", "shell turned", ...
  std::size_t count = 0;
};

/// A hole that was filled.
struct FilledHole {
  std::size_t edges = 0;   ///< of its border
  double extent_mm = 0.0;  ///< the largest distance between two points of its border
  double area_mm2 = 0.0;   ///< of the new triangles
  glm::dvec3 place{0.0};   ///< the middle of the box around its border [mm]
};

/// Upper bounds of the distances [mm] between the surfaces before and after.
struct SurfaceChange {
  double added_mm = 0.0;    ///< from any point of the result to the input
  double removed_mm = 0.0;  ///< from any point of the input to the result: large for inner sheets
};

struct RepairOptions {
  /// Border points within this distance become one. Unset: a quarter of the shortest edge at a
  /// border, without the shortest 2 % (slivers), at most a thousandth of the size of the mesh.
  std::optional<double> weld_mm = std::nullopt;
  /// Close wide openings by caps instead of refusing them.
  bool cap_openings = false;
  /// Parts of the mesh are missing, as of a file that was cut off: every wide hole is refused, also
  /// one without a rim. `cap_openings` fills it.
  bool parts_missing = false;
  /// A mesh with a wide opening gets a wall of this thickness [mm], half on each side of its
  /// triangles: its vertices are moved; where that gives no sound wall, by a wrap.
  std::optional<double> thicken_mm = std::nullopt;
  /// If no sound mesh is found otherwise, make a new surface at this distance [mm] around all
  /// triangles: closed, but details smaller than that are lost. Unset: that is an error.
  std::optional<double> wrap_mm = std::nullopt;
  /// Called at the start of each stage with the share 0, and during long ones again with the share
  /// of the stage that is done, 0 to 1.
  std::function<void(std::string_view stage, double share)> progress = {};
  /// Called repeatedly, from several threads. True ends the work: an error of kind `io`, "repair
  /// stopped: cancelled".
  std::function<bool()> cancelled = {};
};

/// Names in messages of the settings that help: `thicken_mm`, `cap_openings` and `wrap_mm`.
inline constexpr const char* kThickening = "thickening";
inline constexpr const char* kCapping = "capping";
inline constexpr const char* kWrapping = "wrapping";

/// A wall that was made around an open surface.
struct ThickenedWall {
  double asked_mm = 0.0;
  double least_mm = 0.0;  ///< the thinnest of 50,000 samples by `sampled_wall`; not a bound
  /// Half of 4,000 places of the surface have a thinner wall: much above `asked_mm` if it is too
  /// thick everywhere.
  double median_mm = 0.0;
  bool wrapped = false;  ///< a wrap, because moved vertices gave no sound wall
  /// Of the places beside the surface, just beyond the wall, those that are clay, 0 to 1, by 2,000
  /// samples: 0.5 if the wall fills a whole cup, and small if only corners are filled.
  double filled_share = 0.0;
};

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<Repair> repaired;  ///< in the order of the work; empty for a sound mesh
  std::vector<FilledHole> holes;
  SurfaceChange change;
  std::optional<double> wrapped_mm = std::nullopt;  ///< set if the surface was wrapped
  std::optional<ThickenedWall> thickened = std::nullopt;
};

/// Repairs a mesh, or explains why it cannot; the result is sound by check_mesh. In this order:
/// - triangles with an index out of range or a point that is not finite are removed, points are
///   rounded to float32 (which files hold) and merged, cracks are welded, duplicates and fins are
///   removed;
/// - triangles are oriented like their neighbours, and sheets that touch are cut apart;
/// - holes of up to kMaxHoleEdges edges are filled; wide openings are refused: a cup given as a
///   surface has no clay;
/// - a negative shell is a cavity if more than a quarter of its surface lies in positive shells, as
///   sampled, and not all of it in another cavity; any other one is turned;
/// - intersections are resolved: triangles are cut where they meet, and the boundary of all points
///   with a winding number of at least 1 is kept. Overlapping bodies are united. Parts that touch
///   in an edge or a point are pulled apart.
/// Triangles that take part in none of this keep their points, their first corner and their order;
/// so do the points. A sound mesh is returned unchanged.
/// Deterministic. Half-edges, holes and exact numbers are CGAL's. Errors of kind `unsound`: the
/// reason why no sound mesh was found; `bad_input`: a wall or wrap that would take too long; `io`:
/// not enough memory, cancelled, or the library failed.
Result<RepairedMesh> repair_mesh(const TriangleMesh& mesh, const RepairOptions& options = {});
/// The same for a mesh that check_mesh found unsound.
Result<RepairedMesh> repair_unsound_mesh(const TriangleMesh& mesh,
                                         const RepairOptions& options = {});

/// Upper bounds of the distances between two meshes, as of a mesh and the same one in a file.
/// Triangles without a position are left out. Errors: `io` if memory is missing.
Result<SurfaceChange> change_between(const TriangleMesh& before, const TriangleMesh& after);

/// The longest border of a hole that is filled: above it, the search for a patch takes too long.
inline constexpr std::size_t kMaxHoleEdges = 10'000;

}  // namespace clay::solid::inline repair
