#include "app/cli/export_figures.hpp"

#include "core/size_text.hpp"

#include <fmt/format.h>

#include <cassert>

namespace clay::cli {
namespace {

using solid::ExportReport;
using solid::FileKind;
using solid::FileReport;

/// The clay that finishing moved: "12 g (6.67 cm3)".
std::string clay_text(const ExportReport& report, double mm3) {
  return fmt::format("{} g ({} cm3)", size_text(1e-3 * mm3 * report.maker->clay.density_g_cm3, 0),
                     size_text(1e-3 * mm3, 2));
}

}  // namespace

const solid::SectionFile& section_facts(const FileReport& file) {
  const solid::SectionFile* const facts = solid::section_file(file.path);
  assert(facts != nullptr);
  return *facts;
}

double distance_mm(const ExportReport& report, const FileReport& file) {
  if (file.kind == FileKind::mesh)
    return file.max_error_mm + report.size.chordal_error_mm +
           (report.collapsed ? report.collapsed->max_move_mm : 0.0);
  return file.kind == FileKind::step ? file.max_error_mm : 0.0;
}

std::string thinnest_height(const ExportReport& report) {
  return fmt::format("a height of {} mm{}", size_text(report.walls.thinnest.from.y, 1),
                     report.collapsed ? " before the fall" : "");
}

solid::PotSize size_in_files(const ExportReport& report) {
  if (report.maker) return report.maker->thrown.size;
  return {report.size.diameter_mm, report.size.height_mm, 0.0};
}

std::vector<std::pair<std::string, std::string>> finish_rows(const ExportReport& report) {
  const solid::FinishLedger& ledger = report.section.finish;
  std::vector<std::pair<std::string, std::string>> rows;
  const auto add = [&](const char* what, const char* how, double mm3) {
    if (mm3 != 0.0) rows.emplace_back(what, how + clay_text(report, mm3));
  };
  add("foot ring", "trimmed ", ledger.foot_trimmed_mm3);
  add("floor fillet", "added ", ledger.floor_added_mm3);
  add("glaze allowance", "trimmed ", ledger.glaze_trimmed_mm3);
  return rows;
}

}  // namespace clay::cli
