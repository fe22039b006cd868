#include "app/studio/exporter.hpp"

#include "app/cli/memory_room.hpp"
#include "app/cli/packed_pot.hpp"
#include "app/cli/pot_copy.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

namespace clay::studio {
std::vector<std::string> paths_of(const ExportChoices& choices) {
  std::vector<std::string> paths;
  const auto add = [&](std::string_view ending) {
    const std::filesystem::path name = choices.name + std::string(ending);
    paths.push_back((std::filesystem::path(choices.folder) / name).string());
  };
  for (const solid::MeshFormat format : choices.meshes) add(solid::facts_of(format).ending);
  if (choices.section) add(".svg");
  if (choices.pot) add(".pot.json");
  return paths;
}

Result<solid::ExportRequest> request_of(const ExportChoices& choices, const Pot& pot) {
  solid::ExportRequest request;
  for (const std::string& path : paths_of(choices)) {
    if (const auto encoding = cli::pot_encoding_of(path)) {
      if (auto room = cli::expect_room_to_write(pot.stack.size(), *encoding, path); !room)
        return tl::make_unexpected(room.error());
      request.files.push_back(
          {.path = path, .kind = solid::FileKind::given, .bytes = write_pot(pot, *encoding)});
      continue;
    }
    auto file = solid::file_request(path);
    if (!file) return tl::make_unexpected(file.error());
    request.files.push_back(std::move(*file));
  }
  solid::ExportOptions& options = request.options;
  options.tolerance_mm = choices.tolerance_mm;
  options.smoothing = choices.smoothing;
  options.name = options.source = choices.name;
  const bool mesh = !choices.meshes.empty();
  if (mesh || choices.section) options.shrinkage = 0.01 * choices.shrinkage_percent;
  if (!mesh) return request;
  if (choices.min_wall_mm > 0.0) options.walls.min_wall_mm = choices.min_wall_mm;
  if (choices.process.empty()) return request;
  return solid::read_process(choices.process).map([&](solid::ProcessLimits process) {
    options.walls.process = std::move(process);
    return std::move(request);
  });
}

std::vector<std::string> standing_files(const ExportChoices& choices) {
  std::vector<std::string> paths = paths_of(choices);
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

void Exporter::preview(history::SharedPot pot, const ExportChoices& choices) {
  put({Kind::preview, std::move(pot), choices, {}});
}

void Exporter::write(history::SharedPot pot, const ExportChoices& choices) {
  put({Kind::files, std::move(pot), choices, {}});
}

/// A preview does not cancel a job that writes files.
void Exporter::put(Job job) {
  {
    const std::lock_guard lock(mutex_);
    const bool writes = running_ == Kind::files || (next_ && next_->kind == Kind::files);
    if (job.kind == Kind::preview && writes) return;
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
    // A cancelled preview has no result to report.
    if (job.kind == Kind::files || !outcome.cancelled) outcome_ = std::move(outcome);
    if (!next_) idle_.notify_all();
  }
}

Exporter::Outcome Exporter::done(const Job& job) {
  const auto show = [this](std::string_view stage) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
  };
  if (pictured_ != job.pot) thumbnail_.reset();
  pictured_ = job.pot;
  auto result = request_of(job.choices, *job.pot).and_then([&](solid::ExportRequest request) {
    request.options.cancelled = [token = job.stop.get_token()] { return token.stop_requested(); };
    request.options.expect_memory = [](std::uint64_t bytes) {
      return cli::expect_room("writing meshes", bytes);
    };
    cli::pack_pot(*job.pot, request, thumbnail_);
    return job.kind == Kind::files ? solid::export_files(*job.pot, request, show)
                                   : solid::preview_export(*job.pot, request, show);
  });
  const bool cancelled = !result && job.stop.stop_requested();
  return {job.kind, job.pot, job.choices, std::move(result), cancelled, paths_of(job.choices)};
}

}  // namespace clay::studio
