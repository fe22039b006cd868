#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/tool.hpp"

#include <span>

namespace clay::history {

/// Receives the poses that a recorder takes from the servo's queue: a session or a journal. Called
/// from one thread at a time.
class PoseSink {
 public:
  virtual ~PoseSink() = default;
  /// The next poses of the stroke, at most kPosesPerBlock, quantized. After an error nothing more
  /// is appended.
  virtual Result<void> append(std::span<const Pose> poses) = 0;
  /// The end of the poses. An error: not all of them were stored.
  virtual Result<void> finish() = 0;
};

}  // namespace clay::history
