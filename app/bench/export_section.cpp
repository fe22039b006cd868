#include "app/bench/bellied_pot.hpp"
#include "app/bench/timing.hpp"
#include "claystack/export/job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <optional>

namespace clay::bench {
namespace {

using solid::MeshFormat;
using solid::Smoothing;

constexpr double kWallMm = 4.0;
constexpr double kFineMm = 1e-5;           ///< tolerance of the reference section
constexpr std::size_t kMaxSamples = 6000;  ///< six in each measured triangle

/// The settings and results of one export.
struct Run {
  std::string along;  ///< the setting that differs from run to run
  MeshFormat format = MeshFormat::stl_binary;
  solid::ExportOptions options;
  double bytes = 0.0, triangles = 0.0;
  double surface_mm = 0.0;  ///< largest distance found from the file to the smoothed pot
  double volume = 0.0;      ///< relative difference from the counted clay
  double wall_width_mm = 0.0;
  Spread seconds;
};

/// Distance from the outline of the section; the axis is not part of its surface.
double distance(const solid::Profile& section, glm::dvec2 at) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& polygon : section.pieces)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const auto& p = polygon[i];
      const auto& q = polygon[(i + 1) % polygon.size()];
      if (p.rho == 0.0 && q.rho == 0.0) continue;
      const glm::dvec2 a(p.rho, p.y), edge = glm::dvec2(q.rho, q.y) - a;
      const double t = std::clamp(glm::dot(at - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
      least = std::min(least, glm::length(at - a - t * edge));
    }
  return least;
}

/// Measured at corners and at edge midpoints, where a facet is farthest from the circle.
double surface_error(const solid::TriangleMesh& mesh, const solid::Profile& section) {
  const std::size_t stride = std::max<std::size_t>(1, 6 * mesh.triangles.size() / kMaxSamples);
  double worst = 0.0;
  const auto measure_at = [&](const glm::dvec3& p) {
    worst = std::max(worst, distance(section, {std::hypot(p.x, p.y), p.z}));
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride)
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3& a = mesh.points[mesh.triangles[i][k]];
      const glm::dvec3& b = mesh.points[mesh.triangles[i][(k + 1) % 3]];
      measure_at(a);
      measure_at(0.5 * (a + b));
    }
  return worst;
}

/// Exports, reads the bytes back and measures them.
bool examine(const Pot& pot, Run& run) {
  solid::MemoryStore store;
  const auto report = solid::run_export(pot, {{run.format, &store}}, run.options);
  if (!report) return false;
  const auto mesh = solid::decode_mesh(store.bytes(), run.format, "export");
  const auto section =
      solid::smooth_profile_of(pot.stack, {.mode = run.options.smoothing,
                                           .tolerance_mm = kFineMm,
                                           .min_wall_mm = {},
                                           .lip_fillet_mm = 0.0,
                                           .overshoot_limit_mm = run.options.tolerance_mm});
  const auto& certificate = report->files.front().certificate;
  if (!mesh || !section || !certificate) return false;
  run.bytes = static_cast<double>(store.bytes().size());
  run.triangles = static_cast<double>(mesh->triangles.size());
  run.surface_mm = surface_error(*mesh, section->section.profile);
  run.volume = std::abs(solid::signed_volume(*mesh) / pot.stack.volume_mm3() - 1.0);
  run.wall_width_mm = certificate->wall_upper_mm - certificate->wall_lower_mm;
  return true;
}

