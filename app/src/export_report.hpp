#pragma once
// What an export did, for scripts and for people.

#include "claystack/export/export_job.hpp"
#include "console.hpp"

#include <string>
#include <vector>

namespace clay::app {

/// `paths` are those of all files, drawings among them; the report has one file for each mesh.
[[nodiscard]] Json export_json(const solid::ExportReport& report,
                               const std::vector<std::string>& paths);
void tell_export(const Console& console, const solid::ExportReport& report,
                 const std::vector<std::string>& paths);

}  // namespace clay::app
