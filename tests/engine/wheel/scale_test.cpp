// The work of a tick for any number of rings, counted in pages of memory instead of time.

#include "app/bench/extreme/page_watch.hpp"
#include "claystack/engine/wheel.hpp"
#include "tests/support/heap_arena.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace clay {
namespace {

constexpr std::size_t kMillion = 1'000'000;

SceneSpec scene_of(std::size_t rings, Model model = Model::conserving) {
  SceneSpec scene;
  scene.model = model;
  scene.lump.rings = rings;
  scene.lump.max_rings = std::min(rings + 200, kMaxRings);
  scene.lump.ring_height_mm = 0.05;  // with the most rings, the top is a valid position
  scene.lump.outer_radius_mm = 40.0;
  scene.lump.inner_radius_mm = 20.0;
  scene.tool.shape = SphereSpec{0.5};
  scene.flow = {0.3, 0.9, 0.27};
  scene.removal.paper_fraction = 1e-4;  // the tool stays in the clay
  scene.stability = StabilitySpec{1e6};
  return scene;
}

/// A wheel; counts accesses to all of its memory.
class Watched {
 public:
  explicit Watched(const SceneSpec& scene)
      : memory_(allocate_together([&] { wheel_ = Wheel::build(scene).value(); })) {}

  void step_to(double x_mm, double y_mm) {
    time_us_ += 1000;
    report_ = wheel_->step({time_us_, {x_mm, y_mm, 0.0}, false});
  }
  /// The number of pages that a tick at this position accesses.
  std::size_t pages(double x_mm, double y_mm) {
    time_us_ += 1000;
    return extreme::pages_opened(memory_, [&] {
      report_ = wheel_->step({time_us_, {x_mm, y_mm, 0.0}, false});
    });
  }
  [[nodiscard]] const StepReport& report() const { return report_; }
  [[nodiscard]] double height_mm() const { return wheel_->stack().height_mm(); }

 private:
  std::optional<Wheel> wheel_;
  std::span<const std::byte> memory_;
  std::int64_t time_us_ = 0;
  StepReport report_;
};

/// The largest number of pages that a jump from end to end accesses.
std::size_t pages_of_jump(Watched& watched) {
  std::size_t max_pages = 0;
  for (int k = 0; k < 6; ++k) {
    const double y = k % 2 == 0 ? 1.0 : watched.height_mm() - 1.0;
    const std::size_t pages = watched.pages(40.2 - 0.01 * k, y);
    EXPECT_TRUE(watched.report().flags & kContact);
    if (k > 0) max_pages = std::max(max_pages, pages);
  }
  return max_pages;
}

// 20 rings of contact and 19 on both sides of it are one or two pages. Their load takes one page of
// each of three levels at the new position and one or two pages at the old one.
constexpr std::size_t kPlacePages = 2 + 3 * 2;
// The wheel's state, the kernel, the contact and its removal.
constexpr std::size_t kOwnPages = 6;

class Rings : public testing::TestWithParam<std::size_t> {};
class Jump : public testing::TestWithParam<std::size_t> {};

TEST_P(Jump, AJumpInOnePartReadsTwoPlaces) {
  Watched watched(scene_of(GetParam(), Model::paper));
  EXPECT_LE(pages_of_jump(watched), 2 * kPlacePages + kOwnPages);
}

TEST_P(Jump, AJumpInPartsReadsTheirPlaces) {
  Watched watched(scene_of(GetParam()));
  EXPECT_LE(pages_of_jump(watched), 33 * kPlacePages + kOwnPages);
}

TEST_P(Rings, StrokeReadsOnlyNearbyRings) {
  Watched watched(scene_of(GetParam()));
  std::size_t max_pages = 0;
  watched.pages(40.2, 3.0);
  for (int k = 1; k <= 1000; ++k) {
    const std::size_t pages = watched.pages(40.2, 3.0 + 0.004 * k);
    EXPECT_TRUE(watched.report().flags & kContact);
    max_pages = std::max(max_pages, pages);
  }
  // The 500 rings since the last update of the sums and the position itself are 3 pages.
  EXPECT_LE(max_pages, 3 + kPlacePages + kOwnPages);
}

TEST(Scale, LongStrokeLeavesNoWorkForTheNextJump) {
  Watched watched(scene_of(kMillion, Model::paper));
  for (int k = 0; k < 4000; ++k) {
    watched.step_to(40.2, 1.0 + 0.25 * k);
    EXPECT_TRUE(watched.report().flags & kContact);
  }
  // 20000 rings are 78 pages.
  EXPECT_LE(watched.pages(40.2, watched.height_mm() - 1.0), 2 * kPlacePages + kOwnPages);
  EXPECT_TRUE(watched.report().flags & kContact);
}

/// No ring above the tool takes clay, so all clay goes to the top and loads every ring.
TEST_P(Rings, ClayAtTheTopIsFoundWithoutReadingTheRingsBetween) {
  SceneSpec scene = scene_of(GetParam());
  scene.flow.reach_mm = 0.0;
  Watched watched(scene);
  watched.pages(40.3, 2.0);
  std::size_t max_pages = 0;
  bool grew = false;
  for (int k = 1; k <= 300; ++k) {
    max_pages = std::max(max_pages, watched.pages(40.3 - 0.004 * k, 2.0));
    grew = grew || (watched.report().flags & kGrew) != 0;
  }
  EXPECT_TRUE(grew);
  EXPECT_LE(max_pages, 2 * kPlacePages + kOwnPages);
}

TEST_P(Rings, KernelReachEndsWithItsWeights) {
  SceneSpec scene = scene_of(GetParam());
  scene.flow = {0.1, 1e9, 0.27};
  Watched watched(scene);
  watched.pages(40.2, 3.0);
  EXPECT_LE(watched.pages(40.19, 3.0), kPlacePages + kOwnPages);
}

INSTANTIATE_TEST_SUITE_P(Scale, Jump, testing::Values(200, kMillion, kMaxRings));
INSTANTIATE_TEST_SUITE_P(Scale, Rings, testing::Values(200, kMillion));

}  // namespace
}  // namespace clay
