#pragma once
// One path for a pot: scale and drain it, compute its section, smooth, finish and prove it, and
// write meshes, the drawing, the wall table and certificates from the result. Each stage runs once.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/fallen.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/maker.hpp"
#include "claystack/export/option_ranges.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/walls.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline job {

// ---- shrinkage -----------------------------------------------------------------------
// Clay shrinks in drying and firing, so the files are enlarged to give the piece its final size.

/// The factor on lengths that compensates a shrinkage s: 1 / (1 - s).
[[nodiscard]] constexpr double enlargement(double shrinkage) noexcept {
  return 1.0 / (1.0 - shrinkage);
}

/// Scales `pot` so that it has its present size after shrinking: heights, radii and the
/// displacement of a collapsed part by 1 / (1 - s), and so the volume by 1 / (1 - s)^3. Squared
/// radii are rounded to the nearest quantum; the ledger begins with the clay of the result. Errors
/// of kind `bad_input`: a shrinkage outside 0 to kMostShrinkage, a result beyond the limits of
/// ClayStack.
Result<Pot> enlarged(const Pot& pot, double shrinkage);

/// The remedy that the message about a pot in pieces names: `ExportOptions::allow_pieces`.
inline constexpr const char* kPermitPieces = "permit several pieces";

// ---- goal ----------------------------------------------------------------------------
// The pot scaled to a capacity, a weight or a size.

struct ExportOptions;

/// One goal scales the pot evenly. Two scale height and radius apart: one of them is the height or
/// the diameter.
struct Goal {
  std::optional<double> holds_ml;  ///< to the brim
  std::optional<double> weighs_g;
  std::optional<double> height_mm;
  std::optional<double> diameter_mm;
  bool to_fill_line = false;  ///< `holds_ml` up to the fill line of the options
  bool fired = false;         ///< all are of the finished pot: fired and glazed. Requires a
                              ///< shrinkage or a glaze allowance
};

/// A goal that a pot was scaled to.
struct MetGoal {
  Goal goal;
  bool glazed = false;
  double radius_factor = 1.0, height_factor = 1.0;
};
/// "holds 350 ml to the brim, 120 mm high, fired and glazed".
[[nodiscard]] std::string text_of(const MetGoal& met);

struct GoalReport {
  Pot pot;  ///< scaled; its ledger begins with the clay of the result
  MetGoal met;
};

/// Scales a standing pot until its smoothed section meets the goal within 1e-6, or within 1e-3
/// where a figure jumps over it because the smoothing changes with the size. Errors: `bad_input`
/// for goals that are missing, contradict each other or cannot be met (no floor, nothing to hold);
/// `unsound`, with the reason, if a wall of the result is below the limit of the options.
Result<GoalReport> scaled_to(const Pot& pot, const Goal& goal, const ExportOptions& options);

// ---- request -------------------------------------------------------------------------