std::vector<Run> all_runs(const Effort& effort) {
  std::vector<Run> runs;
  const auto add = [&](const char* along, MeshFormat format) -> Run& {
    Run& run = runs.emplace_back();
    run.along = along;
    run.format = format;
    return run;
  };
  std::vector<double> tolerances{0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
  std::vector<std::size_t> segments{16, 32, 64, 128, 256};
  if (!effort.quick) {
    tolerances.insert(tolerances.end(), {0.005, 0.002, 0.001});
    segments.insert(segments.end(), {512, 1024, 2048});
  }
  for (const MeshFormat format : {MeshFormat::stl_binary, MeshFormat::obj, MeshFormat::drc})
    for (const double tolerance : tolerances)
      add("tolerance", format).options.tolerance_mm = tolerance;
  for (const std::size_t n : segments) add("segments", MeshFormat::stl_binary).options.segments = n;
  for (const Smoothing mode : {Smoothing::none, Smoothing::fair, Smoothing::exact})
    add("smoothing", MeshFormat::stl_binary).options.smoothing = mode;
  return runs;
}

std::string curve_of(const Run& run) {
  return fmt::format("{}, {}", solid::name_of(run.format), run.along);
}

void measure(const Pot& pot, std::vector<Run>& runs, const Effort& effort, Section& section) {
  std::vector<Work> works;
  for (Run& run : runs) {
    section.require(examine(pot, run), curve_of(run) + ": the export failed");
    works.push_back({curve_of(run), [&pot, &run] {
                       solid::MemoryStore store;
                       return seconds_of([&] {
                         (void)solid::run_export(pot, {{run.format, &store}}, run.options);
                       });
                     }});
  }
  const auto samples = time_rounds(works, rounds_of(effort));
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].seconds = spread_of(samples[i]);
}

Table table_of(const std::vector<Run>& runs) {
  Table table{
      "export_precision",
      "Error, size and run time of an export",
      {{"along", ""},
       {"format", ""},
       {"tolerance_mm", "mm"},
       {"smoothing", ""},
       {"triangles", ""},
       {"kilobytes", "kB"},
       {"ms", "ms"},
       {"iqr_ms", "ms"},
       {"surface_mm", "mm"},
       {"volume_error", "relative"},
       {"wall_width_mm", "mm"}},
      {},
      "Surface: the largest distance found from the file, read back, to the smoothed pot, at "
      "corners and in the middle of edges of at most 1,000 triangles. Wall: between the two bounds "
      "that the certificate proves. The tolerance applies once to the section, once to the chords "
      "around it and, in Draco files, once to every vertex; the error of the surface is at most "
      "their sum. Segments that are given replace the tolerance of the chords."};
  for (const Run& run : runs)
    table.rows.push_back(
        {run.along, std::string(solid::name_of(run.format)), run.options.tolerance_mm,
         std::string(solid::name_of(run.options.smoothing)),
         static_cast<std::int64_t>(run.triangles), 1e-3 * run.bytes, 1e3 * run.seconds.median,
         1e3 * run.seconds.range(), run.surface_mm, run.volume, run.wall_width_mm});
  return table;
}

template <class X, class Y>
Plot plot_of(const std::vector<Run>& runs, const char* id, const char* title, const char* x,
             const char* y, X x_of, Y y_of) {
  Plot plot{id, title, {x, true}, {y, true}, {}, "Each curve goes from coarse to fine."};
  for (const Run& run : runs) {
    if (run.along == "smoothing") continue;
    if (plot.curves.empty() || plot.curves.back().name != curve_of(run))
      plot.curves.emplace_back().name = curve_of(run);
    plot.curves.back().x.push_back(x_of(run));
    plot.curves.back().y.push_back(y_of(run));
  }
  return plot;
}

/// Bytes and time of Draco alone, for bits of each error and for its speeds.
std::optional<Table> draco_table(const Pot& pot, const Effort& effort) {
  solid::MemoryStore store;
  solid::ExportOptions options;
  if (!solid::run_export(pot, {{MeshFormat::stl_binary, &store}}, options)) return std::nullopt;
  const auto mesh = solid::decode_stl(store.bytes(), "export");
  if (!mesh) return std::nullopt;
  Table table{"export_draco",
              "Draco: bits and speed",
              {{"error_mm", "mm"},
               {"speed", ""},
               {"kilobytes", "kB"},
               {"of_stl_percent", "%"},
               {"ms", "ms"},
               {"iqr_ms", "ms"}},
              {},
              "The bits of the grid follow from the permitted error of a vertex. Encoding only."};
  std::vector<solid::DracoSettings> settings;
  for (const double error : {0.1, 0.01, 0.001}) settings.push_back({error, 8, 2});
  for (const int speed : {0, 1, 4, 6, 8, 10}) settings.push_back({0.01, 8, speed});
  std::vector<Work> works;
  std::vector<std::size_t> bytes(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i)
    works.push_back({"draco", [&, i] {
                       return seconds_of([&] {
                         const auto drc = solid::encode_drc(*mesh, settings[i]);
                         bytes[i] = drc ? drc->size() : 0;
                       });
                     }});
  const auto samples = time_rounds(works, rounds_of(effort));
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (bytes[i] == 0) return std::nullopt;  // built without Draco
    const Spread ms = spread_of(samples[i]);
    table.rows.push_back(
        {settings[i].max_error_mm, std::int64_t{settings[i].speed},
         1e-3 * static_cast<double>(bytes[i]),
         100.0 * static_cast<double>(bytes[i]) / static_cast<double>(store.bytes().size()),
         1e3 * ms.median, 1e3 * ms.range()});
  }
  return table;
}

