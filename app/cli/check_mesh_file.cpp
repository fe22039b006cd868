#include "app/cli/check.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/mesh_input.hpp"
#include "app/cli/pot_input.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

namespace clay::cli {
namespace {

using solid::MeshFormat;
using solid::SolidCertificate;
using solid::TriangleMesh;

Result<solid::MeshReport> checked(const TriangleMesh& mesh) {
  const std::string job = fmt::format("checking {} triangles", mesh.triangles.size());
  const MemoryRoom room = memory_room();
  if (auto fits = expect_room(job, solid::check_memory(mesh.triangles.size())); !fits)
    return tl::make_unexpected(fits.error());
  solid::MeshReport report = solid::check_mesh(mesh);
  // The estimate was too low for this mesh.
  if (report.out_of_memory)
    return failure(ErrorKind::io, fmt::format("{} needs more memory than the {} left under {}", job,
                                              gigabytes(room.bytes), room.limit));
  return report;
}

/// A slicer makes one body only of triangles that it reads.
MeshState as_sliced(MeshState state, bool slicer_reads_less) {
  return slicer_reads_less && state == MeshState::prints ? MeshState::will_not_print : state;
}

/// Repairs and decimates if requested. `found` is the report on the mesh.
Result<TriangleMesh> repaired_mesh(TriangleMesh mesh, const solid::MeshReport& found,
                                   const CheckCommand& command, RepairSummary& summary,
                                   Progress& progress) {
  summary.before = state_of(mesh, found);
  summary.found = found.problems;
  if (found.has_volume) summary.volume_before_mm3 = found.volume_mm3;
  if (command.repair && !summary.found.empty()) {
    solid::RepairOptions options = command.repair_options;
    options.progress = [&](std::string_view stage, double share) { progress.stage(stage, share); };
    auto repaired = solid::repair_unsound_mesh(mesh, options);
    if (!repaired) return tl::make_unexpected(repaired.error());
    mesh = std::move(repaired->mesh);
    summary.repaired = std::move(repaired->repaired);
    summary.holes = std::move(repaired->holes);
    summary.change = repaired->change;
    summary.wrapped_mm = repaired->wrapped_mm;
    summary.thickened = repaired->thickened;
  }
  summary.triangles_before = mesh.triangles.size();
  if (command.max_triangles && mesh.triangles.size() > *command.max_triangles) {
    auto decimated =
        solid::decimate(mesh, *command.max_triangles,
                        {.progress = [&](double share) { progress.stage("decimating", share); }});
    if (!decimated) return tl::make_unexpected(decimated.error());
    summary.decimation_error_mm = decimated->max_error_mm;
    mesh = std::move(decimated->mesh);
  }
  return mesh;
}

/// A file and the mesh that a reader finds in it.
struct WrittenMesh {
  std::string bytes;
  TriangleMesh mesh;
  solid::MeshReport report;
};

/// Without its bytes.
Result<WrittenMesh> read_back(const std::string& bytes, MeshFormat format,
                              const std::string& name) {
  return solid::decode_mesh(bytes, format, name).and_then([&](TriangleMesh mesh) {
    return checked(mesh).map([&](solid::MeshReport report) {
      return WrittenMesh{{}, std::move(mesh), std::move(report)};
    });
  });
}

/// Draco's grid, also of the mesh in a GLB.
bool is_on_grid(MeshFormat format) {
  return format == MeshFormat::drc || format == MeshFormat::glb;
}

/// Compares files with their mesh, and keeps the last one that is no worse.
class FileJudge {
 public:
  FileJudge(const TriangleMesh& mesh, MeshFormat format, const std::string& name)
      : mesh_(mesh), format_(format), name_(name), volume_mm3_(solid::signed_volume(mesh)) {}

  Result<void> operator()(const std::string& bytes) {
    auto found = read_back(bytes, format_, name_);
    if (!found) return tl::make_unexpected(found.error());
    const MeshState state = state_of(found->mesh, found->report);
    if (state != MeshState::sound && !wanted_) {
      const auto before = checked(mesh_);
      if (!before) return tl::make_unexpected(before.error());
      wanted_ = state_of(mesh_, *before);
    }
    if (!keeps_volume(found->report))
      return failure(ErrorKind::unsound,
                     "expected a file with the volume of the mesh within 1 %, found " +
                         fmt::format("{:.6g} mm3 instead of {:.6g} mm3", found->report.volume_mm3,
                                     volume_mm3_));
    if (state != MeshState::sound && state > *wanted_)
      return failure(ErrorKind::unsound,
                     "expected a file as sound as the mesh, found faults after rounding to the "
                     "numbers of " +
                         std::string(name_of(format_)));
    accepted_ = std::move(*found);
    return {};
  }

