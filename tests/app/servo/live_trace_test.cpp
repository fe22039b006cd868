// The record of each tick of the servo.

#include "tests/app/servo/live_bench.hpp"

#include <glm/geometric.hpp>
#include <thread>
#include <vector>

namespace clay::servo {
namespace {

TickSample at(std::int64_t time_ns) { return {.time_ns = time_ns, .clay_n = 1.0f}; }

TEST(TickTrace, CollectsNothingWhileOff) {
  TickTrace trace;
  trace.add(at(1));
  EXPECT_FALSE(trace.take());
  EXPECT_EQ(trace.dropped(), 0u);
}

TEST(TickTrace, DropsAndCountsSamplesThatDoNotFit) {
  TickTrace trace;
  trace.want(true);
  for (std::int64_t i = 0; i < std::int64_t{TickTrace::kRoom} + 3; ++i) trace.add(at(i));
  EXPECT_EQ(trace.dropped(), 3u);
  for (std::int64_t i = 0; i < std::int64_t{TickTrace::kRoom}; ++i) {
    const auto sample = trace.take();
    ASSERT_TRUE(sample);
    ASSERT_EQ(sample->time_ns, i) << "the oldest are kept, in order";
  }
  EXPECT_FALSE(trace.take());
  trace.add(at(7));
  EXPECT_EQ(trace.take().value().time_ns, 7);
}

TEST(TickTrace, PassesCompleteSamplesInOrder) {
  TickTrace trace;
  trace.want(true);
  constexpr std::int64_t kCount = 100'000;
  std::thread servo([&] {
    for (std::int64_t i = 1; i <= kCount; ++i)
      trace.add({i, static_cast<float>(i % 1000), static_cast<float>(i % 1000), 0.0f, 0.0f, false});
  });
  std::int64_t last = 0, taken = 0;
  while (taken + static_cast<std::int64_t>(trace.dropped()) < kCount) {
    const auto sample = trace.take();
    if (!sample) continue;
    ++taken;
    ASSERT_GT(sample->time_ns, last);
    ASSERT_EQ(sample->clay_n, static_cast<float>(sample->time_ns % 1000));
    ASSERT_EQ(sample->clay_n, sample->sent_n);
    last = sample->time_ns;
  }
  servo.join();
  EXPECT_FALSE(trace.take());
}

TEST(TickTrace, HasEveryTickOfTheServo) {
  VirtualThrow live(rib_scene(), one_to_one(), press_to(2.0));
  live.run(3.2);
  EXPECT_FALSE(live.trace.take()) << "off until requested";
  live.trace.want(true);
  std::int64_t last_ns = 0;
  for (int i = 0; i < 100; ++i) {
    live.tick();
    const auto sample = live.trace.take();
    ASSERT_TRUE(sample);
    EXPECT_FALSE(live.trace.take()) << "one sample per tick";
    EXPECT_GT(sample->time_ns, last_ns);
    EXPECT_EQ(sample->clay_n, static_cast<float>(glm::length(live.status().clay_n)));
    EXPECT_EQ(sample->sent_n, static_cast<float>(glm::length(live.status().force_n)));
    EXPECT_EQ(sample->late_us, 1e-3f * static_cast<float>(live.status().late_ns));
    EXPECT_GT(sample->clay_n, 0.0f);
    last_ns = sample->time_ns;
  }
}

}  // namespace
}  // namespace clay::servo
