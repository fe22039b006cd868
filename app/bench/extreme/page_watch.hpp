#pragma once
#include <cstddef>
#include <functional>
#include <span>

namespace clay::extreme {

/// Number of whole pages in a range of memory.
[[nodiscard]] std::size_t pages_in(std::span<const std::byte> memory);

/// Number of these pages that `work` reads or writes. All are protected first; each is opened at
/// its first use. Unlike a time, the count does not depend on the machine. One thread at a time; no
/// other code may use that memory meanwhile.
[[nodiscard]] std::size_t pages_opened(std::span<const std::byte> memory,
                                       const std::function<void()>& work);

}  // namespace clay::extreme