/// `check_ranges` refuses numbers out of their range before an export begins.
struct ExportOptions {
  /// Maximum chordal error along the profile and around the axis, and vertex error of Draco.
  double tolerance_mm = 0.02;
  Smoothing smoothing = Smoothing::fair;
  /// Length of the fairing on the pot, before it is enlarged for shrinkage [mm]; of a standing pot
  /// (see `SmoothingOptions`). 0: none. Empty: `usual_smooth_length_mm` with smoothing `fair`, else
  /// 0.
  std::optional<double> smooth_length_mm;
  /// The limit that smoothing respects (see `SmoothingOptions`) and with which the report compares
  /// the walls.
  WallDemand walls;
  /// Empty: the radius that the process requires, with smoothing `fair` of a standing pot; else 0.
  std::optional<double> lip_fillet_mm;
  Finish finish;                        ///< of a standing pot
  std::optional<std::size_t> segments;  ///< number of segments around the axis
  /// Limit of triangles; overrides the tolerance if necessary.
  std::optional<std::size_t> max_triangles;
  std::optional<double> drain_mm;  ///< diameter of a hole along the axis that opens closed cavities
  std::optional<double> wall_spacing_mm;  ///< spacing of the `wall_field`; empty: no field
  /// Fraction of each length lost in drying and firing, see `enlarged`. The files are enlarged
  /// accordingly, as are all lengths and volumes of the report.
  double shrinkage = 0.0;
  /// Figures for `ExportReport::maker`; density and shrinkage come from the pot and from above.
  ClayFigures clay;
  double fill_line_mm = kFillLineMm;  ///< below the brim of the pot in use
  std::optional<MetGoal> met_goal;    ///< of the pot: for the drawing and the report
  StepWalls step_walls = StepWalls::spline;
  GlbMesh glb = GlbMesh::draco;
  std::string material = "terracotta";  ///< of a GLB, as in FileContents
  bool wall_map = false;           ///< colours of the wall in a GLB and a 3MF of a standing pot
  bool normals = false;            ///< write normals for shading (obj only)
  bool allow_pieces = false;       ///< accept pieces that do not touch
  bool measure_left_out = false;   ///< run the skipped stages as well, and report the time saved
  bool full_verification = false;  ///< also check every file like a foreign mesh
  std::string name = "pot";        ///< solid or object name inside the file
  std::string pot_file;  ///< the pot as a file (CBOR), which a 3MF carries; empty: it does not
  /// Draws a picture of the pot for a 3MF, as PNG, while another thread reads the model back; an
  /// empty function or picture: none.
  std::function<std::string()> draw_thumbnail;
  std::string source;  ///< name of the pot in messages; empty: none
  /// Called before each stage and every few milliseconds, also by several threads at once. If it
  /// returns true, the job ends with an error (io). Only a running Draco encoder finishes first.
  std::function<bool()> cancelled;
  /// Called for each mesh of a standing pot before any is written, with its name, the number of
  /// triangles and the size of the file: exact for a binary STL, else an estimate. May be empty.
  std::function<void(const std::string& name, std::size_t triangles, std::uint64_t bytes)>
      announce_size;
  /// Called before meshes are held in memory, with the estimate [bytes]; an error ends the job. A
  /// binary STL and drawings need none; a collapsed pot has too few triangles to matter.
  std::function<Result<void>(std::uint64_t bytes)> expect_memory;
};

/// A length for fairing that keeps the shapes that the tool made: the radius of the tool, or half
/// of its height if that is less [mm]. 0 if the pot does not remember its tool.
[[nodiscard]] double tool_length_mm(const Pot& pot);

/// `tool_length_mm` of a pot that was thrown with clay rules, up to a tolerance of 0.1 mm; beyond,
/// facets are coarser than the marks that fairing removes. Else 0.
[[nodiscard]] double usual_smooth_length_mm(const Pot& pot, double tolerance_mm);

enum class FileKind {
  mesh,
  step,        ///< the solid for CAD
  section,     ///< the drawing of the section; of a collapsed pot `section_svg`
  wall_table,  ///< the table of `wall_table`
  given,       ///< bytes from the caller, such as a copy of the pot
};

/// A file to write.
struct FileRequest {
  /// "-" is standard output. A drawing and a table need one of the endings of kSectionFiles.
  std::string path;
  FileKind kind = FileKind::mesh;
  MeshFormat format = MeshFormat::stl_binary;  ///< of a mesh
  std::string bytes = {};                      ///< of a given file
};

/// The endings of files that are made from the section, without a mesh, and their contents.
struct SectionFile {
  FileKind kind;
  std::string_view ending;  ///< in lower case
  std::string_view name;    ///< in reports
  std::string_view title;   ///< for people
};
inline constexpr std::array kSectionFiles{
    SectionFile{FileKind::step, ".step", "step", "solid for CAD"},
    SectionFile{FileKind::step, ".stp", "step", "solid for CAD"},
    SectionFile{FileKind::section, ".svg", "svg", "drawing"},
    SectionFile{FileKind::section, ".dxf", "dxf", "drawing"},
    SectionFile{FileKind::section, ".pdf", "pdf", "drawing"},
    SectionFile{FileKind::wall_table, ".csv", "csv", "walls along the section"}};

/// The entry for the ending of this path, ignoring case; null: another kind of file.
[[nodiscard]] const SectionFile* section_file(std::string_view path) noexcept;

/// ".step or .stp for the solid for CAD, .svg, .dxf or .pdf for the drawing, ...".
[[nodiscard]] std::string section_endings();

/// The kind of file by its extension: that of a mesh (`mesh_format_of`) or one of kSectionFiles.
/// Any other extension is an error that lists these.
Result<FileRequest> file_request(const std::string& path);

struct ExportReport;

