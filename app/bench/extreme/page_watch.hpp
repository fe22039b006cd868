#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace clay::extreme {

/// Number of whole pages in a range of memory.
[[nodiscard]] std::size_t pages_in(std::span<const std::byte> memory);

/// Number of these pages that `work` reads or writes: all are protected before, and each is opened
/// at its first use. A count does not depend on the machine, unlike a time. One thread at a time;
/// nothing else may use that memory meanwhile.
[[nodiscard]] std::size_t pages_opened(std::span<const std::byte> memory,
                                       const std::function<void()>& work);

}  // namespace clay::extreme
