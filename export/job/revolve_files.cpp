#include "export/job/revolve_files.hpp"

#include "claystack/export/proof.hpp"
#include "claystack/export/solid.hpp"
#include "claystack/export/walls.hpp"
#include "core/parallel_parts.hpp"
#include "core/size_text.hpp"
#include "export/formats/draco_bits.hpp"
#include "export/formats/glb.hpp"
#include "export/formats/shaded_obj.hpp"
#include "export/formats/stl_stream.hpp"
#include "export/formats/stored_file.hpp"
#include "export/formats/three_mf_check.hpp"
#include "export/job/resolution.hpp"
#include "export/job/solid_contents.hpp"
#include "export/proof/describe.hpp"
#include "export/proof/inspect_mesh.hpp"
#include "export/proof/revolve_match.hpp"
#include "export/proof/rounded_claims.hpp"
#include "export/proof/verify_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace clay::solid::inline job {
namespace {

Result<void> check_sound(const TriangleMesh& mesh, const std::string& name) {
  const MeshReport report = inspect_mesh(mesh);
  if (report.sound()) return {};
  return failure(ErrorKind::unsound, name + ": found " + describe(report.problems.front()));
}

/// The part of the pot that float32 cannot represent: usually the thinnest wall.
std::string lost_part(const Profile& profile, double rounding_mm) {
  constexpr double kThin = 8.0;  // roundings: both faces move, in two directions
  const Wall wall = min_wall(profile);
  const std::string part =
      wall.thickness_mm < kThin * rounding_mm
          ? fmt::format("the wall of {:.2g} mm at a height of {} mm is too thin", wall.thickness_mm,
                        size_text(wall.from.y, 1))
          : std::string("a part of the pot is too small");
  return fmt::format("{} for a mesh file, whose points are rounded by up to {:.2g} mm (float32): ",
                     part, rounding_mm);
}

}  // namespace

Result<FileReport> RevolveFiles::write(MeshFormat format, FileStore& store) {
  switch (format) {
    case MeshFormat::stl_binary:
      return stream(store);
    case MeshFormat::drc:
      return write_on_grid(format, store);
    case MeshFormat::glb:
      return options_.glb == GlbMesh::core ? write_whole(format, store)
                                           : write_on_grid(format, store);
    case MeshFormat::three_mf:
      return write_3mf(store);
    default:
      return write_whole(format, store);
  }
}

const TriangleMesh& RevolveFiles::mesh() {
  if (!mesh_) mesh_ = stages_.run("tessellate", [&] { return revolve(rule_); });
  return *mesh_;
}

/// The margins, if they cover the rounding; otherwise the exact test of the mesh as rounded.
Result<Proof> RevolveFiles::prove_rounded(MeshFormat format, double rounding_mm) {
  if (rounding_mm < claims_.margins.safe_rounding_mm()) return Proof::margins;
  const bool in_metres = format == MeshFormat::glb;
  std::optional<Result<void>>& exact = in_metres ? exact_in_metres_ : exact_;
  if (!exact) {
    TriangleMesh rounded = mesh();
    for (glm::dvec3& point : rounded.points) point = held_point(point, format);
    exact = stages_.run("exact_test", [&]() -> Result<void> {
      const MeshReport report = inspect_mesh(rounded);
      if (report.sound()) return {};
      return failure(ErrorKind::unsound,
                     lost_part(claims_.profile, rounding_mm) + describe(report.problems.front()));
    });
  }
  return exact->map([] { return Proof::exact_test; });
}

Result<FileReport> RevolveFiles::stream(FileStore& store) {
  constexpr auto kFormat = MeshFormat::stl_binary;
  const double rounding = float_rounding_mm(rule_);
  const auto proof = prove_rounded(kFormat, rounding);
  if (!proof) return tl::make_unexpected(proof.error());
  const auto file =
      stages_.run(stage_name("encode", kFormat), [&] { return stream_stl(rule_, store); });
  if (!file) return tl::make_unexpected(file.error());
  if (store.rereadable()) {
    const auto verdict =
        stages_.run(stage_name("verify", kFormat), [&] { return verify_stl(rule_, store); });
    if (!verdict) return tl::make_unexpected(verdict.error());
  }
  SolidCertificate certificate = with_rounding(claims_, rule_, rounding);
  certificate.proof = *proof;
  certificate.bytes = file->bytes;
  certificate.content_hash = file->hash;
  return finish(kFormat, std::move(certificate), store);
}

