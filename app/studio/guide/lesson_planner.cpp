#include "app/studio/guide/lesson_planner.hpp"

#include "core/worker.hpp"

#include <utility>

namespace clay::studio {

struct LessonPlanner::State {
  explicit State(bool background)
      : worker([](const LessonQuestion& question, const auto&) { return plan_step(question); },
               background) {}
  NewestWorker<LessonQuestion, LessonPlan> worker;
};

LessonPlanner::LessonPlanner(bool background) : state_(std::make_unique<State>(background)) {}
LessonPlanner::~LessonPlanner() = default;

void LessonPlanner::ask(LessonQuestion question) {
  (void)state_->worker.take();
  state_->worker.ask(std::move(question));
}
std::optional<LessonPlan> LessonPlanner::take() { return state_->worker.take(); }
bool LessonPlanner::busy() const { return state_->worker.busy(); }

}  // namespace clay::studio
