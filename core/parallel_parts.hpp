#pragma once
#include "core/cancel.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace clay {

/// work(0) .. work(parts - 1), on all cores. Which thread takes which part is left open: each part
/// writes to a place of its own, so that the result never depends on it. Parts are begun in
/// order, the longest had best come first. The caller may be cancelled in any of them. Of several
/// exceptions the lowest part's is thrown.
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
  const std::size_t cores = std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
  {
    std::vector<std::jthread> helpers;
    try {
      while (helpers.size() + 1 < std::min(cores, parts)) helpers.emplace_back(take_parts);
    } catch (const std::system_error&) {
      // No more threads are to be had: those there are do all the work.
    }
    take_parts();
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace clay
