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

/// In the proof, curves count as lines within this part of the tolerance and of the thinnest wall,
/// but at most kFarthestMm and at least kNearestMm.
constexpr double kPart = 0.05, kFarthestMm = 2e-4, kNearestMm = 1e-7;
/// Parts of the tolerance for curves that must be closer.
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

/// A solid for CAD and its proof: an error if its walls cross each other.
struct FittedBrep {
  RevolvedBrep brep;
  Result<StepReport> proof;
};

Result<StepReport> proof_of(const RevolvedBrep& brep, const ExportReport& of,
                            const ExportOptions& options) {
  const double finest_mm = std::min(options.tolerance_mm, of.walls.thinnest.thickness_mm);
  const double error_mm =
      brep.curved() ? std::clamp(kPart * finest_mm, kNearestMm, kFarthestMm) : 0.0;
  const Profile section = brep.flattened(error_mm);
  return certify(section).map([&](const PlanarCertificate&) {
    const double counted_mm3 = of.prepared.counted_volume_mm3;
    StepReport report;
    report.walls = options.step_walls;
    report.faces = brep.faces();
    report.deviation_mm = brep.deviation_mm;
    report.volume_mm3 = brep.volume_mm3;
    report.volume_error_relative = std::abs(brep.volume_mm3 - counted_mm3) / counted_mm3;
    report.min_wall_mm = std::max(0.0, min_wall_mm(section) - 2.0 * error_mm);
    return report;
  });
}

/// The curves of one tolerance.
Result<FittedBrep> fitted(const ExportReport& report, const ExportOptions& options,
                          double tolerance_mm, Stages& stages) {
  return stages
      .run(
          "fit_step",
          [&] { return revolved_brep(report.section.profile(), options.step_walls, tolerance_mm); })
      .map([&](RevolvedBrep brep) {
        auto proof = stages.run("prove_step", [&] { return proof_of(brep, report, options); });
        return FittedBrep{std::move(brep), std::move(proof)};
      });
}

tl::unexpected<Error> crossing_curves(const Wall& thinnest, double tolerance_mm) {
  return failure(ErrorKind::unsound,
                 "STEP: expected curves within the tolerance of " + nine_digit_text(tolerance_mm) +
                     " mm that stay apart, found that they cross; the thinnest wall has " +
                     nine_digit_text(thinnest.thickness_mm) + " mm at a height of " +
                     nine_digit_text(thinnest.from.y) + " mm; " + kLinesAreExact +
                     ", and a smaller tolerance brings the curves closer");
}

/// Fits closer curves while the curves cross, or while they alone make a wall thinner than its
/// limit.
Result<FittedBrep> fitted_closely(const ExportReport& report, const ExportOptions& options,
                                  Stages& stages) {
  const std::optional<WallLimit>& limit = report.walls.limit;
  const bool met = limit && limit->met_by(report.walls.min_wall_mm);
  auto made = fitted(report, options, options.tolerance_mm, stages);
  if (!made || options.step_walls == StepWalls::lines) return made;
  const auto too_far = [&] {
    return !made->proof || (met && !limit->met_by(made->proof->min_wall_mm));
  };
  for (double part = kCloser; too_far() && part >= kClosest; part *= kCloser) {
    auto closer = fitted(report, options, part * options.tolerance_mm, stages);
    if (!closer) break;
    if (closer->proof) made = std::move(closer);
  }
  if (!made->proof) return crossing_curves(report.walls.thinnest, options.tolerance_mm);
  return made;
}

}  // namespace

Result<FileReport> write_step(const ExportReport& report, const ExportOptions& options,
                              FileStore& store, Stages& stages) {
  const auto made = fitted_closely(report, options, stages);
  if (!made) return tl::make_unexpected(made.error());
  if (!made->proof) return tl::make_unexpected(made->proof.error());
  const RevolvedBrep& brep = made->brep;
  const StepReport& proof = *made->proof;
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
