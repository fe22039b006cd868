#pragma once
// A stroke thrown again while it lasts: when it ends there is little left to do, however long it
// was and however many rings its pot has.

#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <condition_variable>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace clay::history {

/// What the poses of a stroke have made.
struct Thrown {
  Pot pot;
  std::vector<bool> touching;  ///< at each pose: whether the tool was in the clay
};

/// Poses come from one thread and are thrown by another, which Replay keeps.
class Replay {
 public:
  explicit Replay(Wheel wheel);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  void append(std::span<const Pose> poses);  ///< waits for nothing
  /// After the last pose; waits until it is thrown. Once.
  [[nodiscard]] Thrown finish();

 private:
  void close();
  void run();

  Wheel wheel_;                 // the thread's, until it has ended
  std::vector<bool> touching_;  // the same
  std::mutex mutex_;            // of what follows
  std::condition_variable wake_;
  std::vector<Pose> waiting_;
  bool closing_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace clay::history
