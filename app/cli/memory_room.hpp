#pragma once
// The memory that this process may still allocate, checked before large work.

#include <cstdint>
#include <string>
#include <string_view>

namespace clay::cli {

struct MemoryRoom {
  std::uint64_t bytes = UINT64_MAX;
  std::string_view limit = "any limit";  ///< the source of the limit
};

/// The smaller of the remainder of `ulimit -v` and the machine's available memory.
[[nodiscard]] MemoryRoom memory_room();

/// For messages.
[[nodiscard]] std::string gigabytes(std::uint64_t bytes);

}  // namespace clay::cli
