#include "app/cli/check.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/mesh_input.hpp"
#include "app/cli/mesh_unit.hpp"

#include "claystack/export/formats.hpp"
#include "claystack/export/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace clay::cli {
namespace {

using solid::MeshFormat;
using solid::TriangleMesh;

/// A slicer unites only the triangles that it reads.
MeshState as_sliced(MeshState state, bool slicer_reads_less) {
  return slicer_reads_less && state == MeshState::prints ? MeshState::will_not_print : state;
}

/// The maximum displacement of a point by reading [mm]: half a unit of the last place of float32
/// along each axis, in formats with decimals, doubles, a unit or transformations.
double reading_error_mm(const TriangleMesh& mesh, MeshFormat format) {
  if (format == MeshFormat::stl_binary || format == MeshFormat::drc) return 0.0;
  double reach = 0.0;
  for (const glm::dvec3& p : mesh.points)
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(p[axis])) reach = std::max(reach, std::abs(p[axis]));
  return std::sqrt(3.0) * 0x1p-24 * reach;
}

/// Warns of a wall that is too thick for an opening: it closes the opening and fills the cavity
/// behind it.
void warn_of_filled_gaps(const RepairSummary& summary, Verdict& verdict) {
  constexpr double kMostShare = 0.2;  // corners fill a smaller share
  if (!summary.thickened || summary.thickened->filled_share <= kMostShare) return;
  verdict.add(
      "geometry", Grade::warn,
      fmt::format("the wall of {:.4g} mm fills gaps: {:.0f} % of the places sampled just beyond "
                  "the wall are clay; a smaller --thicken leaves the gaps open",
                  summary.thickened->asked_mm, 100.0 * summary.thickened->filled_share));
}

/// Warns of a wall that is thinner than requested somewhere, or much thicker everywhere.
void warn_of_wall(const solid::ThickenedWall& wall, Verdict& verdict) {
  constexpr double kMostMedian = 1.16;
  if (wall.least_mm < wall.asked_mm)
    verdict.add("geometry", Grade::warn,
                fmt::format("the wall is thinner than requested in places: {:.4g} mm of {:.4g} mm "
                            "at the thinnest sample, as beside rims and sharp edges",
                            wall.least_mm, wall.asked_mm));
  if (wall.median_mm > kMostMedian * wall.asked_mm)
    verdict.add("geometry", Grade::warn,
                fmt::format("the wall is thicker than requested: half of the places have more than "
                            "{:.4g} mm instead of {:.4g} mm",
                            wall.median_mm, wall.asked_mm));
}

/// A repair that makes no wall must not seem to have made one.
void report_thickening(const RepairSummary& summary, const CheckCommand& command,
                       Verdict& verdict) {
  if (summary.thickened) {
    warn_of_filled_gaps(summary, verdict);
    return warn_of_wall(*summary.thickened, verdict);
  }
  if (command.repair_options.thicken_mm)
    verdict.add("geometry", Grade::warn,
                "--thicken has no effect: it makes a wall around a surface with a wide opening, "
                "and this mesh has none. A wall that is closed keeps its thickness; to use "
                "--thicken, delete one of its two faces in a mesh editor first");
}

/// The file ended before its last facet: the result has holes where facets are missing, or caps.
void warn_of_missing_facets(const std::optional<solid::FacetCount>& missing,
                            const RepairSummary& summary, Verdict& verdict) {
  if (!missing) return;
  std::string text = fmt::format("{} of {} facets are missing, because the file ends early",
                                 missing->counted - missing->there, missing->counted);
  if (!summary.holes.empty()) {
    double widest_mm = 0.0;
    for (const solid::FilledHole& hole : summary.holes)
      widest_mm = std::max(widest_mm, hole.extent_mm);
    text += summary.holes.size() == 1 ? fmt::format("; a hole of {:.4g} mm was filled", widest_mm)
                                      : fmt::format("; {} holes of up to {:.4g} mm were filled",
                                                    summary.holes.size(), widest_mm);
  }
  verdict.add("contents", Grade::warn, std::move(text));
}

/// Facts of the file besides its mesh.
struct FileFacts {
  MeshFormat format;
  bool slicer_reads_less = false;
  std::optional<solid::FacetCount> missing;
};

/// Repairs if requested, and gives its verdict on the mesh, or on the result. If no result was
/// made, the verdict is on the mesh, with the failure.
Result<TriangleMesh> judged(TriangleMesh mesh, FileFacts facts, CheckCommand command,
                            Progress& progress, Verdict& verdict) {
  bool& slicer_reads_less = facts.slicer_reads_less;
  command.repair_options.parts_missing = facts.missing.has_value();
  const auto name = [&](const Error& error) {
    return failure(error.kind, command.file + ": " + error.message);
  };
  progress.stage("checking");
  if (command.changes_mesh()) {
    auto found = report_on(mesh);
    if (!found) return name(found.error());
    verdict.mesh = std::move(*found);
    verdict.state = as_sliced(state_of(mesh, verdict.mesh), slicer_reads_less);
    RepairSummary summary;
    summary.reading_mm = reading_error_mm(mesh, facts.format);
    auto repaired = repair_and_write(mesh, verdict.mesh, command, summary, progress);
    if (!repaired) {
      verdict.failure = name(repaired.error()).value();
      return mesh;
    }
    report_thickening(summary, command, verdict);
    warn_of_missing_facets(facts.missing, summary, verdict);
    mesh = std::move(repaired->mesh);
    verdict.mesh = std::move(repaired->report);
    summary.before = as_sliced(summary.before, std::exchange(slicer_reads_less, false));
    verdict.repair_summary = std::move(summary);
  } else {
    auto report = report_on(mesh);
    if (!report) return name(report.error());
    verdict.mesh = std::move(*report);
  }
  verdict.state = as_sliced(state_of(mesh, verdict.mesh), slicer_reads_less);
  return mesh;
}

