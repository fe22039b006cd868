#pragma once
// Limits of mesh files: every reader checks them before it allocates.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/solid.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <glm/vec3.hpp>
#include <new>
#include <optional>
#include <string>
#include <string_view>

namespace clay::solid::inline formats {

inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;
inline constexpr std::size_t kMaxPoints = 3 * kMaxTriangles;  // if no facets share a corner
inline constexpr std::size_t kMaxFaceCorners = 65536;
// A few instances can stand for billions of triangles.
inline constexpr std::uint64_t kMostCopies = 64, kFreeTriangles = 1'000'000;
inline constexpr float kMaxCoordinateMm = 1e6F;
inline constexpr std::string_view kCoordinateRule = "a coordinate within +-1e6 mm";

/// The most elements that instances may make of those stored in a file; `free` of them in any case.
[[nodiscard]] constexpr std::uint64_t most_with_copies(std::uint64_t stored,
                                                       std::uint64_t free) noexcept {
  return std::max(free, kMostCopies * stored);
}

/// False for NaN.
[[nodiscard]] inline bool is_coordinate(float mm) noexcept {
  return std::abs(mm) <= kMaxCoordinateMm;
}

/// "expected ..., found ..." if one of the three is not a valid coordinate.
[[nodiscard]] std::optional<std::string> find_bad_coordinate(const glm::vec3& point);

/// "expected at most 20000000 triangles".
[[nodiscard]] std::string expected_at_most(std::size_t limit, std::string_view what);

/// A lower limit above 0 in three digits, rounded up: the number itself keeps the limit.
[[nodiscard]] std::string sufficient_text(double limit);

/// "NAME: what", of kind bad_input.
[[nodiscard]] tl::unexpected<Error> bad_file(std::string_view name, std::string_view what);

[[nodiscard]] Result<void> check_file_size(std::string_view bytes, std::string_view name);

/// Also refuses zero facets.
[[nodiscard]] Result<void> check_facet_count(std::uint64_t facets, std::string_view name);

/// Refuses a text file that is too large, with an estimate of its triangles: its size divided by
/// `usual_bytes`, the usual size per triangle [bytes].
[[nodiscard]] Result<void> check_text_size(const ByteSource& source, std::size_t usual_bytes,
                                           std::string_view name);

/// A source that reads from memory. The bytes outlive it.
[[nodiscard]] ByteSource source_of(std::string_view bytes);

/// Returns the result of `read`; converts exceptions (out of memory, Draco's own) to errors.
template <class Read>
[[nodiscard]] auto guarded(std::string_view name, const Read& read) -> decltype(read()) try {
  return read();
} catch (const std::bad_alloc&) {
  return failure(ErrorKind::io, std::string(name).append(": not enough memory to read it"));
} catch (const std::exception& error) {
  return bad_file(name, std::string("cannot be read: ").append(error.what()));
}

}  // namespace clay::solid::inline formats
