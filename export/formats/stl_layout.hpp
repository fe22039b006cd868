#pragma once
// Layout of binary STL.

#include "core/little_endian.hpp"
#include "export/formats/file_floats.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string_view>

namespace clay::solid::inline formats::stl {

inline constexpr std::size_t kHeaderBytes = 80;
inline constexpr std::size_t kPrologueBytes = kHeaderBytes + 4;
inline constexpr std::size_t kFacetBytes = 50;
inline constexpr std::size_t kPointBytes = 12;
// Must not begin with "solid": simple readers would treat the file as text.
inline constexpr std::string_view kHeader = "claystack: binary STL, units mm";

using Corners = std::array<glm::vec3, 3>;

[[nodiscard]] inline std::size_t file_bytes(std::size_t facets) noexcept {
  return kPrologueBytes + kFacetBytes * facets;
}

/// In double, from the written corners; zero if they span no area, as is usual.
[[nodiscard]] inline glm::vec3 facet_normal(const Corners& corners) noexcept {
  const glm::dvec3 origin(corners[0]);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(corners[1]) - origin, glm::dvec3(corners[2]) - origin);
  const double squared = glm::dot(normal, normal);
  return squared > 0.0 ? file_point(normal * (1.0 / std::sqrt(squared))) : glm::vec3(0.0F);
}

inline void store_point(char* at, const glm::vec3& point) noexcept {
  for (int axis = 0; axis < 3; ++axis) store_f32(at + 4 * axis, point[axis]);
}

[[nodiscard]] inline glm::vec3 load_point(const char* at) noexcept {
  return {load_f32(at), load_f32(at + 4), load_f32(at + 8)};
}

/// The 84 bytes before the first facet.
inline void store_prologue(char* at, std::size_t facets) noexcept {
  std::fill_n(at, kHeaderBytes, '\0');
  kHeader.copy(at, kHeaderBytes);
  store_u32(at + kHeaderBytes, static_cast<std::uint32_t>(facets));
}

/// Whether a facet has these corners, to the last bit.
[[nodiscard]] inline bool has_corners(const char* facet, const Corners& corners) noexcept {
  if constexpr (std::endian::native == std::endian::little)
    return std::memcmp(facet + kPointBytes, corners.data(), sizeof corners) == 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (load_point(facet + kPointBytes * (i + 1)) != corners[i]) return false;
  return true;
}

/// Includes its two attribute bytes, which are zero.
inline void store_facet(char* at, const Corners& corners) noexcept {
  store_point(at, facet_normal(corners));
  for (std::size_t i = 0; i < 3; ++i) store_point(at + kPointBytes * (i + 1), corners[i]);
  at[kFacetBytes - 2] = at[kFacetBytes - 1] = '\0';
}

}  // namespace clay::solid::inline formats::stl
