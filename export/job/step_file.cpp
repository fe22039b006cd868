#include "export/job/step_file.hpp"

#include "core/content_hash.hpp"
#include "core/text.hpp"
#include "export/formats/step.hpp"
#include "export/formats/stored_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace clay::solid::inline job {
namespace {

/// Curves count as lines within this part of the tolerance, and at most this far, in the proof.
constexpr double kPartOfTolerance = 0.05, kFarthestMm = 2e-4;
/// Parts of the tolerance for curves of which a wall limit demands more.
constexpr double kCloser = 0.25, kClosest = 0.01;

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

/// A solid for CAD and what is proved of it.
struct ProvedBrep {
  RevolvedBrep brep;
  StepReport report;
};

Result<ProvedBrep> proved(RevolvedBrep brep, double counted_volume_mm3,
                          const ExportOptions& options) {
  const double error_mm =
      brep.curved() ? std::min(kPartOfTolerance * options.tolerance_mm, kFarthestMm) : 0.0;
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
    return ProvedBrep{std::move(brep), report};
  });
}

/// The curves of one tolerance.
Result<ProvedBrep> fitted(const ExportReport& report, const ExportOptions& options,
                          double tolerance_mm, Stages& stages) {
  return stages
      .run(
          "fit_step",
          [&] { return revolved_brep(report.section.profile(), options.step_walls, tolerance_mm); })
      .and_then([&](RevolvedBrep brep) {
        return stages.run("prove_step", [&] {
          return proved(std::move(brep), report.prepared.counted_volume_mm3, options);
        });
      });
}

/// Closer curves, as long as only they make a wall thinner than its limit.
Result<ProvedBrep> fitted_within_limit(const ExportReport& report, const ExportOptions& options,
                                       Stages& stages) {
  const std::optional<WallLimit>& limit = report.walls.limit;
  const bool met = limit && limit->met_by(report.walls.min_wall_mm);
  auto made = fitted(report, options, options.tolerance_mm, stages);
  for (double part = kCloser;
       made && met && !limit->met_by(made->report.min_wall_mm) && part >= kClosest;
       part *= kCloser) {
    auto closer = fitted(report, options, part * options.tolerance_mm, stages);
    if (!closer) break;
    made = std::move(closer);
  }
  return made;
}

}  // namespace

Result<FileReport> write_step(const ExportReport& report, const ExportOptions& options,
                              FileStore& store, Stages& stages) {
  const auto made = fitted_within_limit(report, options, stages);
  if (!made) return tl::make_unexpected(made.error());
  const RevolvedBrep& brep = made->brep;
  const StepReport& proof = made->report;
  const std::string bytes =
      stages.run("encode_step", [&] { return encode_step(brep, options.name); });
  return stages
      .run("verify_step",
           [&] {
             return write_in_parts(store, bytes)
                 .and_then([&] { return read_back(store, bytes); })
                 .and_then([&](const std::string& again) {
                   return verify_step(again, "STEP as written");
                 })
                 .and_then([&](const StepSolid& found) { return agrees(found, brep); });
           })
      .map([&] {
        FileReport file;
        file.kind = FileKind::step;
        file.bytes = bytes.size();
        file.content_hash = hash_of(bytes_of(bytes));
        file.max_error_mm = proof.deviation_mm;
        file.read_back = store.rereadable();
        file.step = proof;
        return file;
      });
}

}  // namespace clay::solid::inline job
