#pragma once
// A pot becomes files: what the command `claystack export` and the window have in common.

#include "app/cli/export_files.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

struct ExportDone {
  solid::ExportReport report;   ///< without a mesh or a table of walls: empty
  std::vector<PotCopy> copies;  ///< one for each pot
  std::optional<WallDemand> demand;
};

/// All files are whole and verified before the first one gets its name; one that fails, or is
/// cancelled (ExportOptions::cancelled), leaves none. `command.pot` names the pot in errors;
/// `command.walls` is loaded here. `progress` as in solid::run_export.
Result<ExportDone> export_files(const Pot& pot, ExportCommand& command,
                                const std::function<void(std::string_view)>& progress);

/// The same job with the meshes in memory, to tell what they would be; no file is opened.
Result<ExportDone> rehearse_export(const Pot& pot, ExportCommand& command,
                                   const std::function<void(std::string_view)>& progress);

/// What a potter should know before it is printed, and where: in words, and as a place of the
/// written solid's section, where there is one.
struct Problem {
  std::string text;
  std::optional<solid::ProfilePoint> at;
};
/// A wall below the demand, cavities without a drain hole, pieces that do not touch.
[[nodiscard]] std::vector<Problem> problems_of(const ExportDone& done);
/// Nothing where the wall is as thick as asked for, or nothing was.
[[nodiscard]] std::optional<std::string> thin_wall_of(const solid::ExportReport& report,
                                                      const std::optional<WallDemand>& demand);
[[nodiscard]] std::string text_of(const solid::Cavity& cavity);

/// For a solid of this size.
[[nodiscard]] std::optional<WallDemand> demand_for(const WallDemands& walls,
                                                   const solid::ExportReport& report);
/// Of all files, between its bounds; of no file: the solid's own [mm].
[[nodiscard]] double thinnest_mm(const solid::ExportReport& report);

/// As --smooth names them; `none` for any other.
[[nodiscard]] solid::Smoothing smoothing_of(std::string_view name);
/// "12%": a part, 0.12. Errors say what was expected.
Result<double> shrinkage_of(const std::string& text);

}  // namespace clay::cli
