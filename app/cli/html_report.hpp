#pragma once
#include "app/cli/json_output.hpp"
#include "claystack/export/job.hpp"

#include <string>

namespace clay::cli {

/// A page that prints on A4 and needs no other file: the main figures, the picture (PNG, may be
/// empty), the drawing, the map of the walls, then the proof and the work. The numbers are those of
/// `json`, the report as `export --json` prints it.
[[nodiscard]] std::string html_report(const Json& json, const solid::ExportReport& report,
                                      const solid::ExportOptions& options,
                                      const std::string& picture);

}  // namespace clay::cli
