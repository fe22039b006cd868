#include "claystack/falcon/command_queue.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <deque>
#include <thread>

namespace clay::falcon {
namespace {

RC_GTEST_PROP(CommandQueue, IsAQueueThatRefusesWhenFull, ()) {
  CommandQueue<int, 4> queue;
  std::deque<int> model;
  int next = 0;
  for (const bool push : *rc::gen::container<std::vector<bool>>(rc::gen::arbitrary<bool>())) {
    if (push) {
      const bool taken = queue.push(++next);
      RC_ASSERT(taken == (model.size() < 4));
      if (taken) model.push_back(next);
    } else {
      const auto command = queue.pop();
      RC_ASSERT(command.has_value() == !model.empty());
      if (!command) continue;
      RC_ASSERT(*command == model.front());
      model.pop_front();
    }
  }
}

TEST(CommandQueue, HoldsAsManyAsItSays) {
  CommandQueue<int, 1> one;
  EXPECT_TRUE(one.push(1));
  EXPECT_FALSE(one.push(2));
  EXPECT_EQ(one.pop(), 1);
  EXPECT_FALSE(one.pop());
}

struct Command {
  std::array<std::uint32_t, 32> words{};
};

TEST(CommandQueue, LosesAndMixesNothingBetweenThreads) {
  constexpr std::uint32_t kCommands = 50'000;
  CommandQueue<Command, 8> queue;
  std::thread pusher([&] {
    for (std::uint32_t n = 1; n <= kCommands; ++n) {
      Command command;
      command.words.fill(n);
      while (!queue.push(command)) std::this_thread::yield();
    }
  });
  std::uint32_t wrong = 0;
  for (std::uint32_t n = 1; n <= kCommands; ++n) {
    auto command = queue.pop();
    while (!command) {
      std::this_thread::yield();
      command = queue.pop();
    }
    for (const std::uint32_t word : command->words)
      if (word != n) ++wrong;
  }
  pusher.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_FALSE(queue.pop());
}

}  // namespace
}  // namespace clay::falcon
