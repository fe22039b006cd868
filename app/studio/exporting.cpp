// The card of an export and the job behind it.

#include "app/studio/app_state.hpp"

#include "claystack/export/job.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::studio {
namespace {

/// The solid is larger than the pot that the view shows.
glm::dvec2 on_pot(const solid::ProfilePoint& place, double shrinkage) {
  return glm::dvec2(place.rho, place.y) / solid::enlargement(shrinkage);
}

void mark(AppState& shop, const Exporter::Outcome& outcome) {
  shop.marks.clear();
  shop.marked = outcome.pot;
  for (const solid::Problem& problem : solid::problems_of(*outcome.done))
    if (problem.at)
      shop.marks.push_back({on_pot(*problem.at, outcome.done->prepared.shrinkage), problem.text});
}

std::string text_of(const solid::ExportReport& report, const std::vector<std::string>& paths) {
  std::uint64_t bytes = 0;
  for (const solid::FileReport& file : report.files)
    if (file.kind == solid::FileKind::mesh) bytes += file.bytes;
  return !report.has_mesh()
             ? fmt::format("{} file{} written", paths.size(), paths.size() == 1 ? "" : "s")
             : fmt::format(
                   "{} file{} written; {} triangles, {:.2f} MB of meshes, each proved and "
                   "read again",
                   paths.size(), paths.size() == 1 ? "" : "s", report.size.triangles,
                   1e-6 * static_cast<double>(bytes));
}

void take_files(AppState& shop, Exporter::Outcome outcome) {
  ExportCard& card = shop.exporting;
  if (outcome.cancelled) {
    card.said = "Cancelled; no file was written";
    shop.log("export cancelled");
    return;
  }
  if (!outcome.done) {
    card.said.clear();
    card.problem = outcome.done.error().message;
    shop.log("error: " + card.problem);
    return;
  }
  card.written = outcome.paths;
  card.said = text_of(*outcome.done, outcome.paths);
  if (outcome.done->has_mesh()) {
    mark(shop, outcome);
    card.shown = std::move(*outcome.done);
  }
  for (const std::string& path : outcome.paths) shop.log("exported: " + path);
  if (shop.overlay != Overlay::export_files)
    shop.notices.say(Grade::note, card.said,
                     1e-9 * static_cast<double>(shop.host.frame_ns()) + 6.0);
  shop.settings.folder = outcome.wish.folder;
  shop.settings.process = outcome.wish.process;
}

void take_rehearsal(AppState& shop, Exporter::Outcome outcome) {
  ExportCard& card = shop.exporting;
  card.shown.reset();
  card.problem.clear();
  if (outcome.done) {
    mark(shop, outcome);
    card.shown = std::move(*outcome.done);
    shop.log(fmt::format("export rehearsed: {} triangles", card.shown->size.triangles));
  } else {
    card.problem = outcome.done.error().message;
  }
}

/// Without what changes nothing of the solid.
ExportWish solid_of(ExportWish wish) {
  wish.folder.clear();
  wish.section = wish.pot = false;
  return wish;
}

}  // namespace

void ask_for_export(AppState& shop) {
  ExportCard& card = shop.exporting;
  shop.potter.release();
  if (card.wish.name.empty()) card.wish.process = shop.settings.process;
  const std::string scene = shop.potter.scene().name;
  card.wish.name = shop.file.empty() ? scene.empty() ? "pot" : scene : shop.file.stem().string();
  card.wish.folder = shop.settings.folder;
  if (card.wish.folder.empty()) card.wish.folder = std::filesystem::current_path().string();
  card.rehearsed = {};
  card.rehearsed.name.assign(1, '\n');  // no pot has it: the first rehearsal is due
  card.shown.reset();
  card.problem.clear();
  card.said.clear();
  card.written.clear();
  shop.overlay = Overlay::export_files;
}

void write_export(AppState& shop) {
  shop.exporting.written.clear();
  shop.exporting.problem.clear();
  shop.exporting.said.clear();
  shop.log("export begun");
  shop.exporter.write(shop.potter.shared_pot(), shop.exporting.wish);
}

void look_at_export(AppState& shop) {
  ExportCard& card = shop.exporting;
  const bool open = shop.overlay == Overlay::export_files;
  const bool writes = shop.exporter.running() == Exporter::Kind::files;
  if (open && !writes && solid_of(card.wish) != card.rehearsed) {
    card.rehearsed = solid_of(card.wish);
    card.shown.reset();
    card.problem.clear();
    if (card.wish.stl || card.wish.obj || card.wish.drc)
      shop.exporter.rehearse(shop.potter.shared_pot(), card.wish);
  }
  if (!shop.host.real_time()) shop.exporter.wait();  // a script's frames tell the same every time
  auto outcome = shop.exporter.take();
  if (!outcome) return;
  if (outcome->kind == Exporter::Kind::files)
    take_files(shop, std::move(*outcome));
  else if (open)
    take_rehearsal(shop, std::move(*outcome));
}

}  // namespace clay::studio
