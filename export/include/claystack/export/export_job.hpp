#pragma once
// stack -> profile -> certificate -> solid -> independent checks -> formats, in that order;
// a stage that fails stops the job before anything is encoded.

#include "claystack/engine/pot.hpp"
#include "claystack/engine/result.hpp"
#include "claystack/export/certificate.hpp"
#include "claystack/export/collapsed_solid.hpp"
#include "claystack/export/mesh_check.hpp"
#include "claystack/export/mesh_formats.hpp"
#include "claystack/export/profile.hpp"
#include "claystack/export/profile_smoothing.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {

struct ExportOptions {
  double tolerance_mm = 0.02;  ///< chordal error along and around; vertex error of Draco
  Smoothing smoothing = Smoothing::fair;
  std::optional<std::size_t> segments;  ///< force the number around
  bool allow_pieces = false;            ///< several pieces that do not touch, in one file
  std::string name = "pot";             ///< solid or object name inside the file
};

struct EncodedMesh {
  MeshFormat format = MeshFormat::stl_binary;
  std::string bytes;
  double max_error_mm = 0.0;  ///< largest move of a vertex, measured on the decoded bytes
};

struct StageTime {
  std::string name;
  double seconds = 0.0;
};

struct LeftOut {
  std::string what;
  std::string why;
};

struct ExportReport {
  PlanarCertificate certificate;  ///< of the parts before the fall where the pot has collapsed
  MeshReport mesh;                ///< of the mesh as float32 files hold it
  std::vector<PieceShape> shapes;
  Smoothing smoothing = Smoothing::none;  ///< as done: walls too thin for `fair` stay as they are
  double min_wall_mm = 0.0;  ///< of the mesh before rounding: the profile's, times cos(pi/n)
  /// Without its mesh. The proof of the whole is then `mesh`: no self-intersection by exact
  /// predicates, on the very numbers that files of float32 hold.
  std::optional<CollapsedSolid> collapsed;
  std::size_t segments = 0;
  double chordal_error_mm = 0.0;
  double counted_volume_mm3 = 0.0;     ///< of the stack
  double volume_mm3 = 0.0;             ///< of the mesh before rounding
  double volume_error_relative = 0.0;  ///< of the mesh and, where parts overlap, the overlap
  std::vector<StageTime> stages;
  std::vector<LeftOut> left_out;
};

struct ExportResult {
  ExportReport report;
  std::vector<EncodedMesh> files;  ///< one for each format asked for, in that order
};

/// Steps of the stack that float32 cannot hold (below 2^-20 of the largest radius) are levelled
/// as `profile_of` describes. Draco gets more bits than the tolerance asks for where the walls
/// need them. `progress(stage)` is called as each stage begins. Of a collapsed pot the two parts
/// are united, whether they touch or not; pieces are those of the parts.
Result<ExportResult> run_export(const Pot& pot, const std::vector<MeshFormat>& formats,
                                const ExportOptions& options,
                                const std::function<void(std::string_view)>& progress = {});

}  // namespace clay::solid
