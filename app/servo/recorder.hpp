#pragma once
// Keeps what is played: a session, or a stroke of a journal. The servo hands over poses and never
// waits; a thread of its own brings them to a sink a few hundredths of a second later, whole blocks
// at a time: a process that is killed loses at most the last 100 ms. (The machine's own end is not
// guarded against until `finish` has synced the file.)

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#include "core/spsc_queue.hpp"
#include "core/worker.hpp"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::servo {

class Recorder {
 public:
  /// To a session file: session_recording.hpp has its errors and what is where meanwhile.
  static Result<std::unique_ptr<Recorder>> create(const std::string& path,
                                                  std::string_view scene_name,
                                                  std::uint64_t scene_hash);
  /// For any sink, which outlives it.
  static std::unique_ptr<Recorder> create(PoseSink& sink);
  /// Ends the recording; who wants to know how it went calls finish() first.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// From the servo: a quantised pose, later than the last, and whether the tool was in the clay.
  /// No waiting, no allocation. False: it is not recorded, nor is any after it, since a session
  /// with a hole would replay to another pot.
  bool take(const Pose& pose, bool contact) noexcept;

  /// After the last take: waits until all is in the sink, and the sink has finished. The error is
  /// of the first write that failed.
  Result<void> finish();

  /// Poses not recorded, since the disk was too slow or refused.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(); }
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_.load(); }

 private:
  explicit Recorder(PoseSink& sink);
  void hand_on();

  static constexpr std::size_t kWaiting = 8192;  // poses: 8 s at 1 kHz
  std::unique_ptr<PoseSink> own_sink_;
  PoseSink& sink_;
  struct Played {
    Pose pose;
    bool contact;
  };
  SpscQueue<Played, kWaiting> queue_;
  std::atomic<std::uint64_t> lost_{0}, taken_{0};
  std::atomic<bool> failed_{false};
  std::vector<Pose> block_;                     // the thread's
  std::array<bool, kPosesPerBlock> contact_{};  // of its poses
  Error error_;                                 // the thread's, until it has ended
  std::optional<PeriodicWorker> worker_;        // last: it uses all members above
};

}  // namespace clay::servo
