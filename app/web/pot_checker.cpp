// Replaces the checker of app/studio/readings in a page: it asks the worker.

#include "app/studio/readings/pot_checker.hpp"

#include "app/web/job_message.hpp"
#include "app/web/page_worker.hpp"

#include <utility>

namespace clay::studio {

struct PotChecker::State {
  web::PageWorker worker{web::PageWorker::Slot::check};
  std::optional<PotQuestion> next;

  void post_next() {
    if (worker.busy() || !next) return;
    worker.post(web::message_of(*std::exchange(next, std::nullopt)));
  }
};

PotChecker::PotChecker(bool) : state_(std::make_unique<State>()) {}
PotChecker::~PotChecker() = default;

void PotChecker::ask(PotQuestion question) {
  state_->next = std::move(question);
  state_->post_next();
}

std::optional<PotCheck> PotChecker::take() {
  const auto message = state_->worker.take();
  if (!message) return std::nullopt;
  const bool outdated = state_->next.has_value();
  state_->post_next();
  if (outdated) return std::nullopt;
  if (!message->empty())
    if (auto check = web::check_in(*message)) return check;
  PotCheck failed;
  failed.why_not = "The check stopped: the browser may have too little memory";
  return failed;
}

bool PotChecker::busy() const { return state_->worker.busy() || state_->next; }

}  // namespace clay::studio
