#pragma once
// One path for a pot: scale and drain it once, take its section once, smooth it, prove it, and make
// of that the meshes, the drawing, the table of walls and the certificates.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/fallen.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/walls.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline job {

// ---- shrinkage -----------------------------------------------------------------------
// Clay shrinks as it dries and is fired: what shall come out at a size is made larger.

/// Nothing shrinks by more, and still is a pot.
inline constexpr double kMostShrinkage = 0.5;

/// Lengths grow by this where a piece loses the part `shrinkage` of each: 1 / (1 - s).
[[nodiscard]] constexpr double enlargement(double shrinkage) noexcept {
  return 1.0 / (1.0 - shrinkage);
}

/// `pot` in such a size that it has its own once it has shrunk: heights, radii and the way that a
/// collapsed part fell times 1 / (1 - s), so that clay grows by 1 / (1 - s)^3. Radii squared are
/// rounded to the nearest quantum; the ledger begins with what the result holds.
/// Errors of kind `bad_input`: a shrinkage outside 0 to kMostShrinkage, a result beyond the limits
/// of ClayStack.
Result<Pot> enlarged(const Pot& pot, double shrinkage);

// ---- request -------------------------------------------------------------------------

struct ExportOptions {
  double tolerance_mm = 0.02;  ///< chordal error along and around; vertex error of Draco
  Smoothing smoothing = Smoothing::fair;
  /// Smoothing leaves walls no thinner than this asks, see `SmoothingOptions`; the report compares
  /// the walls with it.
  WallDemand walls;
  double lip_fillet_mm = 0.0;
  std::optional<std::size_t> segments;       ///< force the number around
  std::optional<std::size_t> max_triangles;  ///< a coarser tolerance where the asked one needs more
  std::optional<double> drain_mm;  ///< diameter of a hole along the axis that opens closed cavities
  std::optional<double> wall_spacing_mm;  ///< measure the whole field of walls, see `wall_field`
  /// Part of each length that drying and firing take, see `enlarged`: the files are so much larger,
  /// and so are all lengths and volumes of the report.
  double shrinkage = 0.0;
  bool normals = false;            ///< for shading, in formats that have them (obj)
  bool allow_pieces = false;       ///< several pieces that do not touch, in one file
  bool measure_left_out = false;   ///< run the skipped stages too, and report what that saves
  bool full_verification = false;  ///< every file read again whole, and checked as a stranger's is
  std::string name = "pot";        ///< solid or object name inside the file
  std::string source;              ///< what messages call the pot; empty: they do not name it
  /// Asked before each stage and every few milliseconds, also by several threads at once. True: the
  /// job is an error (io). Only an encoder of Draco ends what it has begun.
  std::function<bool()> cancelled;
};

enum class FileKind {
  mesh,
  section,     ///< the drawing of `section_svg`
  wall_table,  ///< the table of `wall_table`
  given,       ///< bytes that the caller has made, such as a copy of the pot
};

/// A file to write.
struct FileRequest {
  std::string path;  ///< "-" is standard output
  FileKind kind = FileKind::mesh;
  MeshFormat format = MeshFormat::stl_binary;  ///< of a mesh
  std::string bytes = {};                      ///< of a given file
};

/// What the name's end asks for: .stl (binary), .obj, .drc, .svg (the section) or .csv (its walls).
/// Anything else is an error that lists them.
Result<FileRequest> file_request(const std::string& path);

struct ExportReport;

struct ExportRequest {
  ExportOptions options;
  std::vector<FileRequest> files;
  /// Writes PATH.certificate.json beside each mesh of a pot that stands.
  bool certificates = false;
  std::string report_path = {};  ///< file for `report_text`; empty: none
  std::function<std::string(const ExportReport&)> report_text = {};  ///< made after all else
};

// ---- report --------------------------------------------------------------------------
// Made of what the stages of the job return. All lengths and volumes are those of the solid as it
// is written, enlarged for its shrinkage.

/// Scale and drain.
struct Preparation {
  double shrinkage = 0.0;           ///< as asked for
  double drilled_mm3 = 0.0;         ///< clay taken for the drain
  double counted_volume_mm3 = 0.0;  ///< of the stack, drilled where asked
};

/// The section, smoothed and proved in the plane. Of a collapsed pot: of both parts before the
/// fall.
struct ProvedSection {
  SmoothedProfile smoothed;               ///< the steps, where there was no smoothing
  Smoothing smoothing = Smoothing::none;  ///< as done: straight walls need none
  std::string no_smoothing;               ///< why not; empty where there was
  PlanarCertificate planar;

  [[nodiscard]] const Profile& profile() const noexcept { return smoothed.section.profile; }
  [[nodiscard]] const std::vector<PieceShape>& shapes() const noexcept {
    return smoothed.section.shapes;
  }
};

