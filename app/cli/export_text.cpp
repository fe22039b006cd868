#include "app/cli/export_text.hpp"

#include "app/cli/export_figures.hpp"
#include "app/cli/maker_table.hpp"
#include "core/size_text.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace clay::cli {
namespace {

using solid::ExportReport;
using solid::FileKind;
using solid::FileReport;

/// The smallest --tolerance. A smaller change of a wall gives no warning.
constexpr double kLeastShownMm = 1e-5;

std::string_view proof_of(const FileReport& file) {
  return file.proof == solid::Proof::margins
             ? "the margins of the profile exceed the rounding"
             : "no two triangles in the file intersect (exact test)";
}

void print_file(const Console& console, const ExportReport& report, const FileReport& file) {
  console.print(fmt::format("{}: {} bytes, within {:.2g} mm of the round solid{}", file.path,
                            file.bytes, distance_mm(report, file),
                            file.read_back ? ", read back" : ""));
  console.detail(fmt::format("  {}; {}{}", words_of_name(solid::name_of(file.format)),
                             proof_of(file), file.full_verification ? "; fully checked" : ""));
  if (const auto& c = file.certificate)
    console.detail(
        fmt::format("  minimum wall between {:.4f} and {:.4f} mm, volume within {:.2g} mm3",
                    c->wall_lower_mm, c->wall_upper_mm, c->volume_bound_mm3));
}

void print_step(const Console& console, const FileReport& file) {
  const solid::StepReport& step = *file.step;
  console.print(fmt::format("{}: {} bytes, {} faces, within {:.2g} mm{}", file.path, file.bytes,
                            step.faces, file.max_error_mm, file.read_back ? ", read back" : ""));
  console.detail("  step; closed and embedded: the section of its surfaces is strictly simple");
  console.detail(fmt::format(
      "  minimum wall {:.4f} mm; volume {:.3f} cm3, relative difference to the counted clay {:.1e}",
      step.min_wall_mm, step.volume_mm3 / 1000.0, step.volume_error_relative));
}

void print_collapse(const Console& console, const solid::CollapsedSolid& collapsed) {
  const auto cm3 = [](double mm3) { return mm3 / 1000.0; };
  console.print(fmt::format(
      "collapsed: {:.3f} cm3 standing, {:.3f} cm3 fallen; they overlap by {:.3f} cm3, so the "
      "union holds {:.3f} cm3",
      cm3(collapsed.lower_mm3), cm3(collapsed.upper_mm3), cm3(collapsed.overlap_mm3),
      cm3(collapsed.union_mm3)));
}

/// The walls that fairing moved, and where the walls made its length shorter.
void print_fairing(const Console& console, const solid::FairingReport& fairing) {
  if (fairing.length_mm == 0.0) return;
  console.detail(fmt::format(
      "faired over {:.3g} mm: walls moved by at most {:.3f} mm, at a height of {:.1f} mm",
      fairing.length_mm, fairing.moved_mm, fairing.moved_at_mm));
  if (fairing.shortened.empty()) return;
  const solid::ShortenedFairing& first = fairing.shortened.front();
  console.detail(fmt::format(
      "smoothing length reduced in {}; the first, at heights from {:.2f} to {:.2f} mm, has {:.3g} "
      "mm",
      counted(fairing.shortened.size(), "place"), first.from_mm, first.to_mm, first.length_mm));
}

/// The places where smoothing kept steps: one line for each reason.
void print_smoothing(const Console& console, const ExportReport& report) {
  print_fairing(console, report.section.smoothed.fairing);
  for (const auto reason : {solid::KeptFor::wall, solid::KeptFor::overshoot, solid::KeptFor::volume,
                            solid::KeptFor::certificate}) {
    const auto is = [&](const solid::KeptSteps& kept) { return kept.reason == reason; };
    const auto first = std::find_if(report.section.smoothed.guard.begin(),
                                    report.section.smoothed.guard.end(), is);
    if (first == report.section.smoothed.guard.end()) continue;
    console.detail(fmt::format(
        "steps kept (reason: {}) in {}; the first at heights from {:.2f} to {:.2f} mm, where the "
        "smoothed wall would have {:.3f} mm",
        solid::name_of(reason),
        counted(static_cast<std::size_t>(std::ranges::count_if(report.section.smoothed.guard, is)),
                "place"),
        first->from_mm, first->to_mm, first->smoothed_mm));
  }
  if (report.walls.as_steps_mm)
    console.warn(
        fmt::format("exact smoothing gives a wall of {} mm at height {:.1f} mm, where the "
                    "unsmoothed wall is at least {} mm; --smooth none keeps the steps",
                    bound_text(report.walls.min_wall_mm, 3), report.walls.thinnest.from.y,
                    bound_text(*report.walls.as_steps_mm, 3)));
  if (report.section.smoothed.taken_mm >= kLeastShownMm)
    console.warn(
        fmt::format("smoothing may have thinned walls by {:.2g} mm, because no other clay "
                    "was available to keep the volume",
                    report.section.smoothed.taken_mm));
}

void print_shrinkage(const Console& console, const ExportReport& report) {
  if (report.prepared.shrinkage == 0.0) return;
  const double fired = 1.0 - report.prepared.shrinkage;
  const solid::PotSize size = size_in_files(report);
  console.detail(fmt::format(
      "enlarged for a shrinkage of {:g} %: {:.2f} mm wide and {:.2f} mm high in the files, {:.2f} "
      "mm wide and {:.2f} mm high after firing",
      100.0 * report.prepared.shrinkage, size.diameter_mm, size.height_mm, fired * size.diameter_mm,
      fired * size.height_mm));
}

void print_solid(const Console& console, const ExportReport& report) {
  console.detail(fmt::format(
      "proved: {}closed and embedded, from {} profile vertices; {} triangles in "
      "{}",
      report.collapsed ? "each part before the fall " : "", report.section.planar.vertices,
      report.size.triangles, counted(report.size.shells, "shell")));
  console.detail(
      fmt::format("volume {:.3f} cm3, relative difference {}to the counted clay {:.1e}; minimum "
                  "wall {} mm at {}; chordal error {:.3g} mm",
                  report.volume.solid_mm3 / 1000.0, report.collapsed ? "with overlap " : "",
                  report.volume.error_relative, bound_text(report.thinnest_mm(), 2),
                  thinnest_height(report), report.size.chordal_error_mm));
  if (!report.walls.parts.empty())
    console.detail("thinnest places: " + solid::text_of(report.walls.parts));
  print_shrinkage(console, report);
  if (report.collapsed) print_collapse(console, *report.collapsed);
  print_smoothing(console, report);
  for (const auto& [what, why, saved] : report.left_out)
    if (saved)
      console.print(
          fmt::format("skipped: {} ({}), saved {:.2g} s", words_of_name(what), why, *saved));
}

std::string verdict_of(const ExportReport& report) {
  std::size_t faults = 0, notes = 0;
  for (const solid::Problem& problem : solid::problems_of(report))
    ++(problem.fails ? faults : notes);
  const std::string solid =
      std::string(report.collapsed ? "collapsed; " : "") + "closed and without self-intersections";
  if (faults > 0) return fmt::format("{}, but {} failed", solid, counted(faults, "limit"));
  return notes > 0 ? fmt::format("{}; {}", solid, counted(notes, "warning")) : solid;
}

/// As precise as the line on the limit, if there is one.
std::string wall_row(const ExportReport& report) {
  return at_least_mm(report.thinnest_mm(), report.walls.limit ? 3 : 2) + ", thinnest at " +
         thinnest_height(report);
}

}  // namespace

