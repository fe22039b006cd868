#include "app/history/replay.hpp"

#include <utility>

namespace clay::history {

Replay::Replay(Wheel wheel) : wheel_(std::move(wheel)), thread_([this] { run(); }) {}

Replay::~Replay() { close(); }

void Replay::append(std::span<const Pose> poses) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), poses.begin(), poses.end());
  }
  wake_.notify_one();
}

Thrown Replay::finish() {
  close();
  return {wheel_.pot(), std::move(touching_)};
}

void Replay::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Replay::run() {
  std::vector<Pose> poses;
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    poses.clear();
    std::swap(poses, waiting_);
    lock.unlock();
    for (const Pose& pose : poses) touching_.push_back((wheel_.step(pose).flags & kContact) != 0);
    lock.lock();
  }
}

}  // namespace clay::history
