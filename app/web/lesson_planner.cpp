// Replaces the planner of app/studio/guide in a page: it asks the worker. A plan throws a whole
// step and would hold the picture for a time.

#include "app/studio/guide/lesson_planner.hpp"

#include "app/web/job_message.hpp"
#include "app/web/page_worker.hpp"

#include <utility>

namespace clay::studio {

struct LessonPlanner::State {
  web::PageWorker worker{web::PageWorker::Slot::lesson};
  LessonQuestion running;
  std::optional<LessonQuestion> next;

  void post_next() {
    if (worker.busy() || !next) return;
    running = *std::exchange(next, std::nullopt);
    worker.post(web::message_of(running));
  }
};

LessonPlanner::LessonPlanner(bool) : state_(std::make_unique<State>()) {}
LessonPlanner::~LessonPlanner() = default;

void LessonPlanner::ask(LessonQuestion question) {
  state_->next = std::move(question);
  state_->post_next();
}

std::optional<LessonPlan> LessonPlanner::take() {
  const auto message = state_->worker.take();
  if (!message) return std::nullopt;
  const LessonQuestion answered = state_->running;
  const bool outdated = state_->next.has_value();
  state_->post_next();
  if (outdated) return std::nullopt;
  if (!message->empty())
    if (auto plan = web::plan_in(*message)) return plan;
  LessonPlan failed;
  failed.node = answered.node;
  failed.step = answered.step;
  failed.problem = "The plan stopped: the browser may have too little memory";
  return failed;
}

bool LessonPlanner::busy() const { return state_->worker.busy() || state_->next; }

}  // namespace clay::studio