void print_export(const Console& console, const ExportReport& report,
                  const std::vector<PotCopy>& copies) {
  if (report.has_solid()) print_solid(console, report);
  if (report.prepared.drilled_mm3 > 0.0)
    console.print(fmt::format("drain hole: {:g} mm wide, {:.3f} cm3 of clay removed",
                              report.prepared.drain_mm, report.prepared.drilled_mm3 / 1000.0));
  for (const auto& [what, clay] : finish_rows(report)) console.print(what + ": " + clay);
  auto copy = copies.begin();
  for (const FileReport& file : report.files) {
    switch (file.kind) {
      case FileKind::mesh:
        print_file(console, report, file);
        break;
      case FileKind::step:
        print_step(console, file);
        break;
      case FileKind::section:
      case FileKind::wall_table:
        console.print(fmt::format("{}: {}", file.path, section_facts(file).title));
        break;
      case FileKind::given:
        console.print(copy_text(*copy++, file.path));
        break;
    }
  }
}

bool print_problems(const Console& console, const ExportReport& report) {
  bool fails = false;
  for (const solid::Problem& problem : solid::problems_of(report)) {
    if (problem.fails)
      console.error(problem.text);
    else
      console.warn(problem.text);
    fails = fails || problem.fails;
  }
  if (report.walls.limit && report.has_solid() && !solid::thin_wall_of(report))
    console.print("walls: " + solid::wall_text(report.thinnest_mm(), *report.walls.limit));
  return fails;
}

void print_summary(const Console& console, const ExportReport& report) {
  if (report.has_solid())
    print_maker_table(console, maker_json(report), wall_row(report), verdict_of(report));
}

}  // namespace clay::cli
