#pragma once
#include "core/cancel.hpp"

#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

namespace clay::solid::inline repair {

/// Reports the stage that has begun, and the share of it that is done. For use by one thread.
class StageReport {
 public:
  using Progress = std::function<void(std::string_view stage, double share)>;
  explicit StageReport(const Progress& progress) : progress_(progress) {}

  /// No stage starts after the job was cancelled. The name is a literal.
  void begin(std::string_view stage) {
    stop_if_cancelled();
    stage_ = stage;
    percent_ = 0;
    if (progress_) progress_(stage_, 0.0);
  }

  /// Reports each per cent once.
  void done(std::size_t parts, std::size_t of_all) {
    if (!progress_ || of_all == 0) return;
    const std::size_t percent = 100 * parts / of_all;
    if (std::exchange(percent_, percent) == percent) return;
    progress_(stage_, static_cast<double>(parts) / static_cast<double>(of_all));
  }

 private:
  const Progress& progress_;
  std::string_view stage_;
  std::size_t percent_ = 0;
};

}  // namespace clay::solid::inline repair
