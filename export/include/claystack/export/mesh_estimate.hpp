#pragma once
// The size of a mesh before its file is decoded, for an estimate of the memory.

#include "claystack/export/formats.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace clay::solid::inline formats {

struct MeshEstimate {
  std::uint64_t triangles = 0;
  /// Memory that the decoder needs for each triangle, beside the mesh and the file [bytes].
  std::uint64_t decoding_bytes = 0;
};

/// Of a .drc and a .glb, the triangles that the file states, with each copy that a scene places;
/// of another format, those that a file of this size usually has, and of a .3mf, those of its
/// models after unpacking, without the copies that it places. Decodes nothing. 0 triangles for a
/// file that is damaged: the error is that of `decode_mesh`.
[[nodiscard]] MeshEstimate estimate_mesh(std::string_view bytes, MeshFormat format);

/// The facets that a binary STL counts, and those that it holds.
struct FacetCount {
  std::uint64_t counted = 0, there = 0;
};
/// The first bytes of a binary STL, before its facets.
inline constexpr std::size_t kStlPrologueBytes = 84;
/// Of a binary STL that is too short for the facets that it counts. `head`: its first bytes;
/// `size`: of the whole file. Empty for other files.
[[nodiscard]] std::optional<FacetCount> missing_facets(std::string_view head, std::uint64_t size);

}  // namespace clay::solid::inline formats
