#include "export/job/revolved_export.hpp"

#include "claystack/engine/clay.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/export/option_ranges.hpp"
#include "claystack/export/solid.hpp"
#include "export/job/file_estimates.hpp"
#include "export/job/left_out.hpp"
#include "export/job/resolution.hpp"
#include "export/job/revolve_files.hpp"
#include "export/job/stages.hpp"
#include "export/proof/rounded_claims.hpp"
#include "export/smoothing/profile_smoothing.hpp"
#include "export/solid/revolve_layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace clay::solid::inline job {
namespace {

/// Steps too narrow for float32 to separate with a margin.
double min_step_mm(const ClayStack& stack) {
  return std::ldexp(std::hypot(largest_radius_mm(stack), stack.height_mm()), -19);
}

/// True if the only steps are floors and lids.
bool has_straight_walls(const ClayStack& stack) {
  const auto rings = stack.rings();
  for (std::size_t i = 1; i < rings.size(); ++i) {
    const Ring &below = rings[i - 1], &above = rings[i];
    const bool floor = below.inner2 == 0 || above.inner2 == 0;
    if (below.outer2 != above.outer2 || (!floor && below.inner2 != above.inner2)) return false;
  }
  return true;
}

/// A proved section, its revolve, and the claims about it.
struct Design {
  ProvedSection section;
  SolidSize size;
  SolidCertificate claims;
};

class RevolvedExport {
 public:
  RevolvedExport(const PreparedPot& prepared, const std::vector<Output>& outputs,
                 const ExportOptions& options,
                 const std::function<void(std::string_view)>& progress)
      : prepared_(prepared),
        stack_(prepared.pot.stack),
        outputs_(outputs),
        options_(options),
        stages_(report_.stages, progress) {}

  Result<ExportReport> run() {
    const auto fits = outputs_.empty() ? Result<void>() : check_height(stack_.height_mm());
    const auto designed =
        fits.and_then([&] { return take_section(); }).and_then([&] { return design(); });
    return named(designed, options_.source)
        .and_then([&](Design design) { return write_all(std::move(design)); })
        .map([&] { return std::move(report_); });
  }

 private:
  /// Computed once; does not depend on the tolerance.
  Result<void> take_section() {
    return stages_.run("profile", [&] { return profile_of(stack_, min_step_mm(stack_)); })
        .map([&](StackProfile steps) { steps_ = std::move(steps); });
  }

  /// At the requested resolution; with a limit of triangles, at the smallest tolerance that meets
  /// it.
  Result<Design> design() {
    auto finest = design_at(options_.tolerance_mm);
    if (!finest || !options_.max_triangles || finest->size.triangles <= *options_.max_triangles)
      return finest;
    return coarser_design(finest->size.triangles);
  }

  /// A design that fails is too coarse. `fewest`: the triangles of the requested resolution.
  Result<Design> coarser_design(std::size_t fewest) {
    std::optional<Design> best;
    double low = options_.tolerance_mm, high = coarsest_mm();
    for (double tried_mm = high; high > 1.02 * low; tried_mm = std::sqrt(low * high)) {
      auto tried = design_at(tried_mm);
      if (!tried) {
        high = tried_mm;
        continue;
      }
      fewest = std::min(fewest, tried->size.triangles);
      if (tried->size.triangles > *options_.max_triangles) {
        low = tried_mm;
      } else {
        high = tried_mm;
        best = std::move(*tried);
      }
    }
    if (best) return std::move(*best);
    return failure(ErrorKind::bad_input, "max triangles: expected at least " +
                                             std::to_string(fewest) + " for this pot, found " +
                                             std::to_string(*options_.max_triangles));
  }

  double coarsest_mm() const {
    double coarsest = 0.1 * largest_radius_mm(stack_);
    if (const double glaze = options_.finish.glaze_mm; glaze > 0.0)
      coarsest = std::min(coarsest, glaze / kGlazeOfTolerance);
    return std::max(coarsest, options_.tolerance_mm);
  }

  /// Smoothing respects the limit only where that is necessary and sufficient: the walls keep the
  /// limit with it, and not without it.
  Result<Design> design_at(double tolerance_mm) {
    auto free = design_with(std::nullopt, tolerance_mm);
    if (!prepared_.limit) return free;
    const WallLimit& limit = *prepared_.limit;
    const auto keeps_it = [&limit](const Result<Design>& design) {
      return design && limit.met_by(stated_wall_mm(design->claims, layout_of(*design)));
    };
    if (keeps_it(free)) return free;
    auto limited = design_with(limit.min_wall_mm, tolerance_mm);
    return keeps_it(limited) || !free ? limited : free;
  }

