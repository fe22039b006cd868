#pragma once
#include <cstddef>

namespace clay {

/// Calls of operator new so far in this program (replaced in allocation_counter.cpp).
std::size_t allocation_count() noexcept;

}  // namespace clay
