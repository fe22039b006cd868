#pragma once
// Figures and phrases that the reports of an export share: JSON, text and HTML.

#include "claystack/export/job.hpp"

#include <string>
#include <utility>
#include <vector>

namespace clay::cli {

/// The clay that finishing trimmed and added, with the wet weight: "foot ring", "trimmed 12 g
/// (6.30 cm3)".
[[nodiscard]] std::vector<std::pair<std::string, std::string>> finish_rows(
    const solid::ExportReport& report);

/// "a height of 12.3 mm", or "a height of 12.3 mm before the fall": walls of a collapsed pot are
/// measured on its parts as they stood.
[[nodiscard]] std::string thinnest_height(const solid::ExportReport& report);

/// Distance of the mesh in a file from the round solid, by rounding and facets together, or of the
/// solid in a STEP file from its section [mm]; 0 for other files.
[[nodiscard]] double distance_mm(const solid::ExportReport& report, const solid::FileReport& file);

/// Of the round solid; of a collapsed pot, of its mesh.
[[nodiscard]] solid::PotSize size_in_files(const solid::ExportReport& report);

/// Of a drawing or a table, whose name `export_files` has checked.
[[nodiscard]] const solid::SectionFile& section_facts(const solid::FileReport& file);

}  // namespace clay::cli
