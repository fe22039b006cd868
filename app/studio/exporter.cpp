#include "app/studio/exporter.hpp"

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <thread>
#include <utility>

namespace clay::studio {

struct Exporter::State {
  struct Job {
    Kind kind;
    history::SharedPot pot;
    ExportChoices choices;
    std::stop_source stop;
  };
  State() : thread([this] { run(); }) {}
  void put(Job job);
  [[nodiscard]] std::optional<Kind> at_work() const;
  void run();
  Outcome done(const Job& job);

  std::mutex mutex;  // protects the members below
  std::condition_variable wake, idle;
  std::optional<Job> next;
  std::optional<Kind> running;
  std::stop_source stop{std::nostopstate};  // stops the running job
  std::string stage;
  std::optional<Outcome> outcome;
  bool closing = false;
  // Used by the thread alone: the picture of a pot serves all its previews.
  history::SharedPot pictured;
  cli::Thumbnail thumbnail;
  std::thread thread;
};

Exporter::Exporter() : state_(std::make_unique<State>()) {}

Exporter::~Exporter() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->closing = true;
    state_->next.reset();
    state_->stop.request_stop();
  }
  state_->wake.notify_one();
  state_->thread.join();
}

void Exporter::preview(history::SharedPot pot, const ExportChoices& choices) {
  state_->put({Kind::preview, std::move(pot), choices, {}});
}

void Exporter::write(history::SharedPot pot, const ExportChoices& choices) {
  state_->put({Kind::files, std::move(pot), choices, {}});
}

std::optional<ExportKind> Exporter::State::at_work() const {
  const auto kind_of = [](const auto& job) {
    return job ? std::optional(job->kind) : std::nullopt;
  };
  return Exporter::at_work(running, kind_of(next), kind_of(outcome));
}

/// A preview neither cancels a job that writes files nor drops its outcome.
void Exporter::State::put(Job job) {
  {
    const std::lock_guard lock(mutex);
    if (job.kind == Kind::preview && at_work() == Kind::files) return;
    stop.request_stop();
    outcome.reset();
    next = std::move(job);
  }
  wake.notify_one();
}

void Exporter::cancel() {
  const std::lock_guard lock(state_->mutex);
  const auto waiting = std::exchange(state_->next, std::nullopt);
  if (waiting && waiting->kind == Kind::files)
    state_->outcome = Outcome::of_cancelled(waiting->kind, waiting->pot, waiting->choices);
  state_->stop.request_stop();
}

bool Exporter::busy() const {
  const std::lock_guard lock(state_->mutex);
  return state_->running || state_->next;
}

std::string Exporter::stage() const {
  const std::lock_guard lock(state_->mutex);
  return state_->stage;
}

std::optional<Exporter::Kind> Exporter::running() const {
  const std::lock_guard lock(state_->mutex);
  return state_->at_work();
}

std::optional<Exporter::Outcome> Exporter::take() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->outcome, std::nullopt);
}

void Exporter::wait() {
  std::unique_lock lock(state_->mutex);
  state_->idle.wait(lock, [this] { return !state_->running && !state_->next; });
}

void Exporter::State::run() {
  std::unique_lock lock(mutex);
  while (true) {
    wake.wait(lock, [this] { return closing || next; });
    if (closing) return;
    const Job job = *std::exchange(next, std::nullopt);
    running = job.kind;
    stop = job.stop;
    lock.unlock();
    Outcome result = done(job);
    lock.lock();
    running.reset();
    stop = std::stop_source(std::nostopstate);
    stage.clear();
    // A cancelled preview has no result to report.
    if (job.kind == Kind::files || !result.cancelled) outcome = std::move(result);
    if (!next) idle.notify_all();
  }
}

Exporter::Outcome Exporter::State::done(const Job& job) {
  const auto show = [this](std::string_view now) {
    const std::lock_guard lock(mutex);
    stage = now;
  };
  if (pictured != job.pot) thumbnail = {};
  pictured = job.pot;
  auto result = run_export(
      *job.pot, job.choices, job.kind, thumbnail,
      [token = job.stop.get_token()] { return token.stop_requested(); }, show);
  const bool cancelled = !result && job.stop.stop_requested();
  return {job.kind, job.pot, job.choices, std::move(result), cancelled, paths_of(job.choices)};
}

}  // namespace clay::studio