Result<TriangleMesh> read_mesh(MeshFile& file, const CheckCommand& command, FileFacts& facts,
                               Verdict& verdict) {
  if (command.repair) {
    const auto missing = file.missing_facets();
    if (!missing) return tl::make_unexpected(missing.error());
    facts.missing = *missing;
  }
  return file.read({"checking", solid::check_memory(1)},
                   {.repair = command.repair,
                    .notes = &verdict.notes,
                    .slicer_reads_less = &facts.slicer_reads_less});
}

void warn_of_unit(MeshFormat format, Verdict& verdict) {
  if (const auto doubt = doubted_unit(verdict.mesh.size_mm, format))
    verdict.add("geometry", Grade::warn,
                *doubt + "; scale it in a slicer, or make a pot with claystack import --height MM");
}

/// A file that cannot be read no longer matches its certificate.
Result<Verdict> unread_with_certificate(std::string_view bytes, MeshFormat format,
                                        const CheckCommand& command, Verdict verdict) {
  return check_certificate(bytes, format, command, verdict).map([&] {
    verdict.examined = false;
    verdict.state = MeshState::unreadable;
    return std::move(verdict);
  });
}

}  // namespace

Result<solid::MeshReport> report_on(const TriangleMesh& mesh) {
  const std::string job = fmt::format("checking {} triangles", mesh.triangles.size());
  const MemoryRoom room = memory_room();
  if (auto fits = expect_room(job, solid::check_memory(mesh.triangles.size())); !fits)
    return tl::make_unexpected(fits.error());
  // The estimate may be too low for this mesh.
  return solid::check_mesh(mesh).map_error([&](Error error) {
    error.message = fmt::format("{}: {}; {} were available within {}", job, error.message,
                                gigabytes(room.bytes), room.limit);
    return error;
  });
}

Result<Verdict> check_mesh_file(MeshFormat format, const CheckCommand& command,
                                const Console& console, std::optional<std::string> input) {
  Progress progress(console, "check", 0);
  progress.stage("reading");
  auto certificate = read_certificate(command);
  if (!certificate) return tl::make_unexpected(certificate.error());
  Verdict verdict;
  verdict.certificate = std::move(*certificate);
  // Certificates cover all bytes.
  auto file = input ? Result<MeshFile>(MeshFile::of_bytes(command.file, format, std::move(*input)))
                    : MeshFile::open(command.file, format, verdict.certificate.has_value());
  if (!file) return tl::make_unexpected(file.error());
  const std::string& bytes = file->bytes();
  FileFacts facts{.format = format, .slicer_reads_less = false, .missing = {}};
  auto mesh = read_mesh(*file, command, facts, verdict);
  if (!mesh && mesh.error().kind == ErrorKind::bad_input && verdict.certificate)
    return unread_with_certificate(bytes, format, command, std::move(verdict));
  if (mesh) mesh = judged(std::move(*mesh), facts, command, progress, verdict);
  if (!mesh) return tl::make_unexpected(mesh.error());
  if (verdict.failure) return verdict;
  if (auto done = check_contents(bytes, *mesh, format, command, verdict); !done)
    return tl::make_unexpected(done.error());
  progress.clear();
  warn_of_unit(format, verdict);
  const glm::dvec3 size = verdict.mesh.size_mm;
  const auto body = printed_body(*mesh, command, verdict);
  if (!body) return tl::make_unexpected(body.error());
  check_process(*body, size, command, verdict);
  if (verdict.certificate) {
    progress.stage("verifying the certificate");
    if (auto done = check_certificate(bytes, format, command, verdict); !done)
      return tl::make_unexpected(done.error());
    progress.clear();
  }
  return check_walls(*body, size, command, console, verdict).map([&] {
    return std::move(verdict);
  });
}

Result<Verdict> check_mesh(const TriangleMesh& mesh, const CheckCommand& command,
                           const Console& console) {
  auto report = report_on(mesh);
  if (!report) return failure(report.error().kind, command.file + ": " + report.error().message);
  Verdict verdict;
  verdict.mesh = std::move(*report);
  verdict.state = state_of(mesh, verdict.mesh);
  if (auto done = check_contents({}, mesh, MeshFormat::stl_binary, command, verdict); !done)
    return tl::make_unexpected(done.error());
  const glm::dvec3 size = verdict.mesh.size_mm;
  const auto body = printed_body(mesh, command, verdict);
  if (!body) return tl::make_unexpected(body.error());
  check_process(*body, size, command, verdict);
  return check_walls(*body, size, command, console, verdict).map([&] {
    return std::move(verdict);
  });
}

}  // namespace clay::cli
