// Scales a pot until it meets a goal: a capacity, a weight or a size.

#include "claystack/export/job.hpp"

#include "core/text.hpp"
#include "export/job/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid::inline job {
namespace {

constexpr double kClose = 1e-6;  // relative
/// Relative, where a figure jumps over the goal: at a slightly other size, smoothing decides
/// differently.
constexpr double kCloseAtJump = 1e-3;
constexpr int kMostSteps = 40;
constexpr double kFarthest = 50.0;  // of a factor from 1

/// One requested number, and the powers of the factors on radius and height by which it grows.
struct Aim {
  std::string name;
  double target = 0.0;
  double (*of)(const PotState& pot);
  double power_of_radius = 0.0, power_of_height = 0.0;
};

std::vector<Aim> aims_of(const Goal& goal) {
  std::vector<Aim> aims;
  const auto add = [&](const char* name, const std::optional<double>& target, auto of,
                       double radius, double height) {
    if (target) aims.push_back({name, *target, of, radius, height});
  };
  add(
      "height [mm]", goal.height_mm, [](const PotState& pot) { return pot.size.height_mm; }, 0, 1);
  add(
      "diameter [mm]", goal.diameter_mm, [](const PotState& pot) { return pot.size.diameter_mm; },
      1, 0);
  add(
      "capacity [ml]", goal.to_fill_line ? std::nullopt : goal.holds_ml,
      [](const PotState& pot) { return pot.capacity_ml; }, 2, 1);
  add(
      "capacity to the fill line [ml]", goal.to_fill_line ? goal.holds_ml : std::nullopt,
      [](const PotState& pot) { return pot.to_line_ml; }, 2, 1);
  add(
      "weight [g]", goal.weighs_g, [](const PotState& pot) { return pot.weight_g; }, 2, 1);
  return aims;
}

Result<void> check_aims(const std::vector<Aim>& aims, const Goal& goal,
                        const ExportOptions& options) {
  const auto wrong = [](const std::string& text) { return failure(ErrorKind::bad_input, text); };
  if (aims.empty()) return wrong("goal: expected a capacity, a weight, a height or a diameter");
  for (const Aim& aim : aims)
    if (!(aim.target > 0.0 && std::isfinite(aim.target)))
      return wrong(aim.name + ": expected more than 0, found " + nine_digit_text(aim.target));
  if (aims.size() > 2 || (aims.size() == 2 && aims[0].power_of_radius == 2.0))
    return wrong(
        "goal: expected one figure, or a height or diameter with one other: capacity, weight, "
        "height or diameter");
  if (goal.fired && options.shrinkage == 0.0 && options.finish.glaze_mm == 0.0)
    return wrong("goal of the fired pot: expected a shrinkage or a glaze allowance, found neither");
  return {};
}

/// Factors on the pot.
struct Scale {
  double radius = 1.0, height = 1.0;
};

/// Removes options that cost time and change no figure of the pot.
ExportOptions to_measure(ExportOptions options) {
  options.wall_spacing_mm.reset();
  options.measure_left_out = options.full_verification = false;
  return options;
}

class GoalSearch {
 public:
  GoalSearch(const Pot& pot, const Goal& goal, const ExportOptions& options)
      : pot_(pot), goal_(goal), options_(to_measure(options)), aims_(aims_of(goal)) {}

  Result<GoalReport> run() {
    if (pot_.collapse)
      return failure(ErrorKind::bad_input, "goal: expected a standing pot, found a collapsed one");
    // A length meets its goal by its own factor; each step brings all others closer.
    Scale nearest;
    double least_miss = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps; ++step) {
      auto measured = measure();
      if (!measured) return tl::make_unexpected(measured.error());
      const double miss = miss_of(*measured);
      if (miss <= kClose) return accept(*measured);
      if (miss < least_miss) {
        least_miss = miss;
        nearest = scale_;
      }
      if (auto moved = move(*measured); !moved) return tl::make_unexpected(moved.error());
    }
    if (least_miss > kCloseAtJump)
      return failure(ErrorKind::bad_input,
                     "goal: expected a size at which the pot meets it, found none");
    scale_ = nearest;
    return measure().and_then([&](const ExportReport& report) { return accept(report); });
  }

 private:
  /// The report of the pot at the present scale; nothing is written.
  Result<ExportReport> measure() {
    return scaled(pot_, scale_.radius, scale_.height)
        .map_error([](const Error& error) {
          return Error{error.kind, "goal: " + error.message};
        })
        .and_then([&](Pot pot) {
          scaled_pot_ = std::move(pot);
          return run_export(scaled_pot_, {}, options_);
        });
  }

