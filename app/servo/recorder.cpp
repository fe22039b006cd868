#include "app/servo/recorder.hpp"

#include "app/servo/session_recording.hpp"

#include <chrono>
#include <utility>

namespace clay::servo {
namespace {

// A third of the permitted loss, because the thread may have to wait for the processor.
constexpr auto kPause = std::chrono::milliseconds(30);

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::create(const std::string& path,
                                                   std::string_view scene_name,
                                                   std::uint64_t scene_hash) {
  auto sink = SessionRecording::begin(path, scene_name, scene_hash);
  if (!sink) return tl::make_unexpected(sink.error());
  auto recorder = create(**sink);
  if (recorder) (*recorder)->own_sink_ = std::move(*sink);
  return recorder;
}

Result<std::unique_ptr<Recorder>> Recorder::create(PoseSink& sink, std::uint64_t most) {
  std::unique_ptr<Recorder> recorder(new Recorder(sink, most));
  return with_threads("the recorder's thread",
                      [&self = *recorder] {
                        self.worker_.emplace([&self](bool) { self.write_waiting(); }, kPause);
                      })
      .map([&] { return std::move(recorder); });
}

Recorder::Recorder(PoseSink& sink, std::uint64_t most) : sink_(sink), most_(most) {
  block_.reserve(kPosesPerBlock);
}

Recorder::~Recorder() = default;

bool Recorder::take(const Pose& pose, bool contact) noexcept {
  const bool whole =
      lost_.load(std::memory_order_relaxed) == 0 && taken_.load(std::memory_order_relaxed) < most_;
  if (whole && !failed_.load(std::memory_order_relaxed) && queue_.push({pose, contact})) {
    taken_.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  lost_.fetch_add(1, std::memory_order_relaxed);
  return false;
}

Result<void> Recorder::finish() {
  worker_->close();
  if (failed_) return tl::make_unexpected(error_);
  return sink_.finish();
}

void Recorder::write_waiting() {
  for (;;) {
    while (block_.size() < kPosesPerBlock) {
      const auto played = queue_.pop();
      if (!played) break;
      contact_[block_.size()] = played->contact;
      block_.push_back(played->pose);
    }
    if (block_.empty()) return;
    if (!append({block_, std::span(contact_).first(block_.size())})) {
      lost_.fetch_add(block_.size(), std::memory_order_relaxed);
      taken_.fetch_sub(block_.size(), std::memory_order_relaxed);
    }
    block_.clear();
  }
}

/// False if the sink refuses the block, or has refused an earlier one.
bool Recorder::append(const PoseBlock& block) {
  if (failed_) return false;
  auto appended = sink_.append(block);
  if (appended) return true;
  error_ = appended.error();
  failed_ = true;
  return false;
}

}  // namespace clay::servo
