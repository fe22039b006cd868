// Replaces the checker of app/studio/readings in a page: it asks the worker.

#include "app/studio/readings/pot_checker.hpp"

#include "app/web/newest_question.hpp"

#include <utility>

namespace clay::studio {

struct PotChecker::State {
  web::NewestQuestion<PotQuestion> questions{web::PageWorker::Slot::check};
};

PotChecker::PotChecker(bool) : state_(std::make_unique<State>()) {}
PotChecker::~PotChecker() = default;

void PotChecker::ask(PotQuestion question) { state_->questions.ask(std::move(question)); }

std::optional<PotCheck> PotChecker::take() {
  const auto answered = state_->questions.take();
  if (!answered) return std::nullopt;
  if (!answered->message.empty())
    if (auto check = web::check_in(answered->message)) return check;
  PotCheck failed;
  failed.stopped = true;
  failed.why_not = "the browser may have too little memory, or lacks a file";
  return failed;
}

bool PotChecker::busy() const { return state_->questions.busy(); }

}  // namespace clay::studio
