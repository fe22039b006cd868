#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace clay {

/// All that `work` allocates comes from one stretch of memory, which is returned; it is never given
/// back. operator new is replaced in heap_arena.cpp.
std::span<const std::byte> allocate_together(const std::function<void()>& work);

}  // namespace clay
