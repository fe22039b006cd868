#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace clay::solid::inline proof {

/// Counting stops here: such a mesh cannot be used anyway.
inline constexpr std::size_t kMaxSelfIntersections = 100'000;

using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;  ///< lower number first

/// The number of intersecting pairs of triangles, and the pair of lowest numbers.
struct Crossings {
  std::size_t count = 0;
  TrianglePair first{UINT32_MAX, UINT32_MAX};

  /// Returns false when the limit is reached.
  bool add(std::uint32_t a, std::uint32_t b, std::size_t pairs = 1) {
    return add({pairs, std::minmax(a, b)});
  }
  bool add(const Crossings& more) {
    count = std::min(count + more.count, kMaxSelfIntersections);
    first = std::min(first, more.first);
    return count < kMaxSelfIntersections;
  }
};

}  // namespace clay::solid::inline proof
