#pragma once
// The report of an export as JSON.

#include "app/cli/json_output.hpp"
#include "app/cli/pot_copy.hpp"
#include "claystack/export/job.hpp"

#include <optional>
#include <vector>

namespace clay::cli {

/// Wall, lip and flange, each with its thinnest place.
[[nodiscard]] Json wall_parts_json(const std::vector<solid::PartWall>& parts);

/// The object of samples/schema/report.schema.json. `copies` describe those files of the report
/// that are pots, in their order. Without a mesh there are no figures of a solid. `goal`: the goal
/// to which the pot was scaled.
[[nodiscard]] Json export_json(const solid::ExportReport& report,
                               const std::vector<PotCopy>& copies,
                               const std::optional<solid::MetGoal>& goal);

}  // namespace clay::cli
