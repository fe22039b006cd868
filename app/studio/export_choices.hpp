#pragma once
// Choices and figures of the export dialog: values that the window, its export thread and
// the worker of a web page exchange.

#include "app/cli/packed_pot.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"
#include "core/material.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

inline constexpr double kFinestMm = 0.001, kCoarsestMm = 1.0;  // tolerance [mm]
inline constexpr double kThickestDemandMm = 20.0;
inline constexpr double kLongestFairingMm = 50.0;
inline constexpr double kWidestFootMm = 20.0, kDeepestFootMm = 20.0, kLargestFilletMm = 20.0;
inline constexpr double kThickestGlazeMm = 2.0, kWidestDrainMm = 20.0, kMostGoalG = 10000.0;

/// The size of the finished pot: fired, if it shrinks.
enum class ExportSize { as_thrown, capacity, weight, height, diameter };

/// The settings of the export dialog.
struct ExportChoices {
  std::vector<solid::MeshFormat> meshes = {solid::MeshFormat::three_mf};
  bool step = false;
  bool section = false, dxf = false, pdf = false;  ///< the drawing; `section`: as SVG
  bool report = false, pot = false;
  std::string folder, name;
  double tolerance_mm = 0.02;
  solid::Smoothing smoothing = solid::Smoothing::fair;
  std::optional<double> smooth_length_mm{};  ///< of `fair`; 0: none; empty: the usual one
  std::string process;                       ///< as for --process; empty: none
  double min_wall_mm = 0.0;                  ///< 0: the limit of the process, if there is one
  double shrinkage_percent = 0.0;
  std::string material{kWet.id};  ///< of a GLB, as for --material
  /// As for --foot, --floor-fillet and --lip-fillet, of the wet pot; 0: none.
  double foot_width_mm = 0.0, foot_depth_mm = 4.0;
  double floor_fillet_mm = 0.0, lip_fillet_mm = 0.0;  ///< of the lip also: that of the process
  double glaze_mm = 0.0;                              ///< as for --glaze-allowance, fired
  double drain_mm = 0.0;                              ///< as for --drain; 0: none
  /// As for --holds, --weighs, --height and --diameter, with --fired if there is a shrinkage.
  ExportSize size = ExportSize::as_thrown;
  double holds_ml = 350.0, weighs_g = 400.0, height_mm = 100.0, diameter_mm = 100.0;
  friend bool operator==(const ExportChoices&, const ExportChoices&) = default;
};

/// A problem at a place of the pot.
struct Mark {
  glm::dvec2 place_mm{0.0};  ///< (rho, y), on the pot as it is on the wheel
  std::string text;
};

/// The results of an export. Sizes are those of the file, enlarged for shrinkage.
struct ExportFigures {
  struct Mesh {
    solid::MeshFormat format = solid::MeshFormat::stl_binary;
    std::uint64_t bytes = 0;
  };
  /// A mesh or a STEP file was written. Without one, no solid was made, and the sizes are 0.
  bool has_solid = false;
  std::size_t triangles = 0;
  std::vector<Mesh> meshes;
  double diameter_mm = 0.0, height_mm = 0.0, shrinkage = 0.0;
  double capacity_ml = 0.0;  ///< of the finished pot, to the brim; 0: it holds nothing
  double weight_g = 0.0;     ///< of the finished pot, without glaze
  bool fallen = false;       ///< walls are not measured
  double thinnest_mm = 0.0, thinnest_at_mm = 0.0;
  bool thinnest_in_floor = false;  ///< then the height is that of no wall
  bool closed_cavity = false;      ///< one that no drain opens
  double faired_mm = 0.0, moved_mm = 0.0, moved_at_mm = 0.0;  ///< of the fairing, if there is one
  std::vector<std::string> problems;
  std::size_t failed = 0;   ///< problems that fail a limit; they come first
  std::vector<Mark> marks;  ///< problems with a place
};
/// "1 limit failed", as the command prints.
[[nodiscard]] std::string failed_text(std::size_t count);

/// A request and the pot that it is for.
struct ExportJob {
  Pot pot;
  solid::ExportRequest request;
};
/// The pot at the chosen size, and the request for it. Errors: an unknown or unreadable process; a
/// size that the pot cannot have; cancelled.
[[nodiscard]] Result<ExportJob> job_of(const ExportChoices& choices, const Pot& pot,
                                       const std::function<bool()>& cancelled = {});
/// Paths of the output files, in the order of the request.
[[nodiscard]] std::vector<std::string> paths_of(const ExportChoices& choices);
/// Those of the output files that exist already.
[[nodiscard]] std::vector<std::string> standing_files(const ExportChoices& choices);

enum class ExportKind {
  preview,  ///< computes the figures without writing
  files
};
/// Runs the export. `thumbnail`: picture of the pot for a 3MF, drawn if it is empty and necessary;
/// the pot outlives it.
Result<ExportFigures> run_export(const Pot& pot, const ExportChoices& choices, ExportKind kind,
                                 cli::Thumbnail& thumbnail, const std::function<bool()>& cancelled,
                                 const std::function<void(std::string_view)>& show_stage);

}  // namespace clay::studio
