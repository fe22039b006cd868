#pragma once
// The report of an export, as JSON and as text.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/pot_copy.hpp"
#include "claystack/export/job.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::cli {

/// The clay that finishing trimmed and added, with the weight as thrown: "foot ring", "trimmed 12 g
/// (6.30 cm3)".
[[nodiscard]] std::vector<std::pair<std::string, std::string>> finish_rows(
    const solid::ExportReport& report);

/// "a height of 12.3 mm", or "a height of 12.3 mm before the fall": walls of a collapsed pot are
/// measured on its parts as they stood.
[[nodiscard]] std::string thinnest_height(const solid::ExportReport& report);

/// How far the mesh in a file lies from the round solid, rounding and facets together, or the solid
/// of a STEP file from its section [mm]; 0 for other files.
[[nodiscard]] double distance_mm(const solid::ExportReport& report, const solid::FileReport& file);

/// Wall, lip and flange, each with its thinnest place.
[[nodiscard]] Json wall_parts_json(const std::vector<solid::PartWall>& parts);

/// `copies` describe those files of the report that are pots, in their order. Without a mesh there
/// are no figures of a solid. `goal`: to which the pot was scaled.
[[nodiscard]] Json export_json(const solid::ExportReport& report,
                               const std::vector<PotCopy>& copies,
                               const std::optional<solid::MetGoal>& goal);
void print_export(const Console& console, const solid::ExportReport& report,
                  const std::vector<PotCopy>& copies);

/// Prints the walls that were asked for, and warns of problems. Returns true if one of them fails.
bool print_problems(const Console& console, const solid::ExportReport& report);

/// The last lines: size, weight, capacity, wall and verdict. Nothing without a mesh.
void print_summary(const Console& console, const solid::ExportReport& report);

}  // namespace clay::cli
