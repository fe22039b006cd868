#include "app/studio/readings/pot_checker.hpp"

#include "core/worker.hpp"

#include <utility>

namespace clay::studio {

struct PotChecker::State {
  explicit State(bool background) : worker(&check_pot, background) {}
  NewestWorker<PotQuestion, PotCheck> worker;
};

PotChecker::PotChecker(bool background) : state_(std::make_unique<State>(background)) {}
PotChecker::~PotChecker() = default;

void PotChecker::ask(PotQuestion question) { state_->worker.ask(std::move(question)); }
std::optional<PotCheck> PotChecker::take() { return state_->worker.take(); }
bool PotChecker::busy() const { return state_->worker.busy(); }

}  // namespace clay::studio
