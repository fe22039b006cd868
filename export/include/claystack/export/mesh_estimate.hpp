#pragma once
// The size of a mesh before its file is decoded, for an estimate of the memory.

#include "claystack/export/formats.hpp"

#include <cstdint>
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

}  // namespace clay::solid::inline formats