FileContents RevolveFiles::contents_of(MeshFormat format) {
  FileContents contents = solid_contents(options_);
  contents.one_body = rule_.shells().size() == 1;
  const bool coloured = format == MeshFormat::glb || format == MeshFormat::three_mf;
  if (format != MeshFormat::ply && !(coloured && options_.wall_map)) return contents;
  if (!walls_)
    walls_ = stages_.run("vertex_walls", [&] { return walls_of_points(rule_, claims_.profile); });
  contents.wall_mm = walls_->mm;
  contents.wall_top_mm = walls_->top_mm;
  return contents;
}

/// Printed digits read back as the same float32. A reader that uses doubles gets up to half a unit
/// in the last place more error; binary numbers have no more than their own.
Result<FileReport> RevolveFiles::write_whole(MeshFormat format, FileStore& store) {
  const double roundings = facts_of(format).decimal ? 2.0 : roundings_of(format);
  const double rounding = roundings * float_rounding_mm(rule_);
  return prove_rounded(format, rounding).and_then([&](Proof proof) {
    const TriangleMesh& solid = mesh();
    const FileContents contents = contents_of(format);
    return stages_
        .run(stage_name("encode", format),
             [&]() -> Result<std::string> {
               if (format == MeshFormat::obj && options_.normals)
                 return encode_shaded_obj(rule_, solid, options_.name);
               return encode_mesh(solid, format, contents);
             })
        .and_then([&](const std::string& bytes) {
          return certify_bytes(format, rounding, proof, bytes, store);
        });
  });
}

/// Encodes on the coarsest grid that tolerance and wall limit permit and the margins cover.
Result<FileReport> RevolveFiles::write_on_grid(MeshFormat format, FileStore& store) {
  const double allowed = std::max(options_.tolerance_mm, float_rounding_mm(rule_));
  const double safe = std::min(allowed, claims_.margins.safe_rounding_mm());
  const double kept = vertex_error_mm(safe, claims_.wall_lower_mm, walls_of_pot_.limit);
  DracoSettings settings;
  for (const double error_mm : {kept, safe}) {
    settings.max_error_mm = error_mm;
    if (const auto covered = encode_on_grid(format, settings))
      return certify_bytes(format, error_mm, Proof::margins, *covered, store);
  }
  settings.max_error_mm = allowed;
  return write_on_finer_grids(format, settings, store);
}

/// If no grid is fine enough for the margins: tries finer grids until the decoded mesh passes the
/// exact test, or returns the last problem.
Result<FileReport> RevolveFiles::write_on_finer_grids(MeshFormat format, DracoSettings settings,
                                                      FileStore& store) {
  double farthest_mm = 0.0;
  const auto judge = [&](const std::string& bytes) {
    return stages_.run("exact_test", [&] {
      return decode_mesh(bytes, format, as_written(format))
          .and_then([&](const TriangleMesh& decoded) {
            // A coarse grid may be sound and yet exchange close vertices.
            return check_sound(decoded, as_written(format)).and_then([&] {
              return match_revolve(decoded, rule_, settings.max_error_mm, format,
                                   as_written(format))
                  .map([&](double found_mm) { farthest_mm = found_mm; });
            });
          });
    });
  };
  return encode_on_finer_grids(
             least_draco_bits(mesh()),
             [&](int bits) {
               settings.min_bits = bits;
               return encode_on_grid(format, settings);
             },
             judge)
      .map_error([&](Error error) {
        if (error.kind == ErrorKind::unsound)
          error.message =
              "no grid of this format is fine enough for the thinnest places of the "
              "pot; write it in another format, such as .stl: " +
              error.message;
        return error;
      })
      .and_then([&](const std::string& bytes) {
        return store_judged(format, bytes, store).and_then([&] {
          return certified(format, farthest_mm, Proof::exact_test, bytes, store);
        });
      });
}

Result<std::string> RevolveFiles::encode_on_grid(MeshFormat format, const DracoSettings& settings) {
  const TriangleMesh& solid = mesh();
  return stages_.run(stage_name("encode", format), [&]() -> Result<std::string> {
    const DracoClaims claims = draco_claims(settings.max_error_mm);
    if (format == MeshFormat::drc) return encode_drc(solid, settings, &claims);
    FileContents contents = contents_of(format);
    contents.draco = settings;
    return encode_glb(solid, contents);
  });
}