struct ExportRequest {
  ExportOptions options;
  std::vector<FileRequest> files;
  /// Writes PATH.certificate.json beside each mesh of a standing pot.
  bool certificates = false;
  std::string report_path = {};  ///< file for `report_text`; empty: none
  /// Called after all other files; required with a `report_path`.
  std::function<std::string(const ExportReport&)> report_text = {};
};

// ---- report --------------------------------------------------------------------------
// The results of the stages. All lengths and volumes are those of the written solid, enlarged for
// shrinkage.

/// A printer or glaze may close a narrower drain hole [mm].
inline constexpr double kLeastDrainMm = 2.0;

/// Scale and drain.
struct Preparation {
  double shrinkage = 0.0;           ///< as requested, 0 to below 1
  double drain_mm = 0.0;            ///< diameter of the hole that opens cavities; 0: none
  double drilled_mm3 = 0.0;         ///< clay removed for the drain
  double counted_volume_mm3 = 0.0;  ///< volume of the stack, after drilling and finishing
};

/// The section, smoothed and proved in the plane. For a collapsed pot: both parts before the fall.
struct ProvedSection {
  SmoothedProfile smoothed;               ///< the steps, if not smoothed
  Smoothing smoothing = Smoothing::none;  ///< as applied: straight walls need none
  std::string no_smoothing;               ///< the reason; empty if smoothed
  FinishLedger finish;
  std::optional<Profile> glazed;  ///< the faces of the glaze, if there is an allowance for it
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
  double tolerance_mm = 0.0;  ///< as used; coarser than requested if max_triangles requires it
  double chordal_error_mm = 0.0;
  glm::dvec3 extents_mm{0.0};  ///< width, depth and height; of a fallen pot all differ
  double diameter_mm = 0.0;    ///< the larger of width and depth
  double height_mm = 0.0;
};

struct WallReport {
  /// Lower bound for the solid with its facets, rounded as in a binary STL: the wall of the pot. Of
  /// a fallen pot that of its parts, less the displacement by the seam and rounding. An estimate
  /// for a fallen pot with `max_triangles`: decimation is measured at the vertices.
  double min_wall_mm = 0.0;
  Wall thinnest;  ///< the thinnest place of the section
  /// Smoothing `exact`: the minimum wall of the steps, if overshoot made a thinner edge.
  std::optional<double> as_steps_mm;
  std::vector<WallSample> field;   ///< of the section, if requested
  std::vector<PartWall> parts;     ///< wall, lip and flange, with the field
  std::optional<WallLimit> limit;  ///< the requested limit for a solid of this size
};

/// The limits of the requested process apart from walls.
struct ProcessReport {
  std::optional<ProcessLimits> limits;
  /// Of a collapsed pot as of a mesh: `at` is the distance from the axis and the height.
  std::optional<Overhang> overhang;
};

struct VolumeReport {
  double solid_mm3 = 0.0;       ///< before rounding
  double error_relative = 0.0;  ///< relative to the counted clay, without the overlap in a collapse
};

/// The solid in a STEP file. Its volume and its distance from the section are proved by closed form
/// from the numbers in the file.
struct StepReport {
  StepWalls walls = StepWalls::spline;
  std::size_t faces = 0;
  double deviation_mm =
      0.0;  ///< bound of the distance between its section and the pot's, both ways
  double volume_mm3 = 0.0;
  double volume_error_relative = 0.0;  ///< relative to the counted clay
  double min_wall_mm = 0.0;            ///< of its section
};

struct FileReport {
  std::string path;  ///< empty: in memory
  FileKind kind = FileKind::mesh;
  std::uint64_t bytes = 0;
  // For a mesh:
  MeshFormat format = MeshFormat::stl_binary;
  std::string content_hash;   ///< XXH3-128
  double max_error_mm = 0.0;  ///< largest distance of a vertex in the file from its exact position
  Proof proof = Proof::margins;
  bool read_back = false;  ///< false for pipes only
  std::optional<SolidCertificate>
      certificate;  ///< for a body of revolution, which is a standing pot
  std::optional<MeshReport> full_verification;
  std::optional<StepReport> step;  ///< of a STEP file; `max_error_mm` is its deviation
};

struct StageTime {
  std::string name;
  double seconds = 0.0;
};

struct SkippedStage {
  std::string what;
  std::string why;
  std::optional<double> saved_s;  ///< if measured
};