struct SolidSize {
  std::size_t segments = 0;
  std::size_t triangles = 0;
  std::size_t shells = 0;
  double tolerance_mm = 0.0;  ///< as used: coarser than asked for where max_triangles demands it
  double chordal_error_mm = 0.0;
  double diameter_mm = 0.0;
  double height_mm = 0.0;
};

struct WallReport {
  double min_wall_mm = 0.0;  ///< of the solid before rounding
  Wall thinnest;             ///< of the section: where that is
  /// Smoothing `exact`: the least wall as steps, where an edge that overshoot has made is thinner.
  std::optional<double> as_steps_mm;
  std::vector<WallSample> field;   ///< of the section, where asked for
  std::optional<WallLimit> limit;  ///< that was asked for, for a solid of this size
};

struct VolumeReport {
  double solid_mm3 = 0.0;       ///< before rounding
  double error_relative = 0.0;  ///< to the counted clay, less what overlaps in a collapse
};

struct FileReport {
  std::string path;  ///< empty: in memory
  FileKind kind = FileKind::mesh;
  std::uint64_t bytes = 0;
  // Of a mesh:
  MeshFormat format = MeshFormat::stl_binary;
  std::string content_hash;   ///< XXH3-128
  double max_error_mm = 0.0;  ///< no vertex of the file is farther from its place
  Proof proof = Proof::margins;
  bool read_again = false;                      ///< false for pipes only
  std::optional<SolidCertificate> certificate;  ///< of a body of revolution: a pot that stands
  std::optional<MeshReport> full_verification;
};

struct StageTime {
  std::string name;
  double seconds = 0.0;
};

struct SkippedStage {
  std::string what;
  std::string why;
  std::optional<double> saved_s;  ///< measured where asked for, and where it can be
};

struct ExportReport {
  Preparation prepared;
  ProvedSection section;
  SolidSize size;
  WallReport walls;
  VolumeReport volume;
  std::optional<CollapsedSolid> collapsed;  ///< without its mesh
  std::vector<FileReport> files;            ///< one for each file asked for, in that order
  std::vector<StageTime> stages;
  std::vector<SkippedStage> left_out;

  [[nodiscard]] bool has_mesh() const noexcept;
  /// Of all meshes, between its bounds; of none: the solid's own [mm].
  [[nodiscard]] double thinnest_mm() const noexcept;
};

/// What a potter should know before it is printed, and where: in words, and as a place of the
/// written solid's section, where there is one.
struct Problem {
  std::string text;
  std::optional<ProfilePoint> at;
};

/// A wall below the limit, cavities without a drain hole, pieces that do not touch.
[[nodiscard]] std::vector<Problem> problems_of(const ExportReport& report);
/// Nothing where the wall is as thick as asked for, or nothing was.
[[nodiscard]] std::optional<std::string> thin_wall_of(const ExportReport& report);
[[nodiscard]] std::string text_of(const Cavity& cavity);

// ---- export job ----------------------------------------------------------------------

/// A mesh to write. The caller owns the store, and publishes it after the job has succeeded.
struct Output {
  MeshFormat format = MeshFormat::stl_binary;
  FileStore* store = nullptr;
  std::string name = {};  ///< what messages call the file; empty: as the pot
};

/// Steps of the stack that float32 cannot hold (below 2^-19 of the pot's reach) are levelled as
/// `profile_of` describes. A binary STL is streamed: no mesh is held in memory for it. Draco gets
/// more bits than the tolerance asks for where the margins need them. Where margins do not cover a
/// format's rounding, CGAL's exact test of the triangles as written takes their place; where that
/// fails, the job does, with the reason. `progress(stage)` is called as each stage begins.
///
/// Of a collapsed pot the two parts are united, whether they touch or not (see `collapsed_solid`);
/// its proof is the exact test of the triangles, and a budget of triangles is met by decimation.
/// Errors name the file that cannot be written, else `options.source`.
Result<ExportReport> run_export(const Pot& pot, const std::vector<Output>& outputs,
                                const ExportOptions& options,
                                const std::function<void(std::string_view)>& progress = {});

/// All files are whole and verified before the first one gets its name; a job that fails, or is
/// cancelled, leaves none. Without a mesh or a table of walls nothing is proved.
Result<ExportReport> export_files(const Pot& pot, const ExportRequest& request,
                                  const std::function<void(std::string_view)>& progress = {});

/// The same job with the meshes in memory, to report what they would be; no file is opened.
Result<ExportReport> rehearse_export(const Pot& pot, const ExportRequest& request,
                                     const std::function<void(std::string_view)>& progress = {});

}  // namespace clay::solid::inline job
