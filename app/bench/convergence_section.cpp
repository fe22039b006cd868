// Convergence: the influence of ring height and pose rate on pot and force.

#include "app/bench/convergence_experiments.hpp"
#include "app/bench/report/report.hpp"
#include "app/bench/section.hpp"

#include "claystack/engine/wheel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace clay::bench {
namespace {

constexpr double kMaxForcePercent = 1.0, kMaxProfilePercent = 0.5, kMaxRatePercent = 0.2,
                 kMaxForceRatePercent = 1.0;

struct Errors {
  double step = 0.0;  ///< ring height [mm], or period of the poses [us]
  double profile = 0.0, outline = 0.0, force = 0.0, force_most = 0.0;  ///< percent
};

Errors errors(const Experiment& e, double step, const Played& run, const Played& reference) {
  const auto profile = profile_difference(run.stack, reference.stack);
  const auto force = force_difference(run, reference);
  const double percent = 100.0 / e.scene.lump.outer_radius_mm;
  return {step, percent * profile.rms_mm, percent * profile.outline_mm, force.rms_percent,
          force.most_percent};
}

/// Compares rings refined by each factor with the last one.
std::vector<Errors> over_rings(const Experiment& e, const std::vector<std::size_t>& factors) {
  const Played reference = played(refined(e.scene, factors.back()), e.poses);
  std::vector<Errors> rows;
  for (std::size_t k = 0; k + 1 < factors.size(); ++k)
    rows.push_back(errors(e, e.scene.lump.ring_height_mm / static_cast<double>(factors[k]),
                          played(refined(e.scene, factors[k]), e.poses), reference));
  return rows;
}

/// The same for the period of the poses.
std::vector<Errors> over_rate(const Experiment& e, const std::vector<std::int64_t>& periods_us) {
  const Played reference = played(e.scene, resampled(e.poses, periods_us.back()));
  std::vector<Errors> rows;
  for (std::size_t k = 0; k + 1 < periods_us.size(); ++k)
    rows.push_back(errors(e, static_cast<double>(periods_us[k]),
                          played(e.scene, resampled(e.poses, periods_us[k])), reference));
  return rows;
}

/// log2 of the ratio of an error to that at half the step; empty without an error.
Cell order(const std::vector<Errors>& rows, std::size_t k, double Errors::*error) {
  if (k + 1 >= rows.size() || !(rows[k + 1].*error > 1e-9)) return {};
  return std::log2(rows[k].*error / (rows[k + 1].*error)) /
         std::log2(rows[k].step / rows[k + 1].step);
}

void add_rows(Table& table, Plot& profile, Plot& force, const std::string& name,
              const std::vector<Errors>& rows) {
  Curve in_profile, in_force;
  in_profile.name = in_force.name = name;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Errors& row = rows[k];
    table.rows.push_back({name, row.step, row.profile, order(rows, k, &Errors::profile),
                          row.outline, row.force, order(rows, k, &Errors::force), row.force_most});
    in_profile.x.push_back(row.step);
    in_profile.y.push_back(row.profile);
    in_force.x.push_back(row.step);
    in_force.y.push_back(row.force);
  }
  profile.curves.push_back(std::move(in_profile));
  force.curves.push_back(std::move(in_force));
}

Table table_of(std::string id, std::string title, Column step) {
  Table table;
  table.id = std::move(id);
  table.title = std::move(title);
  table.columns = {{"stroke", ""},        std::move(step),
                   {"profile", "% of R"}, {"profile_order", ""},
                   {"outline", "% of R"}, {"force", "% of largest"},
                   {"force_order", ""},   {"force_most", "% of largest"}};
  table.note =
      "profile: root mean square of R(y) and r(y) over the height; outline: maximum distance of "
      "the sections' outlines; force: root mean square over time, and maximum over the poses; each "
      "compared with the finest run. Orders: log2 of the ratio to the error at half the step. They "
      "are up to 0.2 too high near the end, because the finest run is not the limit.";
  return table;
}

Plot plot_of(std::string id, std::string title, std::string step, std::string error) {
  Plot plot;
  plot.id = std::move(id);
  plot.title = std::move(title);
  plot.x = {std::move(step), true};
  plot.y = {std::move(error), true};
  return plot;
}

