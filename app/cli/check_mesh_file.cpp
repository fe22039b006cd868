#include "app/cli/check.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/mesh_input.hpp"
#include "app/cli/mesh_unit.hpp"

#include "claystack/export/formats.hpp"
#include "claystack/export/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// Repairs if requested, and gives its verdict on the mesh, or on the result. If no result was
/// made, the verdict is on the mesh, with the failure.
Result<TriangleMesh> judged(TriangleMesh mesh, MeshFormat format, const CheckCommand& command,
                            bool slicer_reads_less, Progress& progress, Verdict& verdict) {
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
    summary.reading_mm = reading_error_mm(mesh, format);
    auto repaired = repair_and_write(mesh, verdict.mesh, command, summary, progress);
    if (!repaired) {
      verdict.failure = name(repaired.error()).value();
      return mesh;
    }
    warn_of_filled_gaps(summary, verdict);
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
  bool slicer_reads_less = false;
  auto mesh = file->read(
      {"checking", solid::check_memory(1)},
      {.repair = command.repair, .notes = &verdict.notes, .slicer_reads_less = &slicer_reads_less});
  if (!mesh && mesh.error().kind == ErrorKind::bad_input && verdict.certificate)
    return unread_with_certificate(bytes, format, command, std::move(verdict));
  if (mesh) mesh = judged(std::move(*mesh), format, command, slicer_reads_less, progress, verdict);
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
