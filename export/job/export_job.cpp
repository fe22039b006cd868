#include "claystack/export/job.hpp"

#include "claystack/engine/tick.hpp"
#include "claystack/export/solid.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/job/collapsed_export.hpp"
#include "export/job/drain.hpp"
#include "export/job/left_out.hpp"
#include "export/job/resolution.hpp"
#include "export/job/revolve_files.hpp"
#include "export/job/stages.hpp"
#include "export/solid/revolve_layout.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

namespace clay::solid::inline job {
namespace {

/// Steps that a file's float32 cannot hold apart with a margin.
double min_step_mm(const ClayStack& stack) {
  return std::ldexp(std::hypot(largest_radius_mm(stack), stack.height_mm()), -19);
}

/// No step but floors and lids.
bool has_straight_walls(const ClayStack& stack) {
  const auto rings = stack.rings();
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const Ring &below = rings[i - 1], &above = rings[i];
    const bool floor = below.inner2 == 0 || above.inner2 == 0;
    if (below.outer2 != above.outer2 || (!floor && below.inner2 != above.inner2)) return false;
  }
  return true;
}

/// A profile that has been proved, and the number of steps to revolve it by.
struct Design {
  StackProfile section;
  SmoothedProfile smoothed;  ///< but for its section
  Smoothing smoothing = Smoothing::none;
  std::optional<double> wall_as_steps_mm;
  std::string no_smoothing;  ///< why not, where not
  PlanarCertificate planar;
  double tolerance_mm = 0.0;
  std::size_t segments = 0;
  std::size_t triangles = 0;
};

class ExportJob {
 public:
  ExportJob(const ClayStack& stack, const std::vector<Output>& outputs,
            const ExportOptions& options, const std::function<void(std::string_view)>& progress)
      : stack_(stack), outputs_(outputs), options_(options), stages_(report_.stages, progress) {}

  Result<ExportReport> run() {
    return design().and_then([&](const Design& design) { return write_all(design); }).map([&] {
      return std::move(report_);
    });
  }

 private:
  /// As fine as asked for; with a budget of triangles, at the least tolerance that meets it.
  Result<Design> design() {
    auto finest = design_at(options_.tolerance_mm);
    if (!finest || !options_.max_triangles || finest->triangles <= *options_.max_triangles)
      return finest;
    double low = options_.tolerance_mm, high = coarsest_mm();
    auto coarsest = design_at(high);
    if (!coarsest) return coarsest;
    if (coarsest->triangles > *options_.max_triangles)
      return failure(ErrorKind::bad_input,
                     "max triangles: expected at least " + std::to_string(coarsest->triangles) +
                         " for this pot, found " + std::to_string(*options_.max_triangles));
    while (high > 1.02 * low) {
      const double middle = std::sqrt(low * high);
      auto tried = design_at(middle);
      if (!tried) return tried;
      if (tried->triangles > *options_.max_triangles) {
        low = middle;
      } else {
        high = middle;
        coarsest = std::move(tried);
      }
    }
    return coarsest;
  }

  double coarsest_mm() const {
    return std::max(0.1 * largest_radius_mm(stack_), options_.tolerance_mm);
  }

  Result<Design> design_at(double tolerance_mm) {
    Design design;
    design.tolerance_mm = tolerance_mm;
    return make_profile(design)
        .and_then([&] { return check_pieces(design.section.shapes, options_.allow_pieces); })
        .and_then([&] { return choose_segments(design.section.profile, tolerance_mm, options_); })
        .map([&](std::size_t segments) {
          design.segments = segments;
          design.triangles = triangle_count(design.section.profile, segments);
          return std::move(design);
        });
  }

  Result<void> make_profile(Design& design) {
    auto steps = stages_.run("profile", [&] { return profile_of(stack_, min_step_mm(stack_)); });
    if (!steps) return tl::make_unexpected(steps.error());
    design.section = std::move(*steps);
    if (options_.smoothing == Smoothing::none && options_.lip_fillet_mm == 0.0)
      design.no_smoothing = "not asked for";
    else if (has_straight_walls(stack_) && options_.lip_fillet_mm == 0.0)
      design.no_smoothing = "the walls are straight";
    else if (auto smoothed = smooth(design); !smoothed)
      return smoothed;
    return stages_.run("certificate", [&] { return certify(design.section.profile); })
        .map([&](const PlanarCertificate& planar) { design.planar = planar; });
  }

  Result<void> smooth(Design& design) {
    const SmoothingOptions how{options_.smoothing, design.tolerance_mm, options_.min_wall_mm,
                               options_.lip_fillet_mm, std::nullopt};
    if (options_.smoothing == Smoothing::exact)
      design.wall_as_steps_mm = min_wall_mm(design.section.profile);
    return stages_.run("smooth", [&] { return smooth_profile_of(stack_, how); })
        .map([&](SmoothedProfile smoothed) {
          design.section = std::exchange(smoothed.section, {});
          design.smoothed = std::move(smoothed);
          design.smoothing = options_.smoothing;
        });
  }

