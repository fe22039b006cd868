// The pots of samples/paper do not depend on the ring height or on the pose rate.

#include "app/bench/convergence_experiments.hpp"
#include "app/strokes/strokes.hpp"
#include "tests/samples/sample_files.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::samples {
namespace {

using strokes::parse_strokes;
using strokes::play;

class ThrownPot : public testing::TestWithParam<const char*> {};

TEST_P(ThrownPot, IsIndependentOfRingHeightAndRate) {
  const std::string folder = CLAYSTACK_SAMPLES "/paper/", name = GetParam();
  const SceneSpec scene = parse_file(folder + name + ".scene.json", parse_scene);
  const auto poses = play(parse_file(folder + "strokes/" + name + ".strokes.json", parse_strokes),
                          scene, Wheel::build(scene).value())
                         .value()
                         .poses;
  const double percent = 100.0 / scene.lump.outer_radius_mm;

  const auto pot = bench::played(scene, poses);
  const auto fine = bench::played(bench::refined(scene, 10), poses);
  EXPECT_LT(percent * bench::profile_difference(pot.stack, fine.stack).rms_mm, 0.5);
  EXPECT_LT(bench::force_difference(pot, fine).rms_percent, 1.0);

  const auto often = bench::played(scene, bench::resampled(poses, 250));
  const auto off = bench::profile_difference(pot.stack, often.stack);
  EXPECT_LT(percent * off.rms_mm, 0.2);
  EXPECT_LT(percent * off.outline_mm, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Samples, ThrownPot, testing::Values("bowl", "vase", "bottle"),
                         [](const auto& pot) { return std::string(pot.param); });

}  // namespace
}  // namespace clay::samples
