#pragma once
// Questions to a worker of the page. Only the newest one is answered, as by NewestWorker.

#include "app/web/job_message.hpp"
#include "app/web/page_worker.hpp"

#include <optional>
#include <string>
#include <utility>

namespace clay::web {

template <class Question>
class NewestQuestion {
 public:
  struct Answered {
    Question question;
    std::string message;  ///< empty: the worker failed
  };

  explicit NewestQuestion(PageWorker::Slot slot) : worker_(slot) {}

  void ask(Question question) {
    next_ = std::move(question);
    post_next();
  }
  /// Once, and only if no newer question waits.
  [[nodiscard]] std::optional<Answered> take() {
    auto message = worker_.take();
    if (!message) return std::nullopt;
    std::optional<Answered> answered;
    if (!next_) answered = Answered{*std::exchange(running_, std::nullopt), std::move(*message)};
    post_next();
    return answered;
  }
  [[nodiscard]] bool busy() const { return worker_.busy() || next_; }

 private:
  void post_next() {
    if (worker_.busy() || !next_) return;
    running_ = std::exchange(next_, std::nullopt);
    worker_.post(message_of(*running_));
  }

  PageWorker worker_;
  std::optional<Question> running_, next_;
};

}  // namespace clay::web
