#pragma once
#include "claystack/export/export_job.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid {

/// A job that is no longer wanted; no fault of its own.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// Runs stages, tells of each as it begins and adds up its time under its name. A stage does not
/// begin once the job is no longer wanted: Cancelled.
class Stages {
 public:
  Stages(std::vector<StageTime>& times, const std::function<void(std::string_view)>& progress,
         std::stop_token cancel)
      : times_(times), progress_(progress), cancel_(std::move(cancel)) {}

  template <class Work>
  auto run(const std::string& name, Work work) {
    if (cancel_.stop_requested()) throw Cancelled();
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
  std::stop_token cancel_;
};

}  // namespace clay::solid