  Result<Design> design_with(std::optional<double> min_wall_mm, double tolerance_mm) {
    Design design;
    design.size.tolerance_mm = tolerance_mm;
    return smooth(design.section, min_wall_mm, tolerance_mm)
        .and_then([&] { return check_pieces(design.section.shapes(), options_.allow_pieces); })
        .and_then([&] { return finish(design.section, tolerance_mm); })
        .and_then([&] {
          return stages_.run("certificate", [&] { return certify(design.section.profile()); });
        })
        .and_then([&](const PlanarCertificate& planar) {
          design.section.planar = planar;
          return choose_segments(design.section.profile(), tolerance_mm, options_);
        })
        .and_then([&](std::size_t segments) {
          design.size.segments = segments;
          design.size.triangles = triangle_count(design.section.profile(), segments);
          // Without a mesh, as for a drawing, the number of triangles costs nothing.
          if (!outputs_.empty())
            if (auto few = check_triangles(design.size.triangles, segments, options_); !few)
              return Result<Design>(tl::make_unexpected(few.error()));
          design.claims = stages_.run(
              "claims", [&] { return claims_of(design.section.profile(), segments, 0.0); });
          return Result<Design>(std::move(design));
        });
  }

  /// As rounded in a binary STL, so that a pot has one wall before and after it is written.
  static double stated_wall_mm(const SolidCertificate& claims, const RevolveLayout& rule) {
    return with_rounding(claims, rule, float_rounding_mm(rule)).wall_lower_mm;
  }

  static RevolveLayout layout_of(const Design& design) {
    return {design.section.profile(), design.size.segments};
  }

  /// As requested, or as the process requires.
  double lip_fillet_mm() const {
    const std::optional<ProcessLimits>& process = options_.walls.process;
    const bool required = process && process->edges && options_.smoothing == Smoothing::fair;
    return options_.lip_fillet_mm.value_or(required ? process->edges->min_radius_mm : 0.0);
  }

  /// As requested, or of the tool, on the enlarged pot.
  double smooth_length_mm(double tolerance_mm) const {
    const double usual = options_.smoothing == Smoothing::fair
                             ? usual_smooth_length_mm(prepared_.pot, tolerance_mm)
                             : 0.0;
    return options_.smooth_length_mm.value_or(usual) * enlargement(options_.shrinkage);
  }

  Result<void> smooth(ProvedSection& section, std::optional<double> min_wall_mm,
                      double tolerance_mm) {
    const double lip_mm = lip_fillet_mm();
    const double length_mm = smooth_length_mm(tolerance_mm);
    if (options_.smoothing == Smoothing::none && lip_mm == 0.0 && length_mm == 0.0)
      section.no_smoothing = "not requested";
    else if (has_straight_walls(stack_) && lip_mm == 0.0)
      section.no_smoothing = "the walls are straight";
    if (!section.no_smoothing.empty()) {
      section.smoothed.section = steps_;
      return {};
    }
    SmoothingOptions how{options_.smoothing, tolerance_mm, {}, lip_mm, {}};
    how.smooth_length_mm = length_mm;
    how.min_wall_mm = min_wall_mm;
    return stages_.run("smooth", [&] { return smoothed_profile(stack_, steps_, how); })
        .map([&](SmoothedProfile smoothed) {
          section.smoothed = std::move(smoothed);
          section.smoothing = options_.smoothing;
        });
  }

  Result<void> finish(ProvedSection& section, double tolerance_mm) {
    if (!options_.finish.asked()) return {};
    std::optional<double> min_wall_mm;
    if (prepared_.limit) min_wall_mm = prepared_.limit->min_wall_mm;
    return stages_
        .run(
            "finish",
            [&] { return finished(section.profile(), options_.finish, min_wall_mm, tolerance_mm); })
        .map([&](FinishedProfile made) {
          section.glazed = glaze_on(section.profile(), tolerance_mm);
          section.smoothed.section.profile = std::move(made.profile);
          section.finish = made.ledger;
        });
  }

  /// The same finish without the set-back: glaze on an arc of the floor makes it tighter.
  std::optional<Profile> glaze_on(const Profile& profile, double tolerance_mm) const {
    Finish finish = options_.finish;
    if (finish.glaze_mm == 0.0) return {};
    finish.floor_fillet_mm = std::max(finish.floor_fillet_mm - finish.glaze_mm, 0.0);
    finish.glaze_mm = 0.0;
    auto made = finished(profile, finish, std::nullopt, tolerance_mm);
    return made ? std::optional(std::move(made->profile)) : std::nullopt;
  }

  /// The clay of the stack, after finishing.
  double counted_volume_mm3(const FinishLedger& finish) const {
    return prepared_.done.counted_volume_mm3 - finish.trimmed_mm3() + finish.floor_added_mm3;
  }

