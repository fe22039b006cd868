#pragma once
// Threads that work for another one: on its newest question, or periodically.

#include "core/threads.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace clay {

/// Works on the newest question only: a new question replaces a waiting one and cancels the current
/// work. For one thread, which asks the questions and reads the answers. Both are values; the lock
/// is internal.
template <class Question, class Answer>
class NewestWorker {
 public:
  using GivenUp =
      std::function<bool()>;  ///< callable from any thread; true: the answer is no longer needed
  using Work = std::function<Answer(const Question&, const GivenUp&)>;

  /// Without `thread`, the question is answered during the call that asks it.
  NewestWorker(Work work, bool thread) : work_(std::move(work)) {
    if (thread) thread_ = std::thread([this] { run(); });
  }
  /// Cancels the current work and waits for it to end.
  ~NewestWorker() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }
  NewestWorker(const NewestWorker&) = delete;
  NewestWorker& operator=(const NewestWorker&) = delete;

  void ask(Question question) {
    if (!thread_.joinable()) {
      answer_ = work_(question, [] { return false; });
      return;
    }
    {
      const std::lock_guard lock(mutex_);
      question_ = std::move(question);
    }
    wake_.notify_one();
  }
  /// The newest answer; each is returned once.
  [[nodiscard]] std::optional<Answer> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(answer_, std::nullopt);
  }
  /// True while a question waits or is worked on, or its answer has not been taken.
  [[nodiscard]] bool busy() const {
    const std::lock_guard lock(mutex_);
    return question_ || working_ || answer_;
  }

 private:
  void run() {
    const GivenUp given_up = [this] {
      const std::lock_guard lock(mutex_);
      return over_ || question_;
    };
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [&] { return over_ || question_; });
      if (over_) return;
      const Question question = *std::exchange(question_, std::nullopt);
      working_ = true;
      lock.unlock();
      Answer answer = work_(question, given_up);
      lock.lock();
      working_ = false;
      if (!question_) answer_ = std::move(answer);
    }
  }

  Work work_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Question> question_;
  std::optional<Answer> answer_;
  bool working_ = false, over_ = false;
  std::thread thread_;  // last: it uses all members above
};

/// Calls its work at once, then once per period and after each wake(). The work is never called by
/// two threads at a time. Where a program cannot start threads, run_all() calls the work instead.
class PeriodicWorker {
 public:
  /// `last`: the call that close() requests; it is the last one.
  using Work = std::function<void(bool last)>;

  PeriodicWorker(Work work, std::chrono::milliseconds period)
      : work_(std::move(work)), period_(period) {
    if constexpr (kThreads)
      thread_ = std::thread([this] { run(); });
    else
      without_thread().push_back(this);
  }
  ~PeriodicWorker() { close(); }
  PeriodicWorker(const PeriodicWorker&) = delete;
  PeriodicWorker& operator=(const PeriodicWorker&) = delete;

  /// Does not wait.
  void wake() {
    {
      const std::lock_guard lock(mutex_);
      woken_ = true;
    }
    wake_.notify_one();
  }
  /// Waits for the last call. For one thread.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
    if (!kThreads && std::erase(without_thread(), this) > 0) work_(true);
  }

  /// Without threads: calls the work of every worker that is due or woken.
  static void run_all() {
    const auto now = std::chrono::steady_clock::now();
    for (PeriodicWorker* worker : std::vector(without_thread())) {
      if (!std::exchange(worker->woken_, false) && now < worker->due_) continue;
      worker->due_ = now + worker->period_;
      worker->work_(false);
    }
  }

 private:
  static std::vector<PeriodicWorker*>& without_thread() {
    static std::vector<PeriodicWorker*> workers;
    return workers;
  }

  void run() {
    std::unique_lock lock(mutex_);
    for (bool last = false; !last;) {
      last = closing_;
      woken_ = false;
      lock.unlock();
      work_(last);
      lock.lock();
      wake_.wait_for(lock, period_, [this] { return woken_ || closing_; });
    }
  }

  Work work_;
  std::chrono::milliseconds period_;
  std::mutex mutex_;  // protects the members below
  std::condition_variable wake_;
  bool woken_ = false, closing_ = false;
  std::chrono::steady_clock::time_point due_;  // without threads: the next call
  std::thread thread_;                         // last: it uses all members above
};

}  // namespace clay
