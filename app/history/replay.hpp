#pragma once
// Replays a stroke while it is recorded, so that little is left to do at its end, for any length
// and number of rings.

#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <condition_variable>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace clay::history {

/// The result of a stroke's poses.
struct Thrown {
  Pot pot;
  std::vector<bool> touching;  ///< for each pose: whether the tool was in the clay
};

/// One thread supplies poses; a thread of this class replays them.
class Replay {
 public:
  explicit Replay(Wheel wheel);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  void append(std::span<const Pose> poses);  ///< does not wait
  /// After the last pose: waits until all are replayed. Call once.
  [[nodiscard]] Thrown finish();

 private:
  void close();
  void run();

  Wheel wheel_;                 // used by the thread until it ends
  std::vector<bool> touching_;  // the same
  std::mutex mutex_;            // protects the following members
  std::condition_variable wake_;
  std::vector<Pose> waiting_;
  bool closing_ = false;
  std::thread thread_;  // last: it uses all members above
};

}  // namespace clay::history
