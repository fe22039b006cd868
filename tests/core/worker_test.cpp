#include "core/worker.hpp"

#include "tests/support/wait_until.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>
#include <vector>

namespace clay::studio {
namespace {

void wait_for(std::binary_semaphore& started) {
  test::wait_until([&] { return started.try_acquire(); }, test::kDeadline, "the work to start");
}

TEST(NewestWorker, DropsReplacedQuestions) {
  std::binary_semaphore started(0), resume(0);
  std::vector<int> worked;
  NewestWorker<int, int> worker(
      [&](const int& question, const auto&) {
        worked.push_back(question);
        if (question == 1) {
          started.release();
          resume.acquire();
        }
        return 10 * question;
      },
      true);
  worker.ask(1);
  wait_for(started);  // works on the first question while the others arrive
  for (int question = 2; question <= 5; ++question) worker.ask(question);
  EXPECT_TRUE(worker.busy());
  resume.release();
  std::optional<int> newest;
  const auto answered = [&] {
    if (const auto answer = worker.take()) newest = answer;
    return newest == 50;
  };
  test::wait_until(answered, test::kDeadline, "the answer to the newest question");
  EXPECT_FALSE(worker.busy());
  EXPECT_FALSE(worker.take()) << "an answer was returned twice";
  EXPECT_EQ(worked, (std::vector<int>{1, 5}));
}

TEST(NewestWorker, AnswersImmediatelyWithoutAThread) {
  NewestWorker<int, int> worker([](const int& question, const auto&) { return question + 1; },
                                false);
  worker.ask(1);
  worker.ask(2);
  EXPECT_EQ(worker.take(), 3);
  EXPECT_FALSE(worker.busy());
}

/// The work of these questions ends only when cancelled.
TEST(NewestWorker, CancelsForANewerQuestionAndOnDestruction) {
  std::atomic<int> worked{0};
  {
    std::binary_semaphore started(0);
    NewestWorker<int, int> worker(
        [&](const int& question, const auto& given_up) {
          ++worked;
          if (question == 2) return question;
          started.release();
          while (!given_up()) std::this_thread::yield();
          return question;
        },
        true);
    worker.ask(1);
    wait_for(started);
    worker.ask(2);
    std::optional<int> answer;
    const auto answered = [&] { return (answer = worker.take()).has_value(); };
    test::wait_until(answered, test::kDeadline, "the answer to the newer question");
    EXPECT_EQ(*answer, 2) << "the first question has no answer";
    worker.ask(3);
    wait_for(started);
  }
  EXPECT_EQ(worked, 3);
}

TEST(NewestWorker, DropsTheWaitingQuestionOnDestruction) {
  std::atomic<int> worked{0};
  {
    std::binary_semaphore started(0);
    NewestWorker<int, int> worker(
        [&](const int&, const auto& given_up) {
          ++worked;
          started.release();
          while (!given_up()) std::this_thread::yield();
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          return 0;
        },
        true);
    worker.ask(1);
    wait_for(started);
    worker.ask(2);
  }
  EXPECT_LE(worked, 2);
}

TEST(PeriodicWorker, WorksAtOnceOnRequestAndOnClose) {
  std::atomic<int> calls{0}, last_calls{0};
  PeriodicWorker worker(
      [&](bool last) {
        ++calls;
        last_calls += last ? 1 : 0;
      },
      std::chrono::hours(1));
  test::wait_until([&] { return calls == 1; }, test::kDeadline, "the first call");
  worker.wake();
  test::wait_until([&] { return calls == 2; }, test::kDeadline, "the call on request");
  worker.close();
  worker.close();
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(last_calls, 1);
}

TEST(PeriodicWorker, WorksOncePerPeriod) {
  std::atomic<int> calls{0};
  PeriodicWorker worker([&](bool) { ++calls; }, std::chrono::milliseconds(1));
  test::wait_until([&] { return calls >= 5; }, test::kDeadline, "five calls");
}

/// A request during the work must not be lost.
TEST(PeriodicWorker, WorksAgainForARequestDuringTheWork) {
  std::atomic<int> calls{0};
  PeriodicWorker* self = nullptr;
  std::binary_semaphore ready(0);
  PeriodicWorker worker(
      [&](bool) {
        if (++calls > 1) return;
        ready.acquire();
        self->wake();
      },
      std::chrono::hours(1));
  self = &worker;
  ready.release();
  test::wait_until([&] { return calls == 2; }, test::kDeadline, "the second call");
}

}  // namespace
}  // namespace clay::studio
