#pragma once
// What `claystack check` does in turn: examine a pot or a mesh, then tell the verdict.

#include "app/cli/console.hpp"
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
  std::string certificate;  ///< empty: none is asked after
  std::size_t wall_samples = 10'000;
  bool repair = false;
  std::optional<std::size_t> max_triangles;
  std::string out;  ///< empty: nothing is written

  [[nodiscard]] bool changes_mesh() const { return repair || max_triangles; }
};

/// What became of a mesh on its way to the file that was written.
struct Mending {
  std::vector<solid::MeshProblem> found;  ///< in the file that was read
  std::vector<solid::Repair> repaired;
  std::size_t triangles_before = 0;           ///< decimation
  std::optional<double> decimation_error_mm;  ///< where there was any
  std::string path;
  solid::MeshFormat format = solid::MeshFormat::stl_binary;
  std::size_t bytes = 0;
};

struct Verdict {
  solid::MeshReport mesh;         ///< after mending: of the mesh that was written
  bool examined = true;           ///< false: no mesh was made, `mesh` holds only problems
  std::optional<double> wall_mm;  ///< of pots
  std::optional<solid::SampledWall> wall_sampled;  ///< of meshes, where it was asked for
  std::vector<std::string> notes;                  ///< sound, but worth knowing
  std::optional<Mending> mending;
  std::optional<solid::SolidCertificate> certificate;  ///< the one asked after
  bool certificate_holds = false;
};

/// A verdict of one problem, for what was never examined.
Verdict unsound(std::string what, std::string where);

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command);
/// Writes `command.out` where it is named. An error of kind `io`, in advance, for a mesh that takes
/// more memory than there is.
Result<Verdict> check_mesh_file(solid::MeshFormat format, const CheckCommand& command,
                                const Console& console);

Json verdict_json(const std::string& file, const Verdict& verdict);
void tell(const Console& console, const std::string& file, const Verdict& verdict);

}  // namespace clay::cli
