#include "core/snapshot.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

namespace clay::falcon {
namespace {

TEST(Snapshot, ShowsTheInitialValueUntilThePublication) {
  Snapshot<int> by_default;
  EXPECT_FALSE(by_default.has_new());
  EXPECT_EQ(by_default.newest(), 0);
  Snapshot<int> initialised(7);
  initialised.draft() = 8;
  EXPECT_EQ(initialised.newest(), 7);
  initialised.publish();
  EXPECT_TRUE(initialised.has_new());
  EXPECT_EQ(initialised.newest(), 8);
  EXPECT_FALSE(initialised.has_new());
  EXPECT_EQ(initialised.newest(), 8);
}

// Random interleavings of the calls of both sides.
RC_GTEST_PROP(Snapshot, ReturnsTheLastPublishedInEveryOrderOfCalls, ()) {
  Snapshot<int> snapshot;
  int published = 0;
  const int* shown = &snapshot.newest();
  int kept = *shown;
  for (const int call : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 4))) {
    if (call == 0) snapshot.write(++published);
    if (call == 1) snapshot.draft() = -1;  // drafted, not published
    if (call == 2) RC_ASSERT(snapshot.has_new() == (kept != published));
    if (call == 3) {
      shown = &snapshot.newest();
      kept = *shown;
      RC_ASSERT(kept == published);
    }
    RC_ASSERT(*shown == kept);  // the value being read does not change
  }
}

/// Large enough that a torn value would show.
struct Wide {
  std::array<std::uint64_t, 64> words{};
  bool is_whole() const {
    for (const auto word : words)
      if (word != words[0]) return false;
    return true;
  }
};

TEST(Snapshot, IsNeverTornOrOutdated) {
  constexpr std::uint64_t kWrites = 20'000;
  Snapshot<Wide> snapshot;
  std::atomic<std::uint64_t> started{0}, done{0};
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= kWrites; ++n) {
      started.store(n);
      snapshot.draft().words.fill(n);
      snapshot.publish();
      done.store(n);
    }
  });
  std::uint64_t last = 0, torn = 0, backward = 0, old = 0, early = 0;
  while (last < kWrites) {
    const std::uint64_t done_before = done.load();
    const Wide& value = snapshot.newest();
    const std::uint64_t n = value.words[0];
    if (!value.is_whole()) ++torn;
    if (n < last) ++backward;
    if (n < done_before) ++old;
    if (n > started.load()) ++early;
    last = n;
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backward, 0u);
  EXPECT_EQ(old, 0u) << "a value published before the call was not seen";
  EXPECT_EQ(early, 0u);
}

}  // namespace
}  // namespace clay::falcon
