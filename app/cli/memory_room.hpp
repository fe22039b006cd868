#pragma once
// The memory that this process may still allocate: checked before large work, and enforced.

#include "claystack/core/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace clay::cli {

/// The limit of every command unless --memory sets another [bytes].
inline constexpr std::uint64_t kDefaultMemory = std::uint64_t{4} << 30;

/// Sets the limit on the memory that this process allocates (RLIMIT_DATA): beyond it, allocations
/// fail. Without effect where the process already uses more, as under a sanitizer.
void limit_memory(std::uint64_t bytes) noexcept;
/// The limit that was set last [bytes]; 0 if none is in effect.
[[nodiscard]] std::uint64_t memory_limit() noexcept;

struct MemoryRoom {
  std::uint64_t bytes = UINT64_MAX;
  std::string_view limit = "any limit";  ///< the source of the limit
};

/// The smallest of the remainders of --memory and `ulimit -v`, and the machine's available memory.
[[nodiscard]] MemoryRoom memory_room();

/// An error of kind `io` if `job` needs more memory than there is room for: "JOB needs about 3 GB
/// of memory, found 1 GB available within ...".
[[nodiscard]] Result<void> expect_room(std::string_view job, std::uint64_t bytes);

/// The same for a picture of this many pixels: drivers of OpenGL crash when they run out of memory,
/// so none is started. Measured with Mesa's llvmpipe.
[[nodiscard]] Result<void> expect_room_to_draw(std::uint64_t pixels);

/// The message of these errors; both figures have as many decimals as they need to differ.
[[nodiscard]] std::string lack_of_room(std::string_view job, std::uint64_t bytes,
                                       const MemoryRoom& room);

/// "1.2 GB"
[[nodiscard]] std::string gigabytes(std::uint64_t bytes);

}  // namespace clay::cli