struct ExportReport {
  Preparation prepared;
  ProvedSection section;
  SolidSize size;
  WallReport walls;
  ProcessReport process;
  VolumeReport volume;
  std::optional<MakerNumbers> maker;        ///< of a standing pot
  std::optional<MakerNumbers> fallen;       ///< of a collapsed pot, see `fallen_numbers`
  std::optional<CollapsedSolid> collapsed;  ///< without its mesh
  std::vector<FileReport> files;            ///< one for each requested file, in that order
  std::vector<StageTime> stages;
  std::vector<SkippedStage> left_out;

  /// True if a mesh or a STEP file was written.
  [[nodiscard]] bool has_solid() const noexcept;
  /// Lower bound of the wall over all solids written; without any, of the pot [mm].
  [[nodiscard]] double thinnest_mm() const noexcept;
};

/// The drawing of a standing pot at 1:1, as in an .svg.
[[nodiscard]] std::string drawing_svg(const ExportReport& report, const ExportOptions& options);

enum class ProblemKind { thin_wall, too_large, cavity, drain, overhang, bodies, lip_fillet };

/// The check that it belongs to, of a pot and of a mesh: "walls", "process" or "geometry".
[[nodiscard]] std::string check_name(ProblemKind kind);

/// A problem for printing, with its place on the section of the written solid, if it has one.
struct Problem {
  std::string text;
  std::optional<ProfilePoint> at;
  bool fails = true;  ///< else a warning
  ProblemKind kind = ProblemKind::thin_wall;
  /// Of a thin wall its thickness [mm], of a drain hole its diameter [mm], of an overhang its angle
  /// [deg].
  double figure = 0.0;
};

/// Fails: a wall below the limit, a size above it, in a fired process a closed cavity and a drain
/// hole narrower than kLeastDrainMm. Warnings: without a limit a wall that no process allows, other
/// closed cavities and narrow drain holes, overhangs above the limit, several bodies or pieces, in
/// a file a lip with a smaller fillet than requested.
[[nodiscard]] std::vector<Problem> problems_of(const ExportReport& report);
/// The same for the solid, of which no mesh need be written.
[[nodiscard]] std::vector<Problem> problems_of_solid(const ExportReport& report);
/// Empty if the wall meets the limit, or if there is no limit.
[[nodiscard]] std::optional<std::string> thin_wall_of(const ExportReport& report);
[[nodiscard]] std::string text_of(const Cavity& cavity);

// ---- export job ----------------------------------------------------------------------

/// A mesh to write. The caller owns the store and publishes it after the job has succeeded.
struct Output {
  MeshFormat format = MeshFormat::stl_binary;
  FileStore* store = nullptr;
  std::string name = {};  ///< name of the file in messages; empty: the name of the pot
};

/// Steps of the stack that float32 cannot represent (below 2^-19 of the pot's extent) are levelled
/// as described at `profile_of`. A binary STL is streamed: no mesh is held in memory for it. Draco
/// gets more bits than the tolerance requires if the margins need them. If the margins do not cover
/// the rounding of a format, CGAL tests the written triangles exactly; if that fails, the job fails
/// with the reason. `progress(stage)` is called at the start of each stage.
///
/// The two parts of a collapsed pot are united (see `collapsed_solid`); the proof is the exact test
/// of the triangles, and a triangle budget is met by decimation. Errors name the file that cannot
/// be written, otherwise `options.source`. `bad_input`: options out of range, or that this pot
/// cannot have. `unsound`: the pot fails a check (pieces, section, walls after a finish). `io`:
/// reading, writing, memory, cancelled, or a library failed.
Result<ExportReport> run_export(const Pot& pot, const std::vector<Output>& outputs,
                                const ExportOptions& options,
                                const std::function<void(std::string_view)>& progress = {});

/// Publishes all files together, after all are complete and verified; a failed or cancelled job
/// leaves none. A drawing shows the section as proved; a collapsed pot is only drawn, as .svg. Two
/// requests for one file are refused (bad_input).
Result<ExportReport> export_files(const Pot& pot, const ExportRequest& request,
                                  const std::function<void(std::string_view)>& progress = {});

/// The meshes of the same job, in memory, for a preview: no file is opened, and other files are not
/// made, nor listed in the report.
Result<ExportReport> preview_export(const Pot& pot, const ExportRequest& request,
                                    const std::function<void(std::string_view)>& progress = {});

}  // namespace clay::solid::inline job
