#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace clay {

/// All allocations of `work` come from one range of memory, which is returned and never freed.
/// operator new is replaced in heap_arena.cpp.
std::span<const std::byte> allocate_together(const std::function<void()>& work);

}  // namespace clay
