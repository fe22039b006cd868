// Invalid poses and times.

#include "app/bench/extreme/trial.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace clay::extreme {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kLatest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kEarliest = std::numeric_limits<std::int64_t>::min();

void start(Trial& trial) { trial.stroke({40, 24, 0}, {36, 28, 0}, 40); }

/// Each invalid pose leaves the state unchanged to the bit and gives no force; the stroke then
/// continues as if it had not occurred.
Outcome dropped(Model model, const std::vector<glm::dvec3>& bad) {
  Trial trial(model, small_pot()), undisturbed(model, small_pot());
  start(trial);
  start(undisturbed);
  for (const glm::dvec3& pose : bad) {
    const std::string before = trial.subject().bytes();
    const Tick tick = trial.at(pose);
    trial.require(trial.subject().bytes() == before, "the clay changed");
    trial.require(tick.force_n == glm::dvec3(0.0), "a force from an invalid pose");
  }
  // Deeper at the same height, the flow depends only on the last valid pose, its time and the
  // direction before it.
  trial.at({34, 28, 0}, false, 1000);
  undisturbed.at({34, 28, 0}, false, 1000 * (static_cast<std::int64_t>(bad.size()) + 1));
  trial.stroke({36, 28, 0}, {36, 34, 0}, 60);
  undisturbed.stroke({36, 28, 0}, {36, 34, 0}, 60);
  trial.require(trial.touched(), "no contact");
  trial.require(trial.subject().bytes() == undisturbed.subject().bytes(),
                "an invalid pose changed a later result");
  return trial.done(fmt::format("{} poses dropped", bad.size()));
}

Outcome nan_pose(Model model) {
  return dropped(model, {{kNan, 28, 0}, {36, kNan, 0}, {36, 28, kNan}});
}
Outcome nan_velocity(Model model) { return dropped(model, {{36, kNan, 0}}); }
Outcome infinite_pose(Model model) {
  return dropped(
      model, {{kInfinity, 28, 0}, {36, kInfinity, 0}, {36, -kInfinity, 0}, {36, 28, -kInfinity}});
}
Outcome pose_1e300(Model model) {
  return dropped(model, {{1e300, 28, 0}, {36, 1e300, 0}, {36, -1e300, 0}, {-1e300, 28, 1e300}});
}

