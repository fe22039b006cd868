#pragma once
#include "claystack/export/job.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline job {

/// Runs stages, reports each at its start and adds up its time under its name. No stage starts
/// after the job was cancelled.
class Stages {
 public:
  Stages(std::vector<StageTime>& times, const std::function<void(std::string_view)>& progress)
      : times_(times), progress_(progress) {}

  template <class Work>
  auto run(const std::string& name, Work work) {
    stop_if_cancelled();
    if (progress_) progress_(name);
    const auto begin = std::chrono::steady_clock::now();
    auto result = work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    const auto known = std::find_if(times_.begin(), times_.end(),
                                    [&](const StageTime& stage) { return stage.name == name; });
    if (known != times_.end())
      known->seconds += spent.count();
    else
      times_.push_back({name, spent.count()});
    return result;
  }

 private:
  std::vector<StageTime>& times_;
  const std::function<void(std::string_view)>& progress_;
};

}  // namespace clay::solid::inline job