std::vector<Plot> plots_of(const std::vector<Run>& runs) {
  const auto ms = [](const Run& r) { return 1e3 * r.seconds.median; };
  const auto kilobytes = [](const Run& r) { return 1e-3 * r.bytes; };
  const auto surface = [](const Run& r) { return r.surface_mm; };
  const auto wall = [](const Run& r) { return r.wall_width_mm; };
  const auto volume = [](const Run& r) { return r.volume; };
  const char *const mm = "largest error of the surface [mm]", *const time = "run time [ms]";
  return {
      plot_of(runs, "export_surface", "Surface against run time", time, mm, ms, surface),
      plot_of(runs, "export_bytes", "Surface against size", "size [kB]", mm, kilobytes, surface),
      plot_of(runs, "export_wall", "Proved wall bounds against run time", time,
              "between the bounds of the wall [mm]", ms, wall),
      plot_of(runs, "export_volume", "Volume against run time", time,
              "error of the file's volume, relative", ms, volume)};
}

/// The largest errors of all files.
struct Worst {
  double surface_share = 0.0;  ///< of the sum of tolerances
  double volume = 0.0, drc_volume = 0.0;
};

Worst worst_of(const std::vector<Run>& runs) {
  Worst worst;
  for (const Run& run : runs) {
    const bool drc = run.format == MeshFormat::drc;
    double& error = drc ? worst.drc_volume : worst.volume;
    error = std::max(error, run.volume);
    if (run.along == "tolerance")
      worst.surface_share = std::max(worst.surface_share,
                                     run.surface_mm / run.options.tolerance_mm / (drc ? 3.0 : 2.0));
  }
  return worst;
}

}  // namespace

Section export_section(const Effort& effort) {
  Section section;
  section.id = "export";
  section.title = "Files: error and size against run time";
  const Pot pot = bellied_pot(kWallMm);
  auto runs = all_runs(effort);
#ifndef CLAYSTACK_DRACO
  std::erase_if(runs, [](const Run& run) { return run.format == MeshFormat::drc; });
#endif
  effort.progress("exports");
  measure(pot, runs, effort, section);
  section.plots = plots_of(runs);
  section.tables = {table_of(runs)};
#ifdef CLAYSTACK_DRACO
  effort.progress("Draco");
  if (auto draco = draco_table(pot, effort))
    section.tables.push_back(std::move(*draco));
  else
    section.require(false, "Draco: the mesh to encode was not written");
#endif
  const Worst worst = worst_of(runs);
  add_at_most(section, "export_surface_share", counted(worst.surface_share), 1.0,
              "largest error of the surface over the sum of tolerances, in the series `tolerance`");
  section.values.push_back(
      {"export_volume_error", worst.volume, 0.0, "relative, maximum over STL and OBJ"});
  section.values.push_back(
      {"export_drc_volume_error", worst.drc_volume, 0.0, "relative, maximum over Draco files"});
  section.summary = fmt::format(
      "Cost of finer files. A bellied pot of 200 rings with throwing marks is smoothed, "
      "proved, written to memory, read back and verified. In the series `tolerance` the largest "
      "surface error found is {:.2f} of the sum of the tolerances of its file; the series "
      "`segments` sets the segments instead, and has no such bound. The volume of every STL and "
      "OBJ is within {:.1e} of the counted clay.",
      worst.surface_share, worst.volume);
  return section;
}

}  // namespace clay::bench
