#include "core/spsc_queue.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <deque>
#include <thread>

namespace clay::falcon {
namespace {

RC_GTEST_PROP(SpscQueue, KeepsOrderAndRefusesWhenFull, ()) {
  SpscQueue<int, 4> queue;
  std::deque<int> model;
  int next = 0;
  for (const bool push : *rc::gen::container<std::vector<bool>>(rc::gen::arbitrary<bool>())) {
    if (push) {
      const bool pushed = queue.push(++next);
      RC_ASSERT(pushed == (model.size() < 4));
      if (pushed) model.push_back(next);
    } else {
      const auto command = queue.pop();
      RC_ASSERT(command.has_value() == !model.empty());
      if (!command) continue;
      RC_ASSERT(*command == model.front());
      model.pop_front();
    }
  }
}

TEST(SpscQueue, HoldsItsCapacity) {
  SpscQueue<int, 1> one;
  EXPECT_TRUE(one.push(1));
  EXPECT_FALSE(one.push(2));
  EXPECT_EQ(one.pop(), 1);
  EXPECT_FALSE(one.pop());
}

struct Command {
  std::array<std::uint32_t, 32> words{};
};

/// Number of words that differ from the pushed ones.
template <std::size_t Capacity>
std::uint32_t wrong_words(std::uint32_t commands) {
  SpscQueue<Command, Capacity> queue;
  std::thread pusher([&] {
    for (std::uint32_t n = 1; n <= commands; ++n) {
      Command command;
      command.words.fill(n);
      for (int attempts = 1; !queue.push(command); ++attempts)
        if (attempts % 1000 == 0) std::this_thread::yield();
    }
  });
  std::uint32_t wrong = 0;
  for (std::uint32_t n = 1; n <= commands; ++n) {
    auto command = queue.pop();
    for (int attempts = 1; !command; ++attempts, command = queue.pop())
      if (attempts % 1000 == 0) std::this_thread::yield();
    for (const std::uint32_t word : command->words)
      if (word != n) ++wrong;
  }
  pusher.join();
  return wrong + (queue.pop() ? 1 : 0);
}

// With the smallest capacity, each slot is reused as soon as it is free.
TEST(SpscQueue, KeepsEveryItemInOrderBetweenThreads) {
  EXPECT_EQ(wrong_words<1>(5'000), 0u);
  EXPECT_EQ(wrong_words<8>(20'000), 0u);
}

}  // namespace
}  // namespace clay::falcon
