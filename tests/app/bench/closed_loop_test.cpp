#include "app/bench/closed_loop/closed_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

namespace clay::closed_loop {
namespace {

using falcon::SampledLoop;

Outcome at_wall(const SampledLoop& loop, double stiffness, double step_mm, bool controlled) {
  Experiment e = wall_experiment(loop, stiffness, step_mm);
  e.controlled = controlled;
  const auto wall = make_wall({stiffness, 5.0, true});
  return run(e, *wall);
}

Outcome at_clay(const SampledLoop& loop, const PressedClay& spec, bool controlled) {
  Experiment e = clay_experiment(loop, kFalconStepMm);
  e.controlled = controlled;
  const auto clay = make_clay(spec);
  return run(e, *clay);
}

Outcome resting(const SampledLoop& loop, double stiffness) {
  const auto wall = make_wall({stiffness, 5.0, true});
  return run(energy_experiment(loop, stiffness), *wall);
}

TEST(Border, StabilityBorderIsWhereAFreeSwingGrows) {
  for (const double rate : {100.0, 1000.0, 8000.0})
    for (const double damping : {0.001, 0.01})
      for (const int delay : {0, 1, 3}) {
        const SampledLoop loop{rate, 0.1, damping, delay};
        const double predicted = stable_stiffness(loop);
        EXPECT_NEAR(measured_stable_stiffness(loop, 1e-3), predicted, 2e-3 * predicted)
            << rate << " " << damping << " " << delay;
      }
}

TEST(Border, PassivityBorderIsReachedByForcedSwingsUpToNyquist) {
  for (const int delay : {0, 1, 2}) {
    const SampledLoop loop{1000, 0.1, 0.002, delay};
    const falcon::VirtualWall wall{1.0, 0.0007};
    double most = 0.0;
    for (int waves = 1; waves <= 100; ++waves) {
      const double angle = 2.0 * std::numbers::pi * waves / 200.0;
      const double needed = measured_passive_damping(loop, wall, waves, 200);
      EXPECT_NEAR(needed, passive_damping_at(loop, wall, angle), 1e-12) << delay << " " << waves;
      most = std::max(most, needed);
    }
    EXPECT_NEAR(most, passive_damping(loop, wall), 0.01 * most) << delay;
  }
}

/// With exact encoders the tolerance is that of rounding alone.
TEST(Energy, IsInjectedOnlyAboveTheBorder) {
  for (const double rate : {100.0, 1000.0, 4000.0})
    for (const double damping : {0.002, 0.01})
      for (const int delay : {0, 1}) {
        const SampledLoop loop{rate, 0.1, damping, delay};
        const double border = stable_stiffness(loop);
        for (const double part : {0.1, 0.5, 0.9, 0.98}) {
          const Outcome o = resting(loop, part * border);
          const std::string cell = std::to_string(rate) + " " + std::to_string(damping) + " " +
                                   std::to_string(delay) + " " + std::to_string(part);
          EXPECT_LE(o.mean_cycle_mj, 0.0) << cell;
          // Between the two borders a cycle of a few samples may end slightly above the last.
          if (part * border < passive_stiffness(loop)) {
            EXPECT_LE(o.worst_cycle_mj, 0.0) << cell;
          }
        }
        EXPECT_GT(resting(loop, 1.1 * border).mean_cycle_mj, 0.0) << rate << damping << delay;
      }
}

TEST(Controller, PreventsLimitCyclesEverywhere) {
  int buzzing = 0;
  for (const double rate : {100.0, 1000.0, 4000.0})
    for (const double mass : {0.1, 0.25, 0.5})
      for (const double damping : {0.001, 0.005})
        for (const double stiffness : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
          const SampledLoop loop{rate, mass, damping, 1};
          buzzing += at_wall(loop, stiffness, kFalconStepMm, false).swing_mm > kMostSwingMm;
          EXPECT_LT(at_wall(loop, stiffness, kFalconStepMm, true).swing_mm, kMostSwingMm)
              << rate << " " << mass << " " << damping << " " << stiffness;
        }
  EXPECT_GT(buzzing, 50);  // of 90: without the controller the map shows instability
}

TEST(Controller, PassesAnAcceptedWallUnchanged) {
  for (const double damping : {0.001, 0.002, 0.005}) {
    const SampledLoop loop{1000, 0.1, damping, 1};
    const double stiffness = 0.99 * accepted_stiffness(loop);
    const Outcome alone = at_wall(loop, stiffness, kFalconStepMm, false);
    const Outcome guarded = at_wall(loop, stiffness, kFalconStepMm, true);
    EXPECT_EQ(guarded.state, falcon::PassivityState::watching);
    EXPECT_EQ(guarded.injected_mj, alone.injected_mj);
    EXPECT_EQ(guarded.final_force_n, alone.final_force_n);
  }
}

/// A wall that is evaluated less often than the force, as when the clay runs slower.
class StaleWall final : public Surface {
 public:
  StaleWall(double stiffness, int every)
      : wall_(make_wall({stiffness, 5.0, true})), every_(every) {}
  glm::dvec3 press(std::int64_t time_us, const glm::dvec3& reading_mm) override {
    if (ticks_++ % every_ == 0) force_ = wall_->press(time_us, reading_mm);
    return force_;
  }
  [[nodiscard]] double stored_mj(const glm::dvec3& at) const override {
    return wall_->stored_mj(at);
  }
  [[nodiscard]] double stiffness_n_per_mm() const override { return wall_->stiffness_n_per_mm(); }
  [[nodiscard]] double face_mm() const override { return 0.0; }

