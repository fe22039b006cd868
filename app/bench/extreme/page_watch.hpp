#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace clay::extreme {

/// Whole pages within a stretch of memory.
[[nodiscard]] std::size_t pages_in(std::span<const std::byte> memory);

/// How many of them `work` reads or writes: all are protected before it, and each is opened at its
/// first use. A count, where a time would depend on the machine. One thread at a time; nothing
/// else may use that memory meanwhile.
[[nodiscard]] std::size_t pages_opened(std::span<const std::byte> memory,
                                       const std::function<void()>& work);

}  // namespace clay::extreme
