#pragma once
// Plans the steps of a lesson in the background: on a thread, or in the worker of a web page.

#include "app/studio/guide/lesson.hpp"

#include <memory>
#include <optional>

namespace clay::studio {

/// Answers the newest question only, see NewestWorker.
class LessonPlanner {
 public:
  /// Without `background`, the question is answered during the call that asks it.
  explicit LessonPlanner(bool background);
  ~LessonPlanner();
  LessonPlanner(const LessonPlanner&) = delete;
  LessonPlanner& operator=(const LessonPlanner&) = delete;

  /// Drops an answer that has not been taken.
  void ask(LessonQuestion question);
  /// The newest answer; each is returned once.
  [[nodiscard]] std::optional<LessonPlan> take();
  /// True while a question waits or is worked on, or its answer has not been taken.
  [[nodiscard]] bool busy() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clay::studio
