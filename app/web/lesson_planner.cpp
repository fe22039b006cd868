// Replaces the planner of app/studio/guide in a page: it asks the worker. A plan throws a whole
// step, which would stop the picture for a time.

#include "app/studio/guide/lesson_planner.hpp"

#include "app/web/newest_question.hpp"

#include <utility>

namespace clay::studio {

struct LessonPlanner::State {
  web::NewestQuestion<LessonQuestion> questions{web::PageWorker::Slot::lesson};
};

LessonPlanner::LessonPlanner(bool) : state_(std::make_unique<State>()) {}
LessonPlanner::~LessonPlanner() = default;

void LessonPlanner::ask(LessonQuestion question) { state_->questions.ask(std::move(question)); }

std::optional<LessonPlan> LessonPlanner::take() {
  const auto answered = state_->questions.take();
  if (!answered) return std::nullopt;
  if (!answered->message.empty())
    if (auto plan = web::plan_in(answered->message)) return plan;
  LessonPlan failed;
  failed.node = answered->question.node;
  failed.step = answered->question.step;
  failed.problem = "The plan stopped: the browser may have too little memory, or lacks a file";
  return failed;
}

bool LessonPlanner::busy() const { return state_->questions.busy(); }

}  // namespace clay::studio
