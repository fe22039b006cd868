#include "export/job/step_file.hpp"

#include "core/content_hash.hpp"
#include "core/text.hpp"
#include "export/formats/step.hpp"
#include "export/formats/stored_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace clay::solid::inline job {
namespace {

/// Curves count as lines within this part of the tolerance, and at most this far, in the proof.
constexpr double kPartOfTolerance = 0.05, kFarthestMm = 1e-3;

/// The solid in the file must be that of the brep: its volume within 1e-12, with all faces.
Result<void> agrees(const StepSolid& found, const RevolvedBrep& brep) {
  if (found.bodies == brep.bodies.size() && found.faces == brep.faces() &&
      std::abs(found.volume_mm3 - brep.volume_mm3) <= 1e-12 * brep.volume_mm3)
    return {};
  return failure(ErrorKind::unsound, "STEP as written: expected " + std::to_string(brep.faces()) +
                                         " faces around " + number_text(brep.volume_mm3) +
                                         " mm3, found " + std::to_string(found.faces) + " around " +
                                         number_text(found.volume_mm3));
}

Result<StepReport> proved(const RevolvedBrep& brep, double counted_volume_mm3,
                          const ExportOptions& options) {
  const double error_mm = std::min(kPartOfTolerance * options.tolerance_mm, kFarthestMm);
  const Profile section = brep.flattened(error_mm);
  return certify(section).map([&](const PlanarCertificate&) {
    StepReport report;
    report.walls = options.step_walls;
    report.faces = brep.faces();
    report.deviation_mm = brep.deviation_mm;
    report.volume_mm3 = brep.volume_mm3;
    report.volume_error_relative =
        std::abs(brep.volume_mm3 - counted_volume_mm3) / counted_volume_mm3;
    report.min_wall_mm = min_wall_mm(section) - 2.0 * error_mm;
    return report;
  });
}

}  // namespace

Result<FileReport> write_step(const ProvedSection& section, double counted_volume_mm3,
                              const ExportOptions& options, FileStore& store, Stages& stages) {
  const auto brep = stages.run("fit_step", [&] {
    return revolved_brep(section.profile(), options.step_walls, options.tolerance_mm);
  });
  if (!brep) return tl::make_unexpected(brep.error());
  const auto report =
      stages.run("prove_step", [&] { return proved(*brep, counted_volume_mm3, options); });
  if (!report) return tl::make_unexpected(report.error());
  const std::string bytes =
      stages.run("encode_step", [&] { return encode_step(*brep, options.name); });
  return stages
      .run("verify_step",
           [&] {
             return write_in_parts(store, bytes)
                 .and_then([&] { return read_back(store, bytes); })
                 .and_then([&](const std::string& again) {
                   return verify_step(again, "STEP as written");
                 })
                 .and_then([&](const StepSolid& found) { return agrees(found, *brep); });
           })
      .map([&] {
        FileReport file;
        file.kind = FileKind::step;
        file.bytes = bytes.size();
        file.content_hash = hash_of(bytes_of(bytes));
        file.max_error_mm = report->deviation_mm;
        file.read_back = store.rereadable();
        file.step = *report;
        return file;
      });
}

}  // namespace clay::solid::inline job
