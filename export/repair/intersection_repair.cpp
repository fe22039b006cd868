#include "export/repair/intersection_repair.hpp"

#include "export/formats/file_floats.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/repair/exact_refinement.hpp"
#include "export/repair/outer_skin.hpp"
#include "export/repair/sheet_count.hpp"
#include "export/repair/soup_repair.hpp"
#include "export/repair/touching_parts.hpp"
#include "export/solid/seam_cure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <utility>

namespace clay::solid::inline repair {
namespace {

/// One unit in the last place of float32, at the largest coordinate.
double last_place_mm(const TriangleMesh& mesh) {
  double largest = std::numeric_limits<float>::min();
  for (const glm::dvec3& p : mesh.points)
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis]));
  return std::ldexp(1.0, std::ilogb(largest) - std::numeric_limits<float>::digits + 1);
}

/// Rounding lays some triangles back to back.
void cancel_sheets(TriangleMesh& mesh) {
  const SheetCount counted = count_sheets(mesh);
  if (counted.triangles.size() == mesh.triangles.size()) return;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < counted.triangles.size(); ++t)
    triangles.insert(triangles.end(), static_cast<std::size_t>(counted.sheets[t]),
                     counted.triangles[t]);
  mesh.triangles = std::move(triangles);
}

/// A surface on exact points, and which of them lie at cuts.
struct Cut {
  TriangleMesh mesh;
  std::vector<bool> on_seam;
  std::size_t inner = 0;
  bool reversed = false;
};

Result<Cut> cut_and_select(const TriangleMesh& mesh, StageReport& stage) {
  auto soup = refine(mesh, stage);
  if (!soup) return tl::make_unexpected(soup.error());
  stage.begin("choosing the outer skin");
  auto skin = outer_skin(*soup, mesh);
  if (!skin) return tl::make_unexpected(skin.error());
  if (skin->triangles.empty())
    return failure(ErrorKind::unsound, "expected a surface that encloses clay, found none");
  Cut cut{{std::move(soup->points), std::move(skin->triangles)},
          soup->at_cut,
          skin->inner,
          skin->reversed};
  cut.on_seam.resize(cut.mesh.points.size(), true);
  return cut;
}

struct Rounded {
  TriangleMesh mesh;
  std::size_t pulled = 0;
};

/// Triangles lower than `shortest_mm` are removed first, so that rounding cannot turn them over.
Rounded rounded(Cut cut, double shortest_mm, double gap_mm) {
  Rounded result;
  result.pulled = pull_apart(cut.mesh, gap_mm);
  cut.on_seam.resize(cut.mesh.points.size(), true);
  if (auto cured = cure_seam(cut.mesh, cut.on_seam, shortest_mm)) cut.mesh = std::move(cured->mesh);
  result.mesh = std::move(cut.mesh);
  round_to_file(result.mesh.points);
  drop_unused_points(result.mesh);
  merge_equal_points(result.mesh);
  drop_collapsed(result.mesh);
  cancel_sheets(result.mesh);
  drop_unused_points(result.mesh);
  return result;
}

std::size_t faults_of(const MeshReport& report) {
  std::size_t faults = 0;
  for (const MeshProblem& problem : report.problems) faults += problem.count;
  return faults;
}

/// The points at cuts on a grid, so that sheets that nearly coincide do so exactly.
TriangleMesh snapped(const TriangleMesh& mesh, const std::vector<bool>& at_cut, double step_mm) {
  TriangleMesh result = mesh;
  for (std::size_t v = 0; v < result.points.size(); ++v)
    if (at_cut[v]) result.points[v] = file_point(glm::round(result.points[v] / step_mm) * step_mm);
  merge_equal_points(result);
  drop_collapsed(result);
  return result;
}

class Resolution {
 public:
  Resolution(TriangleMesh mesh, Reversed reversed, std::vector<Repair>& repaired,
             StageReport& stage)
      : input_(std::move(mesh)),
        reversed_(reversed),
        unit_mm_(last_place_mm(input_)),
        repaired_(repaired),
        stage_(stage) {}

