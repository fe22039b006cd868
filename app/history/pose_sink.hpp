#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/tool.hpp"

#include <span>

namespace clay::history {

/// Where poses go that a recorder takes off the servo's queue: a session, a journal. Called from
/// one thread at a time.
class PoseSink {
 public:
  virtual ~PoseSink() = default;
  /// The next poses of the stroke, at most kPosesPerBlock of them, quantised. An error is the last
  /// word: nothing is appended after it.
  virtual Result<void> append(std::span<const Pose> poses) = 0;
  /// No more come. An error: not all of them are where they should be.
  virtual Result<void> finish() = 0;
};

}  // namespace clay::history
