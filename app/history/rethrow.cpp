#include "app/history/rethrow.hpp"

#include <utility>

namespace clay::work {

Rethrow::Rethrow(Wheel wheel) : wheel_(std::move(wheel)), thread_([this] { run(); }) {}

Rethrow::~Rethrow() { close(); }

void Rethrow::append(std::span<const Pose> poses) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), poses.begin(), poses.end());
  }
  wake_.notify_one();
}

Thrown Rethrow::finish() {
  close();
  return {wheel_.pot(), std::move(touching_)};
}

void Rethrow::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Rethrow::run() {
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

}  // namespace clay::work
