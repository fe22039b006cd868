#include "live/recorder.hpp"

#include "claystack/engine/session_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

namespace clay::live {
namespace {

// A third of what may be lost, for a thread that has to wait for its turn.
constexpr auto kPause = std::chrono::milliseconds(30);

Error system_error(const std::string& path, const char* action) {
  return {ErrorKind::io,
          path + ": could not " + action + ": " + std::generic_category().message(errno)};
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path,
                                                   std::string_view scene_name,
                                                   std::uint64_t scene_hash) {
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) return tl::make_unexpected(system_error(path, "open"));
  std::unique_ptr<Recorder> recorder(new Recorder(path, descriptor));
  recorder->append(session_header(scene_name, scene_hash));
  if (recorder->failed_) return tl::make_unexpected(recorder->error_);
  recorder->thread_ = std::thread([&self = *recorder] { self.run(); });
  return recorder;
}

Recorder::Recorder(std::string path, int descriptor)
    : path_(std::move(path)), descriptor_(descriptor) {
  block_.reserve(kPosesPerBlock);
}

Recorder::~Recorder() {
  closing_.store(true);
  if (thread_.joinable()) thread_.join();
  if (descriptor_ >= 0) close(descriptor_);
}

bool Recorder::take(const Pose& pose) noexcept {
  const bool whole = lost_.load(std::memory_order_relaxed) == 0;
  if (whole && !failed_.load(std::memory_order_relaxed) && queue_.push(pose)) {
    taken_.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  lost_.fetch_add(1, std::memory_order_relaxed);
  return false;
}

Result<void> Recorder::finish() {
  closing_.store(true);
  if (thread_.joinable()) thread_.join();
  if (!failed_ && fsync(descriptor_) != 0 && errno != EINVAL) {
    failed_ = true;
    error_ = system_error(path_, "sync");
  }
  if (descriptor_ >= 0 && close(std::exchange(descriptor_, -1)) != 0 && !failed_) {
    failed_ = true;
    error_ = system_error(path_, "close");
  }
  if (failed_) return tl::make_unexpected(error_);
  return {};
}

void Recorder::run() {
  while (!closing_.load()) {
    write_waiting();
    std::this_thread::sleep_for(kPause);
  }
  write_waiting();
}

void Recorder::write_waiting() {
  for (;;) {
    while (block_.size() < kPosesPerBlock) {
      const auto pose = queue_.pop();
      if (!pose) break;
      block_.push_back(*pose);
    }
    if (block_.empty()) return;
    append(session_block(block_));
    block_.clear();
  }
}

void Recorder::append(std::string_view line) {
  while (!line.empty() && !failed_) {
    const auto written = write(descriptor_, line.data(), line.size());
    if (written > 0) {
      line.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      error_ = system_error(path_, "write");
      failed_ = true;
    }
  }
}

}  // namespace clay::live
