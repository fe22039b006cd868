#include "studio/readings/newest_worker.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <semaphore>
#include <vector>

namespace clay::studio {
namespace {

TEST(NewestWorker, DropsQuestionsThatANewerOneReplaced) {
  std::binary_semaphore begun(0), go(0);
  std::vector<int> worked;
  NewestWorker<int, int> worker(
      [&](const int& question) {
        worked.push_back(question);
        if (question == 1) {
          begun.release();
          go.acquire();
        }
        return 10 * question;
      },
      true);
  worker.ask(1);
  begun.acquire();  // it works on the first; the others come meanwhile
  for (int question = 2; question <= 5; ++question) worker.ask(question);
  EXPECT_TRUE(worker.busy());
  EXPECT_EQ(worker.dropped(), 3u);
  go.release();
  std::optional<int> newest;
  while (!newest || *newest != 50)
    if (const auto answer = worker.take()) newest = answer;
  EXPECT_FALSE(worker.busy());
  EXPECT_FALSE(worker.take()) << "each answer once";
  EXPECT_EQ(worked, (std::vector<int>{1, 5}));
}

TEST(NewestWorker, WithoutAThreadTheAnswerIsThere) {
  NewestWorker<int, int> worker([](const int& question) { return question + 1; }, false);
  worker.ask(1);
  worker.ask(2);
  EXPECT_EQ(worker.take(), 3);
  EXPECT_FALSE(worker.busy());
}

TEST(NewestWorker, EndsWithoutWorkingOnWhatWaits) {
  std::atomic<int> worked{0};
  {
    std::binary_semaphore begun(0);
    NewestWorker<int, int> worker(
        [&](const int&) {
          ++worked;
          begun.release();
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          return 0;
        },
        true);
    worker.ask(1);
    begun.acquire();
    worker.ask(2);
  }
  EXPECT_EQ(worked, 1);
}

}  // namespace
}  // namespace clay::studio
