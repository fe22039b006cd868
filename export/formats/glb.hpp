#pragma once
// What the writer and the reader of GLB share: chunks, component types, and the turn from mm and z
// up to metres and y up.

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

inline constexpr double kMmPerMetre = 1000.0;

[[nodiscard]] inline glm::dvec3 to_metres(const glm::dvec3& mm) noexcept {
  return glm::dvec3(mm.x, mm.z, -mm.y) / kMmPerMetre;
}
[[nodiscard]] inline glm::vec3 to_mm(const glm::dvec3& metres) noexcept {
  return file_point(kMmPerMetre * glm::dvec3(metres.x, -metres.z, metres.y));
}

}  // namespace clay::solid::inline formats::glb
