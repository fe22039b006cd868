#include "app/cli/report_file.hpp"

#include "app/cli/export_json.hpp"
#include "app/cli/html_report.hpp"
#include "app/cli/packed_pot.hpp"
#include "core/json/json_text.hpp"
#include "core/text.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace clay::cli {

void set_report(const Pot& pot, solid::ExportRequest& request, const std::vector<PotCopy>& copies) {
  if (request.report_path.empty()) return;
  const bool page = ends_ignoring_case(request.report_path, ".html");
  const std::string picture = page ? picture_of(pot) : std::string();
  if (page && !pot.collapse) request.options.wall_spacing_mm = solid::kWallTableSpacingMm;
  request.report_text = [page, picture, copies,
                         options = request.options](const solid::ExportReport& report) {
    const Json json = export_json(report, copies, options.met_goal);
    return page ? html_report(json, report, options, picture) : json_document(json);
  };
}

}  // namespace clay::cli
