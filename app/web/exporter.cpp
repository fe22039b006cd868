// Replaces app/studio/exporter.cpp in a page: the worker exports, and the page keeps the files
// until file_written offers them as downloads.

#include "app/studio/exporter.hpp"

#include "app/web/job_message.hpp"
#include "app/web/page_worker.hpp"

#include <emscripten.h>

#include <algorithm>
#include <utility>

namespace clay::studio {
namespace {

EM_JS(bool, page_has, (const char* path), { return Module["page"].has(UTF8ToString(path)); });

/// The page has the files, and `file_written` offers them.
Result<ExportFigures> result_in(const std::string& message, Exporter::Kind kind,
                                const std::vector<std::string>& paths) {
  std::optional<web::ExportAnswer> answer;
  if (!message.empty()) answer = web::export_in(message);
  const bool whole =
      kind == Exporter::Kind::preview ||
      std::ranges::all_of(paths, [](const auto& path) { return page_has(path.c_str()); });
  if (answer && (!*answer || whole)) return std::move(*answer);
  return failure(ErrorKind::io,
                 "The export stopped: the browser may have too little memory, or lacks a file");
}

}  // namespace

struct Exporter::State {
  struct Job {
    Kind kind;
    history::SharedPot pot;
    ExportChoices choices;
  };
  web::PageWorker worker{web::PageWorker::Slot::exporting};
  std::optional<Job> running, next;
  std::optional<Outcome> outcome;
  double posted_ms = 0.0;  ///< time of the page when `running` began

  [[nodiscard]] std::optional<Kind> at_work() const {
    const auto kind_of = [](const auto& job) {
      return job ? std::optional(job->kind) : std::nullopt;
    };
    return Exporter::at_work(kind_of(running), kind_of(next), kind_of(outcome));
  }
  /// A preview neither cancels a job that writes files nor drops its outcome. The next job cancels
  /// a preview that takes long, because a new worker starts in less time.
  void put(Job job) {
    constexpr double kLongMs = 500.0;
    if (job.kind == Kind::preview && at_work() == Kind::files) return;
    if (running && running->kind == Kind::preview && emscripten_get_now() - posted_ms > kLongMs) {
      worker.stop();
      running.reset();
    }
    outcome.reset();
    next = std::move(job);
    post_next();
  }
  void post_next() {
    if (running || !next) return;
    running = std::exchange(next, std::nullopt);
    posted_ms = emscripten_get_now();
    worker.post(web::message_of({running->kind, running->choices, *running->pot}));
  }
  void receive() {
    const auto message = worker.take();
    if (!message || !running) return;
    const Job job = *std::exchange(running, std::nullopt);
    const auto paths = paths_of(job.choices);
    if (job.kind == Kind::files || !next)
      outcome = Outcome{job.kind, job.pot, job.choices, result_in(*message, job.kind, paths),
                        false,    paths};
    post_next();
  }
};

Exporter::Exporter() : state_(std::make_unique<State>()) {}
Exporter::~Exporter() = default;

void Exporter::preview(history::SharedPot pot, const ExportChoices& choices) {
  state_->put({Kind::preview, std::move(pot), choices});
}

void Exporter::write(history::SharedPot pot, const ExportChoices& choices) {
  state_->put({Kind::files, std::move(pot), choices});
}

void Exporter::cancel() {
  if (state_->running) state_->worker.stop();
  for (auto* job : {&state_->running, &state_->next}) {
    const auto ended = std::exchange(*job, std::nullopt);
    if (ended && ended->kind == Kind::files)
      state_->outcome = Outcome::of_cancelled(ended->kind, ended->pot, ended->choices);
  }
}

bool Exporter::busy() const { return state_->running || state_->next; }

std::string Exporter::stage() const { return state_->worker.stage(); }

std::optional<Exporter::Kind> Exporter::running() const { return state_->at_work(); }

std::optional<Exporter::Outcome> Exporter::take() {
  state_->receive();
  return std::exchange(state_->outcome, std::nullopt);
}

void Exporter::wait() {}  // an answer comes between two frames only

}  // namespace clay::studio
