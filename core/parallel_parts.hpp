#pragma once
#include "core/cancel.hpp"
#include "core/threads.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace clay {

/// Runs work(0) .. work(parts - 1) on all cores. The assignment to threads is not deterministic:
/// each part writes to its own place, so the result does not depend on it. Parts start in order;
/// put the longest first. All parts belong to the caller's cancellation scope. If several parts
/// throw, the exception of the lowest part is rethrown.
template <class Work>
void for_each_part(std::size_t parts, const Work& work) {
  std::vector<std::exception_ptr> failures(parts);
  std::atomic<std::size_t> next{0};
  const CancelScope::Question* const question = CancelScope::current();
  const auto take_parts = [&] {
    const CancelScope scope(question);
    for (std::size_t part = next++; part < parts; part = next++) {
      try {
        work(part);
      } catch (...) {
        failures[part] = std::current_exception();
      }
    }
  };
  const std::size_t cores =
      kThreads ? std::max<std::size_t>(std::thread::hardware_concurrency(), 1) : 1;
  {
    std::vector<std::jthread> helpers;
    try {
      while (helpers.size() + 1 < std::min(cores, parts)) helpers.emplace_back(take_parts);
    } catch (const std::system_error&) {
      // No more threads are available: the existing ones do all the work.
    }
    take_parts();
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace clay