 private:
  std::unique_ptr<Surface> wall_;
  int every_, ticks_ = 0;
  glm::dvec3 force_{0.0};
};

/// The bounds do not include this delay, but the controller counts the work of each tick.
TEST(Controller, StabilizesAContactWithMoreDelayThanStated) {
  const SampledLoop loop{1000, 0.1, 0.002, 1};
  const double stiffness = 0.95 * accepted_stiffness(loop);
  Experiment e = wall_experiment(loop, stiffness, kFalconStepMm);
  e.seconds = 20.0;
  StaleWall bare(stiffness, 16), wall(stiffness, 16);
  EXPECT_GT(run(e, bare).swing_mm, 10 * kMostSwingMm);
  e.controlled = true;
  EXPECT_LT(run(e, wall).swing_mm, kMostSwingMm);
}

TEST(Clay, WithoutRemovalEqualsTheElasticWall) {
  const SampledLoop loop{1000, 0.1, 0.002, 1};
  EXPECT_LT(at_clay(loop, {0.7 * stable_stiffness(loop), 0.0, 20.0}, false).swing_mm, kMostSwingMm);
  EXPECT_GT(at_clay(loop, {1.5 * stable_stiffness(loop), 0.0, 20.0}, false).swing_mm, kMostSwingMm);
}

TEST(Clay, FlowingClayIsStableFarBeyondTheElasticBorder) {
  const SampledLoop loop{1000, 0.1, 0.002, 1};
  const Outcome o = at_clay(loop, {10.0 * stable_stiffness(loop), 20.0, 20.0}, false);
  EXPECT_LT(o.swing_mm, kMostSwingMm);
  EXPECT_LE(o.injected_mj, o.tolerance_mj);
}

TEST(Clay, IsMadePassiveAtAnyStiffness) {
  for (const double rate : {100.0, 1000.0, 4000.0})
    for (const double removal : {0.0, 1.0, 20.0})
      for (const double stiffness : {0.1, 10.0, 1000.0}) {
        const SampledLoop loop{rate, 0.1, 0.002, 1};
        EXPECT_LT(at_clay(loop, {stiffness, removal, 20.0}, true).swing_mm, kMostSwingMm)
            << rate << " " << removal << " " << stiffness;
      }
}

/// A wall that bends away under the tool is softer than clay that is pushed aside.
TEST(Clay, WithRulesIsMadePassiveAtAnyStiffness) {
  int moved = 0;
  for (const double wall_mm : {0.0, 8.0})
    for (const double rate : {100.0, 1000.0, 4000.0})
      for (const double stiffness : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
        const SampledLoop loop{rate, 0.1, 0.002, 1};
        Experiment e = clay_experiment(loop, kFalconStepMm);
        e.controlled = true;
        const auto clay = make_clay({stiffness, 20.0, 20.0, wall_mm, true});
        EXPECT_LT(run(e, *clay).swing_mm, kMostSwingMm)
            << wall_mm << " mm, " << rate << " Hz, " << stiffness << " N/mm";
        moved += clay->face_mm() < -1.0;
      }
  EXPECT_GT(moved, 15);  // of 30: the hand of 0.2 N/mm went into the clay
}

/// The change of clay adds no energy to the hand: below the accepted stiffness the bare loop takes
/// energy, with the rules as without.
TEST(Clay, WithRulesInjectsNoEnergyBelowTheAcceptedStiffness) {
  for (const double wall_mm : {0.0, 8.0})
    for (const double rate : {100.0, 1000.0, 4000.0})
      for (const double part : {0.1, 0.5, 0.99}) {
        const SampledLoop loop{rate, 0.1, 0.002, 1};
        Experiment e = clay_experiment(loop, kFalconStepMm);
        const auto clay = make_clay({part * accepted_stiffness(loop), 20.0, 20.0, wall_mm, true});
        const Outcome o = run(e, *clay);
        SCOPED_TRACE(std::to_string(wall_mm) + " " + std::to_string(rate) + " " +
                     std::to_string(part));
        EXPECT_LT(o.swing_mm, kMostSwingMm);
        EXPECT_LE(o.injected_mj, o.tolerance_mj);
      }
}

}  // namespace
}  // namespace clay::closed_loop