  /// A goal of the finished pot counts the glaze.
  [[nodiscard]] const PotState& state(const ExportReport& report) const {
    const MakerNumbers& numbers = *report.maker;
    if (!goal_.fired) return numbers.thrown;
    return numbers.glazed ? *numbers.glazed : numbers.in_use();
  }

  /// The largest distance of a figure from its goal, relative to the goal.
  [[nodiscard]] double miss_of(const ExportReport& report) const {
    double miss = 0.0;
    for (const Aim& aim : aims_)
      miss = std::max(miss, std::abs(aim.of(state(report)) / aim.target - 1.0));
    return miss;
  }

  Result<void> move(const ExportReport& report) {
    std::array<double, 2> ratios{1.0, 1.0};
    for (std::size_t i = 0; i < aims_.size(); ++i) {
      const double found = aims_[i].of(state(report));
      if (!(found > 0.0)) return failure(ErrorKind::bad_input, aims_[i].name + nothing(report));
      ratios[i] = aims_[i].target / found;
    }
    const Aim& first = aims_[0];
    const double powers = first.power_of_radius + first.power_of_height;
    if (aims_.size() == 1) {
      const double even = std::pow(ratios[0], 1.0 / powers);
      scale_ = {scale_.radius * even, scale_.height * even};
    } else {
      // The length sets its own factor, the other number sets the other factor.
      const bool height = first.power_of_height == 1.0;
      double& own = height ? scale_.height : scale_.radius;
      double& other = height ? scale_.radius : scale_.height;
      own *= ratios[0];
      const double by_own = height ? aims_[1].power_of_height : aims_[1].power_of_radius;
      const double by_other = height ? aims_[1].power_of_radius : aims_[1].power_of_height;
      other *= std::pow(ratios[1] / std::pow(ratios[0], by_own), 1.0 / by_other);
    }
    for (const double factor : {scale_.radius, scale_.height})
      if (!(factor < kFarthest && factor > 1.0 / kFarthest))
        return failure(ErrorKind::bad_input,
                       first.name + ": expected a goal that scales the pot by a factor from " +
                           short_number_text(1.0 / kFarthest) + " to " +
                           short_number_text(kFarthest) + ", found " +
                           nine_digit_text(first.target) + ", a factor of " +
                           short_number_text(factor));
    return {};
  }

  /// Reason why the pot holds nothing.
  [[nodiscard]] std::string nothing(const ExportReport& report) const {
    if (state(report).capacity_ml > 0.0)
      return ": expected a fill line above the floor of the pot, found one " +
             nine_digit_text(options_.fill_line_mm) + " mm below the brim";
    return ": expected a pot that has one, found none: " + report.maker->no_capacity;
  }

  Result<GoalReport> accept(const ExportReport& report) {
    if (const auto& limit = report.walls.limit; limit && !limit->met_by(report.walls.min_wall_mm))
      return failure(
          ErrorKind::unsound,
          fmt::format("goal: scaled by {:.4f} across and {:.4f} up, thin wall: ", scale_.radius,
                      scale_.height) +
              thin_wall_text(report.section.profile(), report.walls.min_wall_mm, *limit));
    const bool glazed = goal_.fired && report.maker->glazed.has_value();
    return GoalReport{std::move(scaled_pot_), {goal_, glazed, scale_.radius, scale_.height}};
  }

  const Pot& pot_;
  const Goal& goal_;
  const ExportOptions options_;
  std::vector<Aim> aims_;
  Scale scale_;
  Pot scaled_pot_;
};

}  // namespace

std::string text_of(const MetGoal& met) {
  const Goal& goal = met.goal;
  std::string text;
  const auto add = [&](const std::optional<double>& number, const char* before, const char* after) {
    if (number)
      text.append(text.empty() ? "" : ", ").append(before + short_number_text(*number) + after);
  };
  add(goal.holds_ml, "holds ", goal.to_fill_line ? " ml to the fill line" : " ml to the brim");
  // The weight of the glaze is not known.
  const bool only_weight = !goal.holds_ml && !goal.height_mm && !goal.diameter_mm;
  add(goal.weighs_g, "weighs ", met.glazed && !only_weight ? " g without its glaze" : " g");
  add(goal.height_mm, "", " mm high");
  add(goal.diameter_mm, "", " mm wide");
  if (!goal.fired) return text + ", wet";
  if (!met.glazed) return text + ", fired";
  return text + (only_weight ? ", fired, without its glaze" : ", fired and glazed");
}

Result<GoalReport> scaled_to(const Pot& pot, const Goal& goal, const ExportOptions& options) {
  // The request alone is at fault, and not the pot.
  const auto checked =
      check_ranges(options).and_then([&] { return check_aims(aims_of(goal), goal, options); });
  if (!checked) return tl::make_unexpected(checked.error());
  return named(GoalSearch(pot, goal, options).run(), options.source);
}

}  // namespace clay::solid::inline job