/// The package carries a certificate of its model part, which the part itself cannot hold.
Result<FileReport> RevolveFiles::write_3mf(FileStore& store) {
  constexpr auto kFormat = MeshFormat::three_mf, kPart = MeshFormat::three_mf_model;
  const double rounding = 2.0 * float_rounding_mm(rule_);
  return prove_rounded(kFormat, rounding).and_then([&](Proof proof) {
    FileContents contents = contents_of(kFormat);
    const ModelPart model = stages_.run(stage_name("encode", kPart),
                                        [&] { return encode_3mf_model(mesh(), contents); });
    SolidCertificate certificate = with_rounding(claims_, rule_, rounding);
    certificate.proof = proof;
    certificate.bytes = model.xml.size();
    certificate.content_hash = hash_of(bytes_of(model.xml));
    certificate.format = name_of(kPart);
    const std::string text = write_certificate(certificate);
    contents.certificate = text;
    return stages_
        .run(stage_name("encode", kFormat),
             [&] { return proved_package(model, contents, rounding); })
        .and_then([&](const std::string& bytes) {
          return store_judged(kFormat, bytes, store).and_then([&] {
            return certified(kFormat, rounding, proof, bytes, store);
          });
        });
  });
}

/// The model part is read and matched with the solid while the picture is drawn and both are
/// packed; the package is unpacked again and compared with that part.
Result<std::string> RevolveFiles::proved_package(const ModelPart& model, FileContents contents,
                                                 double rounding_mm) {
  const std::string name = as_written(MeshFormat::three_mf);
  Result<double> matched;
  Result<std::string> package;
  for_each_part(2, [&](std::size_t part) {
    if (part == 0) {
      matched = decode_3mf_model(model.xml, name).and_then([&](const TriangleMesh& decoded) {
        return match_revolve(decoded, rule_, rounding_mm, MeshFormat::three_mf, name);
      });
      return;
    }
    const std::string thumbnail = thumbnail_for(MeshFormat::three_mf, options_);
    contents.thumbnail_png = thumbnail;
    package = pack_3mf(model, contents).and_then([&](std::string bytes) {
      return check_model_in_3mf(bytes, model.xml, name).map([&] { return std::move(bytes); });
    });
  });
  return matched ? package : tl::make_unexpected(matched.error());
}

Result<void> RevolveFiles::store_judged(MeshFormat format, const std::string& bytes,
                                        FileStore& store) {
  return stages_.run(stage_name("store", format), [&] { return write_in_parts(store, bytes); })
      .and_then([&] {
        return stages_.run(stage_name("verify", format),
                           [&] { return expect_stored(store, bytes, format); });
      });
}

DracoClaims RevolveFiles::draco_claims(double reach_mm) const {
  const SolidCertificate rounded = with_rounding(claims_, rule_, reach_mm);
  return {.volume_mm3 = rounded.volume_mm3,
          .volume_bound_mm3 = rounded.volume_bound_mm3,
          .counted_volume_mm3 = rounded.counted_volume_mm3,
          .vertex_error_mm = reach_mm};
}

/// `rounding_mm` bounds the displacement of every vertex; on a grid it is measured on the file
/// as read back.
Result<FileReport> RevolveFiles::certify_bytes(MeshFormat format, double rounding_mm, Proof proof,
                                               const std::string& bytes, FileStore& store) {
  const std::string name = as_written(format);
  if (auto written =
          stages_.run(stage_name("store", format), [&] { return write_in_parts(store, bytes); });
      !written)
    return tl::make_unexpected(written.error());
  const auto farthest = stages_.run(stage_name("verify", format), [&] {
    return read_back(store, bytes)
        .and_then([&](const std::string& again) { return decode_mesh(again, format, name); })
        .and_then([&](const TriangleMesh& decoded) {
          return match_revolve(decoded, rule_, rounding_mm, format, name);
        });
  });
  if (!farthest) return tl::make_unexpected(farthest.error());
  const bool measured = format == MeshFormat::drc || format == MeshFormat::glb;
  return certified(format, measured ? *farthest : rounding_mm, proof, bytes, store);
}

Result<FileReport> RevolveFiles::certified(MeshFormat format, double rounding_mm, Proof proof,
                                           const std::string& bytes, FileStore& store) {
  SolidCertificate certificate = with_rounding(claims_, rule_, rounding_mm);
  certificate.proof = proof;
  certificate.bytes = bytes.size();
  certificate.content_hash = hash_of(bytes_of(bytes));
  return finish(format, std::move(certificate), store);
}

Result<FileReport> RevolveFiles::finish(MeshFormat format, SolidCertificate certificate,
                                        FileStore& store) {
  certificate.format = name_of(format);
  FileReport report;
  report.format = format;
  report.bytes = certificate.bytes;
  report.content_hash = certificate.content_hash;
  report.max_error_mm = certificate.rounding_mm;
  report.proof = certificate.proof;
  report.read_back = store.rereadable();
  report.certificate = std::move(certificate);
  if (!options_.full_verification || !report.read_back) return report;
  const auto checked =
      stages_.run("full_verification", [&] { return check_stored(store, report.bytes, format); });
  if (!checked) return tl::make_unexpected(checked.error());
  report.full_verification = *checked;
  return report;
}

}  // namespace clay::solid::inline job
