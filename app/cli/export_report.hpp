#pragma once
// What an export did, for scripts and for people.

#include "app/cli/console.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/wall_demand.hpp"
#include "claystack/export/job.hpp"

#include <optional>
#include <string>
#include <vector>

namespace clay::cli {

/// `paths` are those of all files, drawings and pots among them; the report has one file for each
/// mesh, and `copies` one for each pot. Without a mesh there is no solid to speak of.
[[nodiscard]] Json export_json(const solid::ExportReport& report,
                               const std::vector<PotCopy>& copies,
                               const std::vector<std::string>& paths,
                               const std::optional<WallDemand>& demand);
void tell_export(const Console& console, const solid::ExportReport& report,
                 const std::vector<PotCopy>& copies, const std::vector<std::string>& paths);

/// Whether a file may be thinner somewhere than demanded; says so, and by how much.
bool tell_thin_wall(const Console& console, const solid::ExportReport& report,
                    const std::optional<WallDemand>& demand);

}  // namespace clay::cli
