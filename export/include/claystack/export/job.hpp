#pragma once
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

// ---- export job ----------------------------------------------------------------------
// stack -> profile -> certificate -> files, each read again and held against the certificate; a
// stage that fails stops the job before anything is published.

struct ExportOptions {
  double tolerance_mm = 0.02;  ///< chordal error along and around; vertex error of Draco
  Smoothing smoothing = Smoothing::fair;
  std::optional<double> min_wall_mm;  ///< no thinner by smoothing, see `SmoothingOptions`
  double lip_fillet_mm = 0.0;
  std::optional<std::size_t> segments;       ///< force the number around
  std::optional<std::size_t> max_triangles;  ///< a coarser tolerance where the asked one needs more
  std::optional<double> drain_mm;  ///< diameter of a hole that opens closed cavities, see `drain`
  std::optional<double> wall_spacing_mm;  ///< measure the whole field of walls, see `wall_field`
  /// Part of each length that drying and firing take, see `enlarged`: the files are so much larger,
  /// and so are all lengths and volumes of the report.
  double shrinkage = 0.0;
  bool normals = false;            ///< for shading, in formats that have them (obj)
  bool allow_pieces = false;       ///< several pieces that do not touch, in one file
  bool measure_left_out = false;   ///< do what is left out after all, to tell what that saved
  bool full_verification = false;  ///< every file read again whole, and checked as a stranger's is
  std::string name = "pot";        ///< solid or object name inside the file
  /// Asked before each stage and every few milliseconds, also by several threads at once. True: the
  /// job is an error (io). Only an encoder of Draco ends what it has begun.
  std::function<bool()> cancelled;
};

/// A file to write. The caller owns the store, and publishes it after the job has succeeded.
struct Output {
  MeshFormat format = MeshFormat::stl_binary;
  FileStore* store = nullptr;
};

struct FileReport {
  MeshFormat format = MeshFormat::stl_binary;
  std::uint64_t bytes = 0;
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
  double shrinkage = 0.0;    ///< as asked for: all that follows is of the larger solid
  PlanarCertificate planar;  ///< of a collapsed pot: of its parts before the fall
  std::vector<PieceShape> shapes;
  Smoothing smoothing = Smoothing::none;  ///< as done: straight walls need none
  std::vector<KeptSteps> kept_steps;      ///< where smoothing gave way
  double overshoot_mm = 0.0, taken_mm = 0.0, lip_fillet_mm = 0.0;  ///< as in `SmoothedProfile`
  double max_ring_error_relative = 0.0;                            ///< `exact`
  /// `exact`: the least wall as steps, where an edge that overshoot has made is thinner [mm].
  std::optional<double> wall_as_steps_mm;
  std::optional<CollapsedSolid> collapsed;  ///< without its mesh
  std::size_t segments = 0;
  std::size_t triangles = 0;
  std::size_t shells = 0;
  double tolerance_mm = 0.0;  ///< as used: coarser than asked for where max_triangles demands it
  double chordal_error_mm = 0.0;
  double min_wall_mm = 0.0;            ///< of the solid before rounding
  Wall thinnest;                       ///< of the profile: where that is
  std::vector<WallSample> wall_field;  ///< of the profile, where asked for
  double diameter_mm = 0.0, height_mm = 0.0;
  double drilled_mm3 = 0.0;            ///< clay taken for the drain
  double counted_volume_mm3 = 0.0;     ///< of the stack, drilled where asked
  double volume_mm3 = 0.0;             ///< of the solid before rounding
  double volume_error_relative = 0.0;  ///< to the counted clay, less what overlaps in a collapse
  std::vector<FileReport> files;       ///< one for each output, in that order
  std::vector<StageTime> stages;
  std::vector<SkippedStage> left_out;
};

/// Steps of the stack that float32 cannot hold (below 2^-19 of the pot's reach) are levelled as
/// `profile_of` describes. A binary STL is streamed: no mesh is held in memory for it. Draco gets
/// more bits than the tolerance asks for where the margins need them. Where margins do not cover a
/// format's rounding, CGAL's exact test of the triangles as written takes their place; where that
/// fails, the job does, with the reason. `progress(stage)` is called as each stage begins.
///
/// Of a collapsed pot the two parts are united, whether they touch or not (see `collapsed_solid`);
/// its proof is the exact test of the triangles, and a budget of triangles is met by decimation.
Result<ExportReport> run_export(const Pot& pot, const std::vector<Output>& outputs,
                                const ExportOptions& options,
                                const std::function<void(std::string_view)>& progress = {});

}  // namespace clay::solid::inline job
