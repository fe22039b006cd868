#pragma once
// The only doors through which meshes come in and go out. Encoders write to memory;
// publishing is the caller's. Decoders trust nothing: they are ours for STL and OBJ, and
// Draco's own behind a guard.

#include "claystack/engine/result.hpp"
#include "claystack/export/triangle_mesh.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace clay::solid {

enum class MeshFormat { stl_binary, stl_ascii, obj, drc };

/// By the name's end: .stl (binary), .obj, .drc; anything else is an error that lists them.
Result<MeshFormat> mesh_format_of(std::string_view path);
[[nodiscard]] std::string_view name_of(MeshFormat format) noexcept;

/// What Draco's encoder may do to positions.
struct DracoSettings {
  double max_error_mm = 0.01;  ///< largest displacement of a vertex
  int min_bits = 8;            ///< at least this many bits per coordinate
  int speed = 3;               ///< 0 (small) .. 10 (fast)
};

/// Coordinates go out as float32 in STL and OBJ: the text formats print the shortest
/// digits that read back as the same float32. Draco gets them as float32 too.
std::string encode_stl_binary(const TriangleMesh& mesh);
std::string encode_stl_ascii(const TriangleMesh& mesh, std::string_view solid_name);
std::string encode_obj(const TriangleMesh& mesh, std::string_view object_name);
Result<std::string> encode_drc(const TriangleMesh& mesh, const DracoSettings& settings);

/// A mesh as a file states it, nothing repaired. STL corners are welded where their float32
/// coordinates are equal (-0 equals 0). Positions are finite and |x| <= 1e6 mm; indices are in range.
/// `name` begins every message: "NAME: facet 12: ...", "NAME:34: ...".
Result<TriangleMesh> decode_mesh(std::string_view bytes, MeshFormat format, std::string_view name);

/// STL files are told apart by their size, never by the word "solid".
Result<TriangleMesh> decode_stl(std::string_view bytes, std::string_view name);
Result<TriangleMesh> decode_obj(std::string_view bytes, std::string_view name);
Result<TriangleMesh> decode_drc(std::string_view bytes, std::string_view name);

/// The mesh as float32 files hold it.
[[nodiscard]] TriangleMesh rounded_to_float(const TriangleMesh& mesh);

}  // namespace clay::solid
