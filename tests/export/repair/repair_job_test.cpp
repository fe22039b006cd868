// Repair as a job: cancelling, lack of memory, progress.

#include "claystack/export/repair.hpp"

#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid {
namespace {

using shapes::ball;
using shapes::moved;
using shapes::together;

/// Three balls that cut each other, one with a hole.
TriangleMesh tangled_balls() {
  TriangleMesh mesh = ball(10.0);
  mesh.triangles.pop_back();
  for (const double k : {1.0, 2.0})
    mesh = together(mesh, moved(ball(10.0), {3.3 * k, 1.7 * k, 0.9 * k}));
  return mesh;
}

TEST(RepairJob, CancelsAtEveryCheck) {
  const TriangleMesh mesh = tangled_balls();
  std::atomic<std::size_t> asked{0};
  RepairOptions options;
  options.cancelled = [&] { return ++asked == 0; };
  const auto whole = repair_mesh(mesh, options);
  ASSERT_TRUE(whole) << whole.error().message;
  const std::size_t all = asked;
  ASSERT_GT(all, 20U);
  std::size_t stopped = 0;
  for (std::size_t until = 0; until <= all; until += 1 + until / 8) {
    asked = 0;
    options.cancelled = [&] { return ++asked > until; };
    const auto result = repair_mesh(mesh, options);
    if (result) {
      // The number of calls differs between runs, because threads make them.
      EXPECT_GT(until, all / 2);
      EXPECT_EQ(result->mesh, whole->mesh);
      continue;
    }
    ++stopped;
    EXPECT_EQ(result.error().kind, ErrorKind::io);
    EXPECT_EQ(result.error().message, "repair stopped: cancelled");
  }
  EXPECT_GT(stopped, 8U);
}

/// Not a fault of the mesh, and no reason for a wrap, which needs more.
TEST(RepairJob, NamesMissingMemory) {
  const TriangleMesh mesh = tangled_balls();
  std::atomic<std::size_t> asked{0};
  RepairOptions options;
  options.wrap_mm = 1.0;
  options.cancelled = [&] { return ++asked == 0; };
  ASSERT_TRUE(repair_mesh(mesh, options));
  const std::size_t all = asked;
  std::size_t stopped = 0;
  for (std::size_t until = 0; until < all; until += 1 + until / 4) {
    asked = 0;
    options.cancelled = [&]() -> bool {
      if (++asked > until) throw std::bad_alloc();
      return false;
    };
    const auto result = repair_mesh(mesh, options);
    if (result) continue;  // near the end: the number of calls differs
    ++stopped;
    EXPECT_EQ(result.error().kind, ErrorKind::io) << until << " of " << all;
    EXPECT_EQ(result.error().message, "repair stopped: not enough memory");
  }
  EXPECT_GT(stopped, 8U);
}

/// An exception in the middle of the work, as CGAL may throw one. It does not follow that the mesh
/// cannot be wrapped.
TEST(RepairJob, ReportsAFailureOfTheLibraryAsIoUnlessAWrapSucceeds) {
  const TriangleMesh mesh = tangled_balls();
  RepairOptions options;
  options.progress = [](std::string_view stage, double) {
    if (stage == "filling holes") throw std::runtime_error("odd");
  };
  const auto failed = repair_mesh(mesh, options);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, ErrorKind::io);
  EXPECT_EQ(failed.error().message, "repair failed: odd");
  options.wrap_mm = 1.0;
  const auto wrapped = repair_mesh(mesh, options);
  ASSERT_TRUE(wrapped) << wrapped.error().message;
  EXPECT_EQ(wrapped->wrapped_mm, 1.0);
}

TEST(RepairJob, ReportsStagesAndTheirShares) {
  std::vector<std::string> stages;
  std::vector<double> shares;  // of cutting
  double before = 0.0;
  RepairOptions options;
  options.progress = [&](std::string_view stage, double share) {
    if (stages.empty() || stages.back() != stage || share == 0.0) {
      stages.emplace_back(stage);
      before = 0.0;
    }
    EXPECT_GE(share, before) << stage;
    EXPECT_LE(share, 1.0) << stage;
    before = share;
    if (stage == "cutting triangles") shares.push_back(share);
  };
  ASSERT_TRUE(repair_mesh(tangled_balls(), options));
  std::size_t at = 0;
  for (const char* name :
       {"checking", "cleaning", "joining triangles", "filling holes", "turning shells", "checking",
        "finding intersections", "cutting triangles", "choosing the outer skin", "rounding",
        "checking", "measuring the change"}) {
    while (at < stages.size() && stages[at] != name) ++at;
    EXPECT_LT(at, stages.size()) << name;
  }
  EXPECT_GT(shares.size(), 20U);
}

}  // namespace
}  // namespace clay::solid