  WrittenMesh take(std::string bytes) {
    accepted_.bytes = std::move(bytes);
    return std::move(accepted_);
  }

 private:
  /// A grid that is coarse for a thin plate changes its volume. float32 has no finer one.
  [[nodiscard]] bool keeps_volume(const solid::MeshReport& report) const {
    constexpr double kMostShare = 0.01;
    if (!is_on_grid(format_) || !report.has_volume) return true;
    return std::abs(report.volume_mm3 - volume_mm3_) <= kMostShare * std::abs(volume_mm3_);
  }

  const TriangleMesh& mesh_;
  MeshFormat format_;
  const std::string& name_;
  double volume_mm3_;
  std::optional<MeshState> wanted_;  ///< of the mesh, if a file is not sound
  WrittenMesh accepted_;
};

/// In a format with a grid, on finer ones until the file is no worse than the mesh. Errors:
/// `unsound` if none is fine enough.
Result<WrittenMesh> encoded(const TriangleMesh& mesh, MeshFormat format, const std::string& name) {
  constexpr double kGridOfSize = 1e-5;
  const bool on_grid = is_on_grid(format);
  solid::FileContents contents{.name = "repaired"};
  contents.draco.max_error_mm = std::min(contents.draco.max_error_mm,
                                         kGridOfSize * glm::length(solid::extent_of(mesh).size()));
  FileJudge judge(mesh, format, name);
  const auto encode = [&](int bits) {
    contents.draco.min_bits = bits;
    return solid::encode_mesh(mesh, format, contents);
  };
  const int first_bits = contents.draco.min_bits;
  auto bytes = on_grid ? solid::encode_on_finer_grids(first_bits, encode, std::ref(judge))
                       : encode(first_bits).and_then([&](std::string once) {
                           return judge(once).map([&] { return std::move(once); });
                         });
  return std::move(bytes).map([&](std::string written) { return judge.take(std::move(written)); });
}

/// The verdict is on the contents of the output file, so they are decoded and checked before the
/// file gets its name.
Result<WrittenMesh> written(WrittenMesh file, const CheckCommand& command, RepairSummary& summary) {
  summary.bytes = file.bytes.size();
  if (command.dry_run) return file;
  if (const auto done = publish(command.out, file.bytes); !done)
    return tl::make_unexpected(done.error());
  summary.path = command.out;
  return file;
}

/// The farthest that reading moves a point: half a unit of the last place of float32 along each
/// axis, in formats with decimals, doubles or a unit or transformation of their own.
double reading_error_mm(const TriangleMesh& mesh, MeshFormat format) {
  if (format == MeshFormat::stl_binary || format == MeshFormat::drc) return 0.0;
  double reach = 0.0;
  for (const glm::dvec3& p : mesh.points)
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(p[axis])) reach = std::max(reach, std::abs(p[axis]));
  return std::sqrt(3.0) * 0x1p-24 * reach;
}

/// The bounds of the change of what the file holds.
Result<WrittenMesh> with_change(WrittenMesh file, const TriangleMesh& input,
                                RepairSummary& summary) {
  // Other formats hold float32, as the mesh that was compared.
  if (!summary.decimation_error_mm && !is_on_grid(summary.format)) return file;
  return solid::change_between(input, file.mesh).map([&](const solid::SurfaceChange& change) {
    summary.change = change;
    return std::move(file);
  });
}

Result<WrittenMesh> repair_and_write(const TriangleMesh& mesh, const solid::MeshReport& found,
                                     const CheckCommand& command, RepairSummary& summary,
                                     Progress& progress) {
  // Without a name, a dry run takes the format of the input, if it can be written.
  auto format = solid::mesh_format_of(command.out.empty() ? command.file : command.out,
                                      solid::FormatUse::write);
  if (!format && (command.out.empty() || command.out == "-")) format = MeshFormat::stl_binary;
  if (!format) return tl::make_unexpected(format.error());
  summary.format = *format;
  return repaired_mesh(mesh, found, command, summary, progress)
      .and_then([&](const TriangleMesh& result) {
        progress.stage("writing");
        return encoded(result, summary.format, command.out)
            .and_then([&](WrittenMesh file) { return with_change(std::move(file), mesh, summary); })
            .and_then([&](WrittenMesh file) { return written(std::move(file), command, summary); });
      });
}

/// Checks the claims of a Draco file by Claystack, whose checksum has been verified.
void check_claims(std::string_view bytes, const TriangleMesh& mesh, Verdict& verdict) {
  const auto claims = solid::drc_claims(bytes, {}).value_or(std::nullopt);
  if (!claims) return;
  verdict.add("contents", Grade::pass, "checksum holds");
  for (const auto& problem : solid::compare_with_claims(mesh, *claims))
    verdict.add("contents", Grade::fail, problem.what + ": " + problem.where);
}

/// Adds the reason if `found` is an error: a failed check. Returns whether it holds. An error of
/// kind `io`, such as lack of memory, is not about the file.
Result<bool> holds(const Result<void>& found, std::string_view check, std::string_view what,
                   Verdict& verdict) {
  if (found) return true;
  if (found.error().kind == ErrorKind::io) return tl::make_unexpected(found.error());
  verdict.add(std::string(check), Grade::fail, std::string(what) + ": " + found.error().message);
  return false;
}

Result<void> check_packed_pot(const solid::PackedParts& parts, const TriangleMesh& mesh,
                              const std::string& file, Verdict& verdict) {
  const auto pot = parse_pot(parts.pot, file);
  return holds(pot.map([](const Pot&) {}), "contents", "the pot inside", verdict)
      .map([&](bool reads) {
        if (!reads) return;
        verdict.add("contents", Grade::pass, "carries the pot; throw --from continues it");
        const auto sizes = pot->collapse ? std::nullopt : other_size(mesh, *pot);
        if (sizes)
          verdict.notes.push_back("the pot inside is before shrinkage and finish: " + *sizes);
        if (!parts.certificate.empty()) return;  // the mesh is compared with the certificate
        if (const auto difference = mesh_differs(mesh, *pot))
          verdict.add("contents", Grade::warn, *difference);
      });
}

/// The certificate is that of the model part.
Result<void> check_packed_certificate(std::string_view bytes, const solid::PackedParts& parts,
                                      const std::string& file, Verdict& verdict) {
  double wall_mm = 0.0;
  const auto verified =
      solid::parse_certificate(parts.certificate, file)
          .and_then([&](const SolidCertificate& certificate) {
            wall_mm = certificate.wall_lower_mm;
            return solid::model_in_3mf(bytes, file).and_then([&](const std::string& model) {
              return solid::verify_certificate(certificate, model, file);
            });
          });
  return holds(verified, "contents", "the certificate inside does not hold", verdict)
      .map([&](bool held) {
        if (!held) return;
        verdict.add("contents", Grade::pass, "the certificate inside holds");
        verdict.certified_wall_mm = wall_mm;
      });
}

/// The pot and the certificate that a 3MF by Claystack carries.
Result<void> check_packed(std::string_view bytes, const TriangleMesh& mesh, const std::string& file,
                          Verdict& verdict) {
  const auto parts = solid::parts_in_3mf(bytes, file);
  return holds(parts.map([](const solid::PackedParts&) {}), "contents", "parts", verdict)
      .and_then([&](bool reads) -> Result<void> {
        if (!reads || parts->pot.empty()) return {};
        return check_packed_pot(*parts, mesh, file, verdict);
      })
      .and_then([&]() -> Result<void> {
        if (!parts || parts->certificate.empty()) return {};
        return check_packed_certificate(bytes, *parts, file, verdict);
      });
}

/// Empty if no certificate is checked.
Result<std::optional<SolidCertificate>> read_certificate(const CheckCommand& command) {
  if (command.certificate.empty()) return std::nullopt;
  return read_file(command.certificate, solid::kMaxCertificateBytes)
      .and_then([&](const std::string& text) {
        return solid::parse_certificate(text, command.certificate);
      })
      .map([](SolidCertificate certificate) { return std::optional(std::move(certificate)); });
}

/// The same bytes may be a mesh in two formats: the format of the file's name must match.
Result<void> same_format(const SolidCertificate& certificate, MeshFormat format,
                         const std::string& file) {
  const auto family = [](MeshFormat f) {
    return f == MeshFormat::stl_ascii ? MeshFormat::stl_binary : f;
  };
  const auto stated = solid::mesh_format_named(certificate.format);
  if (stated && family(*stated) == family(format)) return {};
  return failure(ErrorKind::unsound, fmt::format("{}: format: the certificate states {}, found {}",
                                                 file, certificate.format, name_of(format)));
}

Result<void> verify(std::string_view bytes, MeshFormat format, const CheckCommand& command,
                    Verdict& verdict) {
  const auto verified = same_format(*verdict.certificate, format, command.file).and_then([&] {
    return solid::verify_certificate(*verdict.certificate, bytes, command.file);
  });
  return holds(verified, "certificate", "does not hold", verdict).map([&](bool held) {
    verdict.certificate_holds = held;
    if (held) verdict.certified_wall_mm = verdict.certificate->wall_lower_mm;
  });
}

/// Four digits without an exponent; "less than 0.001" for tiny volumes.
std::string in_mm3(double mm3) {
  return mm3 < 0.001 ? "less than 0.001" : fmt::format("{:.4g}", mm3);
}

/// A closed cavity bursts in a kiln, and traps resin or powder elsewhere. A tiny one, as between
/// triangles that cross, holds nothing that could drain.
void check_cavities(const CheckCommand& command, Verdict& verdict) {
  constexpr double kLeastMm3 = 1.0, kLeastShownMm3 = 1'000.0;
  if (verdict.mesh.cavities == 0) return;
  const double trapped_mm3 = verdict.mesh.trapped_mm3;
  const auto& process = command.walls.demand().process;
  const bool fired = process && process->fired, one = verdict.mesh.cavities == 1;
  std::string text =
      fmt::format("{} closed {}, ", verdict.mesh.cavities, one ? "cavity" : "cavities");
  text += trapped_mm3 < kLeastShownMm3 ? fmt::format("{} mm3 trapped", in_mm3(trapped_mm3))
                                       : fmt::format("{:.4g} cm3 trapped", trapped_mm3 / 1000.0);
  if (trapped_mm3 < kLeastMm3)
    return verdict.add(check_name(solid::ProblemKind::cavity), Grade::warn, std::move(text));
  text += one ? ": it needs a drain hole" : ": they need drain holes";
  verdict.add(check_name(solid::ProblemKind::cavity), fired ? Grade::fail : Grade::warn,
              std::move(text));
}

/// A part in mid-air falls while it is printed.
void check_standing(const TriangleMesh& mesh, Verdict& verdict) {
  const auto found = solid::hanging_parts(mesh, verdict.mesh);
  if (!found) return;
  const bool one = found->hanging == 1;
  verdict.add(
      check_name(solid::ProblemKind::bodies), Grade::warn,
      fmt::format("{} of {} parts {} touch the bed or a part on it: {} lowest point is {:.3g} mm "
                  "above the bed",
                  found->hanging, found->parts, one ? "does not" : "do not", one ? "its" : "their",
                  found->lowest_mm));
}

bool carries_pot(std::string_view bytes, const std::string& file) {
  const auto parts = solid::parts_in_3mf(bytes, file);
  return parts && !parts->pot.empty();
}

/// Cavities of the mesh, and the parts of the file besides the mesh.
Result<void> check_contents(std::string_view bytes, const TriangleMesh& mesh, MeshFormat format,
                            const CheckCommand& command, Verdict& verdict) {
  check_cavities(command, verdict);
  check_standing(mesh, verdict);
  if (command.changes_mesh()) {
    if (format == MeshFormat::three_mf && carries_pot(bytes, command.file))
      verdict.notes.push_back("the result has neither the pot nor the certificate of the file");
    return {};
  }
  if (format == MeshFormat::drc) check_claims(bytes, mesh, verdict);
  if (format != MeshFormat::three_mf) return {};
  return check_packed(bytes, mesh, command.file, verdict);
}

/// A wall that is thick for an opening closes it, and the cavity behind it is filled.
void warn_of_filled_gaps(const RepairSummary& summary, Verdict& verdict) {
  constexpr double kMostShare = 0.2;  // corners have less
  if (!summary.thickened || summary.thickened->filled_share <= kMostShare) return;
  verdict.add(
      "geometry", Grade::warn,
      fmt::format("the wall of {:.4g} mm fills gaps: just beyond it, {:.0f} % of the places "
                  "beside the surface are clay, sampled; a thinner --thicken leaves them "
                  "open",
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
    auto found = checked(mesh);
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
    auto report = checked(mesh);
    if (!report) return name(report.error());
    verdict.mesh = std::move(*report);
  }
  verdict.state = as_sliced(state_of(mesh, verdict.mesh), slicer_reads_less);
  return mesh;
}

/// A file that cannot be read no longer matches its certificate.
Result<Verdict> unread_with_certificate(std::string_view bytes, MeshFormat format,
                                        const CheckCommand& command, Verdict verdict) {
  return verify(bytes, format, command, verdict).map([&] {
    verdict.examined = false;
    verdict.state = MeshState::unreadable;
    return std::move(verdict);
  });
}

}  // namespace

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
  const glm::dvec3 size = verdict.mesh.size_mm;
  if (const auto doubt = doubted_unit(size, format))
    verdict.add("geometry", Grade::warn,
                *doubt + "; scale it in a slicer, or make a pot with claystack import --height MM");
  const auto body = command.walls.asked() ? printed_body(*mesh, command, verdict)
                                          : Result<PrintedBody>(PrintedBody{&*mesh, {}, {}});
  if (!body) return tl::make_unexpected(body.error());
  check_process(*body, size, command, verdict);
  if (verdict.certificate) {
    progress.stage("verifying the certificate");
    if (auto done = verify(bytes, format, command, verdict); !done)
      return tl::make_unexpected(done.error());
    progress.clear();
  }
  return check_walls(*body, size, command, console, verdict).map([&] {
    return std::move(verdict);
  });
}

}  // namespace clay::cli
