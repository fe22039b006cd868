#pragma once
// The stages of `claystack check`: examine a pot or a mesh, then print the verdict.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/wall_options.hpp"

#include "claystack/export/check.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/repair.hpp"
#include "claystack/export/walls.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::cli {

/// Rays that sample the walls of a mesh, unless --wall-samples is given.
inline constexpr std::size_t kWallSamples = 10'000;

struct CheckCommand {
  std::string file;
  WallOptions walls;
  std::string certificate;  ///< empty: no certificate is checked
  std::optional<std::size_t> wall_samples_asked;
  bool repair = false;
  solid::RepairOptions repair_options;
  bool dry_run = false;
  std::optional<std::size_t> max_triangles;
  std::string out;     ///< empty: nothing is written
  std::string accept;  ///< "sound" or "prints": exit status 0 also for a mesh that prints without
                       ///< being sound; empty: not given, "sound"

  [[nodiscard]] std::size_t wall_samples() const {
    return wall_samples_asked.value_or(kWallSamples);
  }
  [[nodiscard]] bool accept_prints() const { return accept == "prints"; }
  [[nodiscard]] bool changes_mesh() const { return repair || max_triangles; }
};

/// The verdict on a mesh.
enum class MeshState {
  sound,
  prints,  ///< not sound, but `solid::slicer_unites` it
  will_not_print,
  unreadable
};
/// "sound", "prints", "will not print" or "unreadable".
[[nodiscard]] std::string_view name_of(MeshState state);
[[nodiscard]] MeshState state_of(const solid::TriangleMesh& mesh, const solid::MeshReport& report);

/// "open edge (3): triangle 12 at (1, 2, 3) mm".
[[nodiscard]] std::string problem_text(const solid::MeshProblem& problem);

/// Repairs and decimation of a mesh before it was written.
struct RepairSummary {
  MeshState before = MeshState::sound;    ///< of the input file
  std::vector<solid::MeshProblem> found;  ///< in the input file
  std::vector<solid::Repair> repaired;
  std::vector<solid::FilledHole> holes;
  std::optional<solid::ThickenedWall> thickened;
  solid::SurfaceChange change;  ///< of the written mesh
  double reading_mm = 0.0;      ///< upper bound of the rounding of points as they were read
  std::optional<double> wrapped_mm;
  std::optional<double> volume_before_mm3;    ///< of the input file; empty: it has no volume
  std::size_t triangles_before = 0;           ///< before decimation
  std::optional<double> decimation_error_mm;  ///< set if the mesh was decimated
  std::string path;                           ///< empty: nothing was written
  solid::MeshFormat format = solid::MeshFormat::stl_binary;
  std::size_t bytes = 0;
};

enum class Grade { pass, warn, fail };
[[nodiscard]] std::string_view name_of(Grade grade);

/// A result that is not about the soundness of the mesh.
struct Finding {
  std::string check;  ///< "walls", "process", "geometry", "contents" or "certificate"
  Grade grade = Grade::pass;
  std::string text;
};

struct Verdict {
  MeshState state = MeshState::sound;
  solid::MeshReport mesh;        ///< of the written mesh, after repairs
  bool examined = true;          ///< false: no mesh was made, `mesh` holds only problems
  std::optional<Error> failure;  ///< the reason why no result was made; `mesh` is that of the input
  std::vector<Finding> findings;
  std::optional<double> wall_mm;                   ///< of pots
  std::vector<solid::PartWall> wall_parts;         ///< of pots
  std::optional<solid::SampledWall> wall_sampled;  ///< of meshes, if requested
  bool wall_united = false;                        ///< sampled on the union of the shells
  std::vector<std::string> notes;                  ///< sound, but noteworthy
  std::optional<RepairSummary> repair_summary;
  std::optional<solid::SolidCertificate> certificate;  ///< the certificate that was checked
  bool certificate_holds = false;
  std::optional<double> certified_wall_mm;  ///< of a certificate that holds, also one in a 3MF

