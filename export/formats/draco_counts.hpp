#pragma once
// The sizes that a Draco mesh states. Draco's decoder allocates by them before it reads any data,
// so that a file of 20 bytes may take gigabytes.

#include "claystack/core/result.hpp"

#include <cstdint>
#include <string_view>

namespace clay::solid::inline formats {

struct DracoCounts {
  std::uint64_t triangles = 0, points = 0;
};

/// For a file with a valid header and without metadata. Errors begin with `name`: the counts end
/// early, or are beyond the limits of mesh files.
[[nodiscard]] Result<DracoCounts> draco_counts(std::string_view bytes, std::string_view name);

}  // namespace clay::solid::inline formats