  Result<TriangleMesh> run() {
    stage_.begin("checking");
    report_ = inspect_mesh(input_);
    note_repair(repaired_, "pair of intersecting triangles resolved", report_.self_intersections);
    if (report_.sound()) return input_;
    for (int round = 0; round < kMostRounds; ++round) {
      if (round > 0)
        mesh_ = snapped(input_, at_cut_, std::ldexp(unit_mm_, 3 * (round + 1)));
      else
        mesh_ = input_;
      if (auto done = cut_repeatedly(round == 0); !done && round == 0)
        return tl::make_unexpected(done.error());
      if (report_.sound()) return mesh_;
    }
    return failure(ErrorKind::unsound,
                   "expected a sound mesh after " + std::to_string(kMostRounds) +
                       " rounds of cutting and rounding, found: " + report_.problems.front().what +
                       " (" + std::to_string(report_.problems.front().count) + ") at " +
                       report_.problems.front().where);
  }

 private:
  /// Cuts the best mesh again as long as few faults are left: with few cuts, that takes much less
  /// time than the next round. Where a cut leaves no fewer, only the points at faults are put on a
  /// coarser grid.
  Result<void> cut_repeatedly(bool first) {
    constexpr int kMostPasses = 10, kMostGrids = 2;
    constexpr std::size_t kFewFaults = 200, kMostFaults = 1'000;
    std::size_t fewest = SIZE_MAX / 2;
    std::vector<bool> at_fault;
    for (int pass = 0, grid = 0; pass < kMostPasses && grid <= kMostGrids; ++pass) {
      const auto cut = cut_and_select(
          grid > 0 ? snapped(mesh_, at_fault, std::ldexp(unit_mm_, 3 * (grid + 1))) : mesh_,
          stage_);
      if (!cut && pass > 0)
        return {};  // rounding opened the sheets: the next round cuts them again
      if (!cut) return tl::make_unexpected(cut.error());
      if (first && pass == 0) {
        if (cut->reversed && reversed_ == Reversed::refused)
          return failure(ErrorKind::unsound, "expected no part that is turned inside out");
        at_cut_ = cut->on_seam;
        note_repair(repaired_, "triangle inside the solid removed", cut->inner);
      }
      const TriangleMesh best = mesh_;
      const MeshReport of_best = report_;
      const std::size_t faults = round_in_steps(*cut);
      if (faults == 0) return {};
      if (faults > kFewFaults && (faults > kMostFaults || 3 * faults > 2 * fewest)) return {};
      if (faults < fewest) {
        fewest = faults;
        grid = 0;
        continue;
      }
      mesh_ = best;
      report_ = of_best;
      if (grid++ == 0) at_fault = cut->on_seam;
    }
    return {};
  }

  /// Keeps the result with the fewest faults. Returns their number.
  std::size_t round_in_steps(const Cut& cut) {
    constexpr int kMostSteps = 7, kMostWorse = 2;
    constexpr std::size_t kHopeless = 20'000;  // larger steps do not help
    std::optional<std::size_t> fewest;
    int worse = 0;
    for (int step = 0; step < kMostSteps && worse < kMostWorse; ++step) {
      stage_.begin("rounding");
      Rounded next =
          rounded(cut, std::ldexp(unit_mm_, 2 * step + 1), std::ldexp(unit_mm_, 2 * step + 6));
      stage_.begin("checking");
      MeshReport of_next = inspect_mesh(next.mesh);
      const std::size_t faults = faults_of(of_next);
      if (fewest && faults >= *fewest)
        worse += faults == *fewest ? kMostWorse : 1;  // same faults: not caused by the steps
      else
        worse = 0;
      if (fewest && *fewest <= faults) continue;
      fewest = faults;
      mesh_ = std::move(next.mesh);
      report_ = std::move(of_next);
      if (report_.sound())
        note_repair(repaired_, "vertex pulled apart where surfaces touch", next.pulled);
      if (faults == 0 || faults > kHopeless) break;
    }
    return *fewest;
  }

  TriangleMesh input_;
  Reversed reversed_;
  double unit_mm_;
  std::vector<Repair>& repaired_;
  StageReport& stage_;
  std::vector<bool> at_cut_;  ///< by point of the input
  TriangleMesh mesh_;         ///< the best one of the last cut
  MeshReport report_;         ///< on it
};

}  // namespace

Result<TriangleMesh> resolve_intersections(const TriangleMesh& closed, Reversed reversed,
                                           std::vector<Repair>& repaired, StageReport& stage) {
  TriangleMesh mesh = closed;
  merge_equal_points(mesh);
  return Resolution(std::move(mesh), reversed, repaired, stage).run();
}

}  // namespace clay::solid::inline repair
