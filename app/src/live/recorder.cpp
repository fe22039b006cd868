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

/// A session file that is written from its beginning.
class SessionSink final : public work::PoseSink {
 public:
  SessionSink(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  ~SessionSink() override {
    if (descriptor_ >= 0) close(descriptor_);
  }
  SessionSink(const SessionSink&) = delete;
  SessionSink& operator=(const SessionSink&) = delete;

  Result<void> append(std::span<const Pose> poses) override {
    if (poses.size() > kMaxPoses - poses_)
      return failure(ErrorKind::bad_input,
                     path_ + ": expected at most " + std::to_string(kMaxPoses) +
                         " poses in one session, found more; it ends with the last that fits");
    poses_ += poses.size();
    return write(session_block(poses));
  }

  Result<void> write(std::string_view line) {
    while (!line.empty()) {
      const auto written = ::write(descriptor_, line.data(), line.size());
      if (written > 0)
        line.remove_prefix(static_cast<std::size_t>(written));
      else if (written == 0 || errno != EINTR)
        return failed("write");
    }
    return {};
  }

  Result<void> finish() override {
    if (fsync(descriptor_) != 0 && errno != EINVAL) return failed("sync");
    if (close(std::exchange(descriptor_, -1)) != 0) return failed("close");
    return {};
  }

  tl::unexpected<Error> failed(const char* action) const {
    return failure(ErrorKind::io,
                   path_ + ": could not " + action + ": " + std::generic_category().message(errno));
  }

 private:
  std::string path_;
  int descriptor_;
  std::size_t poses_ = 0;
};

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path,
                                                   std::string_view scene_name,
                                                   std::uint64_t scene_hash) {
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  auto sink = std::make_unique<SessionSink>(path, descriptor);
  if (descriptor < 0) return sink->failed("open");
  if (auto begun = sink->write(session_header(scene_name, scene_hash)); !begun)
    return tl::make_unexpected(begun.error());
  auto recorder = create(*sink);
  recorder->own_sink_ = std::move(sink);
  return recorder;
}

std::unique_ptr<Recorder> Recorder::create(work::PoseSink& sink) {
  std::unique_ptr<Recorder> recorder(new Recorder(sink));
  recorder->thread_ = std::thread([&self = *recorder] { self.run(); });
  return recorder;
}

Recorder::Recorder(work::PoseSink& sink) : sink_(sink) { block_.reserve(kPosesPerBlock); }

Recorder::~Recorder() {
  closing_.store(true);
  if (thread_.joinable()) thread_.join();
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
  if (failed_) return tl::make_unexpected(error_);
  return sink_.finish();
}

void Recorder::run() {
  while (!closing_.load()) {
    hand_on();
    std::this_thread::sleep_for(kPause);
  }
  hand_on();
}

void Recorder::hand_on() {
  for (;;) {
    while (block_.size() < kPosesPerBlock) {
      const auto pose = queue_.pop();
      if (!pose) break;
      block_.push_back(*pose);
    }
    if (block_.empty()) return;
    if (auto appended = failed_ ? Result<void>() : sink_.append(block_); !appended) {
      error_ = appended.error();
      failed_ = true;
    }
    block_.clear();
  }
}

}  // namespace clay::live
