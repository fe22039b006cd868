#pragma once
// The stages of `claystack check`: examine a pot or a mesh, then print the verdict.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/wall_options.hpp"

#include "claystack/export/check.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

struct CheckCommand {
  std::string file;
  WallOptions walls;
  std::string certificate;  ///< empty: no certificate is checked
  std::size_t wall_samples = 10'000;
  bool repair = false;
  solid::RepairOptions repair_options;
  bool dry_run = false;
  std::optional<std::size_t> max_triangles;
  std::string out;  ///< empty: nothing is written

  [[nodiscard]] bool changes_mesh() const { return repair || max_triangles; }
};

/// Repairs and decimation of a mesh before it was written.
struct RepairSummary {
  std::vector<solid::MeshProblem> found;  ///< in the input file
  std::vector<solid::Repair> repaired;
  std::vector<solid::FilledHole> holes;
  solid::SurfaceChange change;
  std::optional<double> wrapped_mm;
  double volume_before_mm3 = 0.0;             ///< of the input file; meaningless for an open mesh
  std::size_t triangles_before = 0;           ///< before decimation
  std::optional<double> decimation_error_mm;  ///< set if the mesh was decimated
  std::string path;                           ///< empty: nothing was written
  solid::MeshFormat format = solid::MeshFormat::stl_binary;
  std::size_t bytes = 0;
};

struct Verdict {
  solid::MeshReport mesh;         ///< of the written mesh, after repairs
  bool examined = true;           ///< false: no mesh was made, `mesh` holds only problems
  std::optional<double> wall_mm;  ///< of pots
  std::optional<solid::SampledWall> wall_sampled;  ///< of meshes, if requested
  std::vector<std::string> notes;                  ///< sound, but noteworthy
  std::optional<RepairSummary> repair_summary;
  std::optional<solid::SolidCertificate> certificate;  ///< the certificate that was checked
  bool certificate_holds = false;
};

/// A verdict of one problem, for input that was not examined.
Verdict unsound(std::string what, std::string where);

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command);
/// Writes `command.out` if set. An error of kind `io`, in advance, for a mesh that needs more
/// memory than available.
Result<Verdict> check_mesh_file(solid::MeshFormat format, const CheckCommand& command,
                                const Console& console);

Json verdict_json(const std::string& file, const Verdict& verdict);
void print_verdict(const Console& console, const std::string& file, const Verdict& verdict);

}  // namespace clay::cli
