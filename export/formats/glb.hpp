#pragma once
// Shared by the writer and the reader of GLB: chunks, component types, and the turn from mm and z
// up to metres and y up; and the rounding of points by every format.

#include "claystack/export/formats.hpp"
#include "export/formats/file_floats.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>

namespace clay::solid::inline formats::glb {

inline constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;
inline constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
inline constexpr std::size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8;

inline constexpr int kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat32 = 5126;
inline constexpr int kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;
inline constexpr int kInt8 = 5120, kInt16 = 5122;
inline constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
inline constexpr std::string_view kMeshopt = "EXT_meshopt_compression";
inline constexpr std::string_view kQuantization = "KHR_mesh_quantization";

inline constexpr std::string_view kInstancing = "EXT_mesh_gpu_instancing";

inline constexpr double kMmPerMetre = 1000.0;

[[nodiscard]] inline glm::dvec3 to_metres(const glm::dvec3& mm) noexcept {
  return glm::dvec3(mm.x, mm.z, -mm.y) / kMmPerMetre;
}
[[nodiscard]] inline glm::vec3 to_mm(const glm::dvec3& metres) noexcept {
  return file_point(kMmPerMetre * glm::dvec3(metres.x, -metres.z, metres.y));
}

}  // namespace clay::solid::inline formats::glb

namespace clay::solid::inline formats {

/// The point [mm] that a reader gets for this one, if the format has no coarser grid.
[[nodiscard]] inline glm::dvec3 held_point(const glm::dvec3& mm, MeshFormat format) noexcept {
  if (format != MeshFormat::glb) return file_point(mm);
  return glb::to_mm(file_point(glb::to_metres(mm)));
}

/// Maximum number of roundings of a coordinate to float32 on its way through a file: a GLB rounds
/// in metres, perhaps again on Draco's grid, and in mm when it is read.
[[nodiscard]] constexpr double roundings_of(MeshFormat format) noexcept {
  return format == MeshFormat::glb ? 3.0 : 1.0;
}

}  // namespace clay::solid::inline formats
