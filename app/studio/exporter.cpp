#include "app/studio/exporter.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace clay::studio {
namespace {

struct Ending {
  bool ExportWish::*wanted;
  const char* text;
};
constexpr std::array kEndings = {Ending{&ExportWish::stl, ".stl"}, Ending{&ExportWish::obj, ".obj"},
                                 Ending{&ExportWish::drc, ".drc"},
                                 Ending{&ExportWish::section, ".svg"},
                                 Ending{&ExportWish::pot, ".pot.json"}};

}  // namespace

cli::ExportCommand command_of(const ExportWish& wish) {
  cli::ExportCommand command;
  command.pot = wish.name;
  for (const auto& [wanted, ending] : kEndings)
    if (wish.*wanted)
      command.outputs.push_back(
          (std::filesystem::path(wish.folder) / (wish.name + ending)).string());
  command.options.tolerance_mm = wish.tolerance_mm;
  command.options.smoothing = cli::smoothing_of(wish.smooth);
  command.options.name = wish.name;
  const bool mesh = wish.stl || wish.obj || wish.drc;
  if (mesh || wish.section) command.options.shrinkage = 0.01 * wish.shrinkage_percent;
  if (mesh)
    command.walls.ask(wish.min_wall_mm > 0.0 ? std::optional(wish.min_wall_mm) : std::nullopt,
                      wish.process);
  return command;
}

std::vector<std::string> standing_files(const ExportWish& wish) {
  std::vector<std::string> paths = command_of(wish).outputs;
  std::erase_if(paths, [](const std::string& path) {
    std::error_code ignored;
    return !std::filesystem::exists(path, ignored);
  });
  return paths;
}

Exporter::Exporter() : thread_([this] { run(); }) {}

Exporter::~Exporter() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    next_.reset();
    stop_.request_stop();
  }
  wake_.notify_one();
  thread_.join();
}

void Exporter::rehearse(history::SharedPot pot, const ExportWish& wish) {
  put({Kind::rehearsal, std::move(pot), wish, {}});
}

void Exporter::write(history::SharedPot pot, const ExportWish& wish) {
  put({Kind::files, std::move(pot), wish, {}});
}

/// A job that writes is never given up for a rehearsal.
void Exporter::put(Job job) {
  {
    const std::lock_guard lock(mutex_);
    const bool writes = running_ == Kind::files || (next_ && next_->kind == Kind::files);
    if (job.kind == Kind::rehearsal && writes) return;
    stop_.request_stop();
    outcome_.reset();
    next_ = std::move(job);
  }
  wake_.notify_one();
}

void Exporter::cancel() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  stop_.request_stop();
}

bool Exporter::busy() const {
  const std::lock_guard lock(mutex_);
  return running_ || next_;
}

std::string Exporter::stage() const {
  const std::lock_guard lock(mutex_);
  return stage_;
}

std::optional<Exporter::Kind> Exporter::running() const {
  const std::lock_guard lock(mutex_);
  return running_ ? running_ : next_ ? std::optional(next_->kind) : std::nullopt;
}

std::optional<Exporter::Outcome> Exporter::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

void Exporter::wait() {
  std::unique_lock lock(mutex_);
  idle_.wait(lock, [this] { return !running_ && !next_; });
}

void Exporter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return closing_ || next_; });
    if (closing_) return;
    const Job job = *std::exchange(next_, std::nullopt);
    running_ = job.kind;
    stop_ = job.stop;
    lock.unlock();
    Outcome outcome = done(job);
    lock.lock();
    running_.reset();
    stop_ = std::stop_source(std::nostopstate);
    stage_.clear();
    // A rehearsal that was given up has nothing to tell.
    if (job.kind == Kind::files || !outcome.cancelled) outcome_ = std::move(outcome);
    if (!next_) idle_.notify_all();
  }
}

Exporter::Outcome Exporter::done(const Job& job) {
  cli::ExportCommand command = command_of(job.wish);
  command.options.cancelled = [token = job.stop.get_token()] { return token.stop_requested(); };
  const auto tell = [this](std::string_view stage) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
  };
  auto result = job.kind == Kind::files ? cli::export_files(*job.pot, command, tell)
                                        : cli::rehearse_export(*job.pot, command, tell);
  const bool cancelled = !result && job.stop.stop_requested();
  return {job.kind, job.pot, job.wish, std::move(result), cancelled, std::move(command.outputs)};
}

}  // namespace clay::studio