  void add(std::string check, Grade grade, std::string text) {
    findings.push_back({std::move(check), grade, std::move(text)});
  }
  /// No finding fails, and the mesh is sound, or accepted because it prints.
  [[nodiscard]] bool passes(bool accept_prints) const;
};

/// A verdict of one problem, for input that was not examined.
Verdict not_examined(MeshState state, std::string what, std::string where);

Result<Verdict> check_pot(std::string_view bytes, const CheckCommand& command,
                          const Console& console);
/// `input`: the file, if it has been read. Writes `command.out` if set. An error of kind `io`, in
/// advance, for a mesh that needs more memory than available.
Result<Verdict> check_mesh_file(solid::MeshFormat format, const CheckCommand& command,
                                const Console& console, std::optional<std::string> input = {});

/// The same for a mesh in memory, which has no contents beside its triangles. `command.file` names
/// it in messages; nothing is repaired or written.
Result<Verdict> check_mesh(const solid::TriangleMesh& mesh, const CheckCommand& command,
                           const Console& console);

/// An error of kind `io`, in advance, for a mesh that needs more memory than available.
Result<solid::MeshReport> report_on(const solid::TriangleMesh& mesh);

/// A file and the mesh that a reader finds in it.
struct WrittenMesh {
  std::string bytes;
  solid::TriangleMesh mesh;
  solid::MeshReport report;
};

/// Repairs and decimates `mesh` if requested, checks the contents of the resulting file, and writes
/// it as `command.out`. `found` is the report on the mesh. Errors: `unsound` if the mesh cannot be
/// repaired, or if the file would be worse than it.
Result<WrittenMesh> repair_and_write(const solid::TriangleMesh& mesh,
                                     const solid::MeshReport& found, const CheckCommand& command,
                                     RepairSummary& summary, Progress& progress);

/// Cavities of the mesh, and the parts of the file besides the mesh: a pot, a certificate, claims.
Result<void> check_contents(std::string_view bytes, const solid::TriangleMesh& mesh,
                            solid::MeshFormat format, const CheckCommand& command,
                            Verdict& verdict);

/// Empty if no certificate is checked.
Result<std::optional<solid::SolidCertificate>> read_certificate(const CheckCommand& command);
/// Compares all bytes of the file with `verdict.certificate`.
Result<void> check_certificate(std::string_view bytes, solid::MeshFormat format,
                               const CheckCommand& command, Verdict& verdict);

/// The body that a printer makes of a mesh: of shells that a slicer unites, their union, because a
/// surface inside of another shell bounds no wall.
struct PrintedBody {
  const solid::TriangleMesh* file = nullptr;
  std::optional<solid::TriangleMesh> united;
  std::string unknown;  ///< the reason why walls cannot be measured; empty: they can

  [[nodiscard]] const solid::TriangleMesh& mesh() const { return united ? *united : *file; }
};

/// The mesh outlives it; `verdict` holds the report on it. Without limits no shells are united. An
/// error of kind `io`: the shells cannot be united for lack of memory.
Result<PrintedBody> printed_body(const solid::TriangleMesh& mesh, const CheckCommand& command,
                                 const Verdict& verdict);
/// Size and undersides, upright as the file has them.
void check_process(const PrintedBody& body, const glm::dvec3& size, const CheckCommand& command,
                   Verdict& verdict);
/// Compares the walls with the limit: those that a certificate of these bytes proves, without one
/// a sample.
Result<void> check_walls(const PrintedBody& body, const glm::dvec3& size,
                         const CheckCommand& command, const Console& console, Verdict& verdict);

/// The object of samples/schema/check.schema.json.
Json verdict_json(const std::string& file, const Verdict& verdict, bool accept_prints);
void print_verdict(const Console& console, const std::string& file, const Verdict& verdict);

}  // namespace clay::cli
