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
  recorder->own_sink_ = std::move(*sink);
  return recorder;
}

std::unique_ptr<Recorder> Recorder::create(PoseSink& sink, std::uint64_t most) {
  std::unique_ptr<Recorder> recorder(new Recorder(sink, most));
  recorder->worker_.emplace([&self = *recorder](bool) { self.hand_on(); }, kPause);
  return recorder;
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

void Recorder::hand_on() {
  for (;;) {
    while (block_.size() < kPosesPerBlock) {
      const auto played = queue_.pop();
      if (!played) break;
      contact_[block_.size()] = played->contact;
      block_.push_back(played->pose);
    }
    if (block_.empty()) return;
    const PoseBlock block{block_, std::span(contact_).first(block_.size())};
    if (auto appended = failed_ ? Result<void>() : sink_.append(block); !appended) {
      error_ = appended.error();
      failed_ = true;
    }
    block_.clear();
  }
}

}  // namespace clay::servo