  Result<void> write_all(const Design& design) {
    const RevolveLayout rule(design.section.profile, design.segments);
    SolidCertificate claims = stages_.run(
        "claims", [&] { return claims_of(design.section.profile, design.segments, 0.0); });
    claims.counted_volume_mm3 = stack_.volume_mm3();
    describe_solid(design, rule, claims);
    RevolveFiles files(rule, claims, options_, stages_);
    for (const Output& output : outputs_) {
      auto file = files.write(output.format, *output.store);
      if (!file) return tl::make_unexpected(file.error());
      report_.files.push_back(std::move(*file));
    }
    report_.left_out =
        left_out(stack_, design.no_smoothing, rule, files.made_mesh(), outputs_, options_);
    return {};
  }

  void describe_solid(const Design& design, const RevolveLayout& rule,
                      const SolidCertificate& claims) {
    double widest = 0.0;
    for (const Shell& shell : rule.shells())
      for (const ProfilePoint& p : shell.points) widest = std::max(widest, p.rho);
    report_.diameter_mm = 2.0 * widest * equal_area_factor(design.segments);
    report_.height_mm = stack_.height_mm();
    report_.planar = design.planar;
    report_.shapes = design.section.shapes;
    report_.smoothing = design.smoothing;
    report_.kept_steps = design.smoothed.guard;
    report_.overshoot_mm = design.smoothed.overshoot_mm;
    report_.taken_mm = design.smoothed.taken_mm;
    report_.lip_fillet_mm = design.smoothed.lip_fillet_mm;
    report_.max_ring_error_relative = design.smoothed.max_ring_error_relative;
    report_.segments = design.segments;
    report_.triangles = design.triangles;
    report_.shells = rule.shells().size();
    report_.tolerance_mm = design.tolerance_mm;
    report_.chordal_error_mm = chordal_error_mm(widest, design.segments);
    report_.min_wall_mm = claims.wall_lower_mm;
    report_.thinnest = stages_.run("wall", [&] { return min_wall(design.section.profile); });
    if (design.wall_as_steps_mm > report_.thinnest.thickness_mm)
      report_.wall_as_steps_mm = design.wall_as_steps_mm;
    if (options_.wall_spacing_mm)
      report_.wall_field = stages_.run("wall_field", [&] {
        return wall_field(design.section.profile, *options_.wall_spacing_mm);
      });
    report_.counted_volume_mm3 = claims.counted_volume_mm3;
    report_.volume_mm3 = claims.volume_mm3;
    report_.volume_error_relative =
        std::abs(report_.volume_mm3 - report_.counted_volume_mm3) / report_.counted_volume_mm3;
  }

  const ClayStack& stack_;
  const std::vector<Output>& outputs_;
  const ExportOptions& options_;
  ExportReport report_;
  Stages stages_;
};

}  // namespace

namespace {

Result<ExportReport> export_as_it_is(const Pot& pot, const std::vector<Output>& outputs,
                                     const ExportOptions& options,
                                     const std::function<void(std::string_view)>& progress) {
  if (pot.collapse) return export_collapsed(pot, outputs, options, progress);
  if (!options.drain_mm) return ExportJob(pot.stack, outputs, options, progress).run();
  return drain(pot.stack, *options.drain_mm).and_then([&](const DrainedStack& drained) {
    return ExportJob(drained.stack, outputs, options, progress).run().map([&](ExportReport report) {
      report.drilled_mm3 = drained.drilled_mm3;
      return report;
    });
  });
}

}  // namespace

Result<ExportReport> run_export(const Pot& pot, const std::vector<Output>& outputs,
                                const ExportOptions& options,
                                const std::function<void(std::string_view)>& progress) {
  if (!(options.tolerance_mm > 0.0))
    return failure(ErrorKind::bad_input, "tolerance: expected more than 0 mm, found " +
                                             in_mm(options.tolerance_mm) + " mm");
  const CancelScope scope(options.cancelled ? &options.cancelled : nullptr);
  try {
    if (options.shrinkage == 0.0) return export_as_it_is(pot, outputs, options, progress);
    return enlarged(pot, options.shrinkage).and_then([&](const Pot& larger) {
      return export_as_it_is(larger, outputs, options, progress).map([&](ExportReport report) {
        report.shrinkage = options.shrinkage;
        return report;
      });
    });
  } catch (const Cancelled&) {
    return failure(ErrorKind::io, "export given up: cancelled");
  } catch (const std::exception& e) {
    return failure(ErrorKind::io, std::string("export given up: ") + e.what());
  }
}

}  // namespace clay::solid::inline job