Table exact_table(Section& section) {
  Table table;
  table.id = "convergence_exact";
  table.title = "A rib at rest compared with its exact solution";
  table.columns = {
      {"ring_height", "mm"}, {"rate", "Hz"}, {"wall_error", "mm"}, {"force_error", "N"}};
  for (const auto& [h, rate_hz] :
       {std::pair{1.0, 250.0}, {0.5, 1000.0}, {0.1, 1000.0}, {0.5, 8000.0}}) {
    const RestingRib rib = resting_rib(h, rate_hz);
    Wheel wheel = Wheel::build(rib.scene).value();
    double wall = 0.0, force = 0.0;
    for (const Pose& pose : rib.poses) {
      const double t_s = 1e-6 * static_cast<double>(pose.time_us);
      const double force_n = wheel.step(pose).force_n().x;
      const Ring& ring = wheel.stack().rings()[static_cast<std::size_t>(30.0 / h)];
      force = std::max(force, std::abs(force_n - rib.force_n(t_s)));
      wall = std::max(wall, std::abs(ring.outer_mm() - ring.inner_mm() - rib.wall_mm(t_s)));
    }
    section.require(wall < 1e-6 && force < 1e-6,
                    fmt::format("a rib at rest, rings of {} mm at {} Hz: required 1e-6 mm and N, "
                                "measured {} mm and {} N",
                                h, rate_hz, short_number(wall), short_number(force)));
    table.rows.push_back({h, rate_hz, wall, force});
  }
  table.note = "w = w0 exp(-kappa t) to the yield depth, then the logistic curve; F = K' L depth.";
  return table;
}

/// The requirements, each as the worst case over all strokes.
struct Worst {
  double force_h10 = 0.0, profile_h10 = 0.0, profile_rate = 0.0, force_rate = 0.0;
};

void compare_tenfold(const Experiment& e, Worst& worst) {
  const Played run = played(e.scene, e.poses);
  const Errors h10 = errors(e, 0.0, run, played(refined(e.scene, 10), e.poses));
  const Errors rate = errors(e, 0.0, run, played(e.scene, resampled(e.poses, 250)));
  worst.force_h10 = std::max(worst.force_h10, h10.force);
  worst.profile_h10 = std::max(worst.profile_h10, h10.profile);
  worst.profile_rate = std::max(worst.profile_rate, rate.profile);
  worst.force_rate = std::max(worst.force_rate, rate.force);
}

void conclude(Section& section, const Worst& worst) {
  add_at_most(
      section, "force_change_percent_h10", counted(worst.force_h10), kMaxForcePercent,
      "root mean square change of the force with 10 times finer rings, of the largest force");
  add_at_most(section, "profile_change_percent_h10", counted(worst.profile_h10), kMaxProfilePercent,
              "of the profile, of R");
  add_at_most(section, "profile_change_percent_1k_4k", counted(worst.profile_rate), kMaxRatePercent,
              "of the profile from 1 kHz to 4 kHz, of R");
  add_at_most(section, "force_change_percent_1k_4k", counted(worst.force_rate),
              kMaxForceRatePercent, "of the force from 1 kHz to 4 kHz, of the largest force");
}

}  // namespace

Section convergence_section(const Effort& effort) {
  Section section;
  section.id = "convergence";
  section.title = "Convergence in ring height and pose rate";
  section.summary =
      "The same strokes on finer rings and at other rates, compared with the finest run and, if "
      "there is one, the exact solution. The result must not depend on either. ";

  using Factors = std::vector<std::size_t>;
  using Periods = std::vector<std::int64_t>;
  const auto factors = effort.quick ? Factors{1, 2, 4, 16} : Factors{1, 2, 4, 8, 16, 64};
  const auto periods = effort.quick ? Periods{4000, 2000, 1000, 500, 50}
                                    : Periods{4000, 2000, 1000, 500, 250, 125, 25};
  Table rings = table_of("convergence_rings", "Finer rings", {"ring_height", "mm"});
  Table rates = table_of("convergence_rate", "Higher pose rates", {"period", "us"});
  Plot ring_profile = plot_of("convergence_rings_profile", "Profile against ring height",
                              "ring height [mm]", "error [% of R]");
  Plot ring_force = plot_of("convergence_rings_force", "Force against ring height",
                            "ring height [mm]", "error [% of the largest]");
  Plot rate_profile = plot_of("convergence_rate_profile", "Profile against the period of the poses",
                              "period [us]", "error [% of R]");
  Plot rate_force = plot_of("convergence_rate_force", "Force against the period of the poses",
                            "period [us]", "error [% of the largest]");
  Worst worst;
  for (const Experiment& e : convergence_experiments()) {
    effort.progress(e.name);
    add_rows(rings, ring_profile, ring_force, e.name, over_rings(e, factors));
    add_rows(rates, rate_profile, rate_force, e.name, over_rate(e, periods));
    compare_tenfold(e, worst);
  }
  conclude(section, worst);
  section.tables = {std::move(rings), std::move(rates), exact_table(section)};
  section.plots = {std::move(ring_profile), std::move(ring_force), std::move(rate_profile),
                   std::move(rate_force)};
  return section;
}

}  // namespace clay::bench
