#include "app/cli/check.hpp"
#include "app/cli/pot_input.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/export/formats.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace clay::cli {
namespace {

using solid::MeshFormat;
using solid::SolidCertificate;
using solid::TriangleMesh;

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
        verdict.add("contents", Grade::pass, "contains the pot, for claystack throw --from");
        const auto sizes = pot->collapse ? std::nullopt : other_size(mesh, *pot);
        if (sizes)
          verdict.notes.push_back("the pot inside has no shrinkage and no finish: " + *sizes);
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
    return verdict.add(solid::check_name(solid::ProblemKind::cavity), Grade::warn, std::move(text));
  text += one ? ": it needs a drain hole" : ": they need drain holes";
  verdict.add(solid::check_name(solid::ProblemKind::cavity), fired ? Grade::fail : Grade::warn,
              std::move(text));
}

/// A part in mid-air falls while it is printed.
void check_standing(const TriangleMesh& mesh, Verdict& verdict) {
  const auto found = solid::hanging_parts(mesh, verdict.mesh);
  if (!found) return;
  const bool one = found->hanging == 1;
  verdict.add(
      solid::check_name(solid::ProblemKind::bodies), Grade::warn,
      fmt::format("{} of {} parts {} touch the bed or a part on it: {} lowest point is {:.3g} mm "
                  "above the bed",
                  found->hanging, found->parts, one ? "does not" : "do not", one ? "its" : "their",
                  found->lowest_mm));
}

bool carries_pot(std::string_view bytes, const std::string& file) {
  const auto parts = solid::parts_in_3mf(bytes, file);
  return parts && !parts->pot.empty();
}

}  // namespace

Result<std::optional<SolidCertificate>> read_certificate(const CheckCommand& command) {
  if (command.certificate.empty()) return std::nullopt;
  return read_file(command.certificate, solid::kMaxCertificateBytes)
      .and_then([&](const std::string& text) {
        return solid::parse_certificate(text, command.certificate);
      })
      .map([](SolidCertificate certificate) { return std::optional(std::move(certificate)); });
}

Result<void> check_certificate(std::string_view bytes, MeshFormat format,
                               const CheckCommand& command, Verdict& verdict) {
  const auto verified = same_format(*verdict.certificate, format, command.file).and_then([&] {
    return solid::verify_certificate(*verdict.certificate, bytes, command.file);
  });
  return holds(verified, "certificate", "does not hold", verdict).map([&](bool held) {
    verdict.certificate_holds = held;
    if (held) verdict.certified_wall_mm = verdict.certificate->wall_lower_mm;
  });
}

Result<void> check_contents(std::string_view bytes, const TriangleMesh& mesh, MeshFormat format,
                            const CheckCommand& command, Verdict& verdict) {
  check_cavities(command, verdict);
  check_standing(mesh, verdict);
  if (command.changes_mesh()) {
    if (format == MeshFormat::three_mf && carries_pot(bytes, command.file))
      verdict.notes.push_back("the result has neither the pot nor the certificate of the file");
    if (format == MeshFormat::glb)
      verdict.notes.push_back("the result has no names, materials and colours of the file");
    return {};
  }
  if (format == MeshFormat::drc) check_claims(bytes, mesh, verdict);
  if (format != MeshFormat::three_mf) return {};
  return check_packed(bytes, mesh, command.file, verdict);
}

}  // namespace clay::cli