  Result<void> write_all(Design design) {
    const RevolveLayout rule = layout_of(design);
    SolidCertificate claims = design.claims;
    claims.counted_volume_mm3 = counted_volume_mm3(design.section.finish);
    report_.prepared = prepared_.done;
    report_.prepared.counted_volume_mm3 = claims.counted_volume_mm3;
    report_.section = std::move(design.section);
    report_.size = measured(design.size, rule);
    report_.volume = {claims.volume_mm3, std::abs(claims.volume_mm3 - claims.counted_volume_mm3) /
                                             claims.counted_volume_mm3};
    measure_walls(stated_wall_mm(claims, rule));
    report_.maker = numbers();
    announce_sizes();
    if (auto room = expect_memory(); !room) return room;
    RevolveFiles files(rule, claims, report_.walls, options_, stages_);
    for (const Output& output : outputs_) {
      auto file = named(files.write(output.format, *output.store),
                        output.name.empty() ? options_.source : output.name);
      if (!file) return tl::make_unexpected(file.error());
      report_.files.push_back(std::move(*file));
    }
    report_.left_out =
        left_out(stack_, report_.section.no_smoothing, rule, files.made_mesh(), outputs_, options_);
    return {};
  }

  void announce_sizes() const {
    if (!options_.announce_size) return;
    for (const Output& output : outputs_)
      options_.announce_size(output.name, report_.size.triangles,
                             usual_file_bytes(output.format, options_, report_.size.triangles));
  }

  /// The files are made one after the other, and each is released.
  Result<void> expect_memory() const {
    std::uint64_t bytes = 0;
    for (const Output& output : outputs_)
      bytes = std::max(bytes, mesh_memory(output.format, options_, report_.size.triangles));
    if (bytes == 0 || !options_.expect_memory) return {};
    return named(options_.expect_memory(bytes), options_.source);
  }

  SolidSize measured(SolidSize size, const RevolveLayout& rule) const {
    double widest = 0.0, lowest = stack_.height_mm(), highest = 0.0;
    for (const Shell& shell : rule.shells())
      for (const ProfilePoint& p : shell.points) {
        widest = std::max(widest, p.rho);
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
      }
    size.shells = rule.shells().size();
    size.chordal_error_mm = chordal_error_mm(widest, size.segments);
    size.diameter_mm = 2.0 * widest * equal_area_factor(size.segments);
    size.height_mm = highest - lowest;
    size.extents_mm = round_size_mm(size.diameter_mm, size.height_mm);
    return size;
  }

  void measure_walls(double min_wall_mm) {
    const Profile& profile = report_.section.profile();
    WallReport& walls = report_.walls;
    walls.min_wall_mm = min_wall_mm;
    walls.thinnest = stages_.run("wall", [&] { return min_wall(profile); });
    if (report_.section.smoothing == Smoothing::exact) {
      const Wall of_steps = stages_.run("wall", [&] { return min_wall(steps_.profile); });
      if (of_steps.thickness_mm > walls.thinnest.thickness_mm)
        walls.as_steps_mm = of_steps.thickness_mm;
    }
    if (options_.wall_spacing_mm) {
      walls.field =
          stages_.run("wall_field", [&] { return wall_field(profile, *options_.wall_spacing_mm); });
      walls.parts = walls_by_part(profile, walls.field, walls.thinnest, min_wall_mm);
    }
    walls.limit = options_.walls.for_size(size_sum_mm(report_.size.extents_mm));
    report_.process.limits = options_.walls.process;
    report_.process.overhang = stages_.run("overhang", [&] { return steepest_overhang(profile); });
  }

  MakerNumbers numbers() const {
    ClayFigures clay = options_.clay;
    clay.density_g_cm3 = prepared_.pot.density_g_cm3;
    clay.shrinkage = options_.shrinkage;
    MakerNumbers numbers = maker_numbers(report_.section.profile(), clay, options_.fill_line_mm);
    if (report_.section.glazed) add_glaze(numbers, *report_.section.glazed);
    return numbers;
  }

  const PreparedPot& prepared_;
  const ClayStack& stack_;
  const std::vector<Output>& outputs_;
  const ExportOptions& options_;
  StackProfile steps_;
  ExportReport report_;
  Stages stages_;
};

}  // namespace

double tool_length_mm(const Pot& pot) {
  if (!pot.thrown_with) return 0.0;
  const auto tool = Tool::build(pot.shaped_with.value_or(pot.thrown_with->tool).shape);
  return tool ? std::min(tool->widest(), 0.5 * (tool->high() - tool->low())) : 0.0;
}

double usual_smooth_length_mm(const Pot& pot, double tolerance_mm) {
  constexpr double kCoarsestMm = 0.1;
  const bool ruled = pot.thrown_with && pot.thrown_with->clay;
  return ruled && tolerance_mm <= kCoarsestMm ? tool_length_mm(pot) : 0.0;
}

Result<ExportReport> export_revolved(const PreparedPot& prepared,
                                     const std::vector<Output>& outputs,
                                     const ExportOptions& options,
                                     const std::function<void(std::string_view)>& progress) {
  return RevolvedExport(prepared, outputs, options, progress).run();
}

}  // namespace clay::solid::inline job
