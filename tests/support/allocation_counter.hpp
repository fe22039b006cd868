#pragma once
#include <cstddef>

namespace clay {

/// Number of calls of operator new so far in this program (replaced in allocation_counter.cpp).
std::size_t allocation_count() noexcept;

/// Peak of bytes allocated by operator new since the last restart; returns the current number.
std::size_t restart_allocation_peak() noexcept;
std::size_t allocation_peak_bytes() noexcept;

/// Peak of bytes that `work` allocates in addition to those allocated before.
template <class Work>
std::size_t peak_bytes_of(Work work) {
  const std::size_t before = restart_allocation_peak();
  work();
  return allocation_peak_bytes() - before;
}

}  // namespace clay
