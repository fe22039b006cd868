#pragma once
// How much memory this process may still take, asked before large work is begun.

#include <cstdint>
#include <string>
#include <string_view>

namespace clay::cli {

struct MemoryRoom {
  std::uint64_t bytes = UINT64_MAX;
  std::string_view limit = "any limit";  ///< what sets it
};

/// The least of what `ulimit -v` leaves and what the machine has to give.
[[nodiscard]] MemoryRoom memory_room();

/// For messages.
[[nodiscard]] std::string gigabytes(std::uint64_t bytes);

}  // namespace clay::cli
