#pragma once
#include <cstddef>

namespace clay {

/// Calls of operator new so far in this program (replaced in allocation_counter.cpp).
std::size_t allocation_count() noexcept;

/// The most bytes from operator new that were in use at once since the last restart, which returns
/// what is in use then.
std::size_t restart_allocation_peak() noexcept;
std::size_t allocation_peak_bytes() noexcept;

/// The most bytes that `work` has in use beside those that were in use before it.
template <class Work>
std::size_t peak_bytes_of(Work work) {
  const std::size_t before = restart_allocation_peak();
  work();
  return allocation_peak_bytes() - before;
}

}  // namespace clay
