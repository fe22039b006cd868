#pragma once
// Stores the poses that are played: in a session, or in a stroke of a journal. The servo hands over
// poses without waiting; a separate thread writes them to a sink in blocks, some hundredths of a
// second later. A process that is killed loses at most the last 100 ms. A power failure may lose
// more until `finish` has synced the file.

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
  /// Records to a session file; see session_recording.hpp for errors and temporary files. Both
  /// return an error of kind `io` if the system starts no thread.
  static Result<std::unique_ptr<Recorder>> create(const std::string& path,
                                                  std::string_view scene_name,
                                                  std::uint64_t scene_hash);
  /// Records up to `most` poses to any sink, which must outlive this object.
  static Result<std::unique_ptr<Recorder>> create(PoseSink& sink, std::uint64_t most = kMaxPoses);
  /// Ends the recording. Call finish() first to learn whether it succeeded.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Called by the servo with a quantised pose, later than the last, and whether the tool was in
  /// the clay. Does not wait or allocate. False: neither this pose nor any later one is recorded,
  /// because a session with a gap would replay to another pot.
  bool take(const Pose& pose, bool contact) noexcept;

  /// After the last pose: waits until all poses are in the sink and the sink has finished. Returns
  /// the first error.
  Result<void> finish();

  /// Number of poses not recorded, because the disk was too slow or refused them, or because the
  /// session was full.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(); }
  /// Number of the others: exact after finish(), before that some may still be refused.
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_.load(); }

 private:
  Recorder(PoseSink& sink, std::uint64_t most);
  void write_waiting();
  [[nodiscard]] bool append(const PoseBlock& block);

  static constexpr std::size_t kWaiting = 8192;  // poses: 8 s at 1 kHz
  std::unique_ptr<PoseSink> own_sink_;
  PoseSink& sink_;
  std::uint64_t most_;
  struct Played {
    Pose pose;
    bool contact;
  };
  SpscQueue<Played, kWaiting> queue_;
  std::atomic<std::uint64_t> lost_{0}, taken_{0};
  std::atomic<bool> failed_{false};
  std::vector<Pose> block_;                     // used by the worker
  std::array<bool, kPosesPerBlock> contact_{};  // of its poses
  Error error_;                                 // used by the worker until it has ended
  std::optional<PeriodicWorker> worker_;        // last: it uses all members above
};

}  // namespace clay::servo