Outcome first_pose_nan(Model model) {
  Trial trial(model, small_pot());
  trial.at({36, kNan, 0});
  start(trial);
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

/// From +0 to -0 is no motion: the direction is unchanged.
Outcome minus_zero(Model model) {
  Trial trial(model, small_pot()), plain(model, small_pot());
  for (Trial* t : {&trial, &plain}) t->stroke({45, -6, 0}, {36, 0.0, 0}, 40);
  for (int k = 0; k < 20; ++k) {
    trial.at({36, k % 2 == 0 ? -0.0 : 0.0, -0.0});
    plain.at({36, 0.0, 0.0});
  }
  trial.require(trial.touched(), "no contact");
  trial.require(trial.subject().bytes() == plain.subject().bytes(), "-0 is not 0");
  return trial.done();
}

Outcome denormal_pose(Model model) {
  SceneSpec scene = small_pot();
  Trial trial(model, scene);
  trial.stroke({0, 70, 0}, {5e-324, 66, 5e-324}, 20);
  for (const double d : {5e-324, 1e-310, 1e-200, 1e-160, 1e-100})
    for (const double y : {66.0, 65.9}) {
      trial.at({d, y, 0});
      trial.at({-d, y, d});
    }
  trial.require(trial.touched(), "no contact");
  return trial.done();
}

/// Times of poses; only the engine uses them.
struct Clocked {
  std::int64_t time_us;
  bool refused;
};

Outcome at_times(Model model, const std::vector<Clocked>& times) {
  if (model == Model::literal) return {Verdict::not_in_print, "the paper's model has no time"};
  const auto subject = std::move(make_subject(model, small_pot()).value());
  const Exact clay = subject->clay().value();
  double x = 37.0;
  for (const Clocked& clock : times) {
    const std::string before = subject->bytes();
    const Tick tick = subject->step({clock.time_us, {x -= 0.05, 30, 0}, false});
    if (tick.refused != clock.refused)
      return {Verdict::failed,
              fmt::format("time {}: {}", clock.time_us, clock.refused ? "accepted" : "refused")};
    if (tick.refused && (subject->bytes() != before || tick.force_n != glm::dvec3(0.0)))
      return {Verdict::failed,
              fmt::format("time {}: refused, but it had an effect", clock.time_us)};
    if (!subject->fault().empty()) return {Verdict::failed, subject->fault()};
  }
  if (*subject->clay() != clay) return {Verdict::failed, "clay lost"};
  return {Verdict::passed, fmt::format("{} ticks, 0 quanta", times.size())};
}

Outcome time_stands_still(Model model) {
  return at_times(model, {{0, false}, {1000, false}, {1000, true}, {1000, true}, {2000, false}});
}
Outcome time_runs_back(Model model) {
  return at_times(model,
                  {{5000, false}, {4000, true}, {4999, true}, {kEarliest, true}, {5001, false}});
}
Outcome time_leaps(Model model) {
  return at_times(
      model, {{kEarliest, false}, {kLatest, false}, {kLatest, true}, {kEarliest, true}, {0, true}});
}

/// A long pause counts as 50 ms: the same clay as after exactly 50 ms.
Outcome long_pause(Model model) {
  if (model == Model::literal) return {Verdict::not_in_print, "the paper's model has no time"};
  const auto after = [&](std::int64_t pause_us, Tick& tick) {
    Trial trial(model, small_pot());
    start(trial);
    tick = trial.at({35.5, 28.5, 0}, false, pause_us);
    return trial.subject().bytes();
  };
  Tick at_limit, beyond, far_beyond;
  const std::string expected = after(50'000, at_limit);
  const bool same = after(50'001, beyond) == expected && after(kLatest / 2, far_beyond) == expected;
  const bool reported = !at_limit.long_step && beyond.long_step && far_beyond.long_step;
  if (!same) return {Verdict::failed, "a pause of more than 50 ms moves more clay"};
  if (!reported) return {Verdict::failed, "a long step is not reported"};
  return {Verdict::passed, "50 ms at most"};
}

constexpr Case kInputCases[] = {
    {"nan_pose", "NaN in each coordinate", "no force, state unchanged to the bit", "bytes",
     Verdict::failed, nan_pose},
    {"nan_velocity", "one NaN height in a stroke", "the direction of motion is kept", "bytes",
     Verdict::failed, nan_velocity},
    {"first_pose_nan", "the first height is NaN", "clay conserved", "exact rationals",
     Verdict::failed, first_pose_nan},
    {"infinite_pose", "+-inf in each coordinate", "no force, state unchanged to the bit", "bytes",
     Verdict::failed, infinite_pose},
    {"pose_1e300", "+-1e300 mm in each coordinate", "no force, state unchanged to the bit", "bytes",
     Verdict::failed, pose_1e300},
    {"minus_zero", "height swaps between 0 and -0", "no motion", "bytes", Verdict::passed,
     minus_zero},
    {"denormal_pose", "1e-100 mm to the smallest denormal off the axis", "finite, clay conserved",
     "invariants, exact rationals", Verdict::failed, denormal_pose},
    {"time_stands_still", "dt = 0", "refused, state unchanged to the bit", "bytes",
     Verdict::not_in_print, time_stands_still},
    {"time_runs_back", "dt < 0", "refused, state unchanged to the bit", "bytes",
     Verdict::not_in_print, time_runs_back},
    {"time_leaps", "from the smallest int64 to the largest", "no overflow, clay conserved",
     "exact rationals, UBSan", Verdict::not_in_print, time_leaps},
    {"long_pause", "dt of 50 ms, a little more, 146 000 years", "the same clay, and reported",
     "bytes", Verdict::not_in_print, long_pause},
};

}  // namespace

std::span<const Case> input_cases() { return kInputCases; }

}  // namespace clay::extreme
