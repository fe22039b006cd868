#include "claystack/export/formats.hpp"

#include "export/formats/file_floats.hpp"
#include "export/formats/text_scanner.hpp"

namespace clay::solid::inline formats {

Result<MeshFormat> mesh_format_of(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const std::string_view ending = dot == path.npos ? "" : path.substr(dot);
  if (equal_ignoring_case(ending, ".stl")) return MeshFormat::stl_binary;
  if (equal_ignoring_case(ending, ".obj")) return MeshFormat::obj;
  if (equal_ignoring_case(ending, ".drc")) return MeshFormat::drc;
  return failure(ErrorKind::bad_input,
                 std::string(path).append(": expected a name that ends in .stl, .obj or .drc"));
}

Result<MeshFormat> mesh_format_named(std::string_view name) {
  for (const MeshFormat format : kMeshFormats)
    if (name_of(format) == name) return format;
  return failure(ErrorKind::bad_input,
                 std::string("expected the name of a mesh format, found ").append(name));
}

std::string_view name_of(MeshFormat format) noexcept {
  switch (format) {
    case MeshFormat::stl_binary:
      return "stl_binary";
    case MeshFormat::stl_ascii:
      return "stl_ascii";
    case MeshFormat::obj:
      return "obj";
    case MeshFormat::drc:
      return "drc";
  }
  return "unknown";
}

Result<TriangleMesh> decode_mesh(std::string_view bytes, MeshFormat format, std::string_view name,
                                 const ReadOptions& options) {
  switch (format) {
    case MeshFormat::stl_binary:
    case MeshFormat::stl_ascii:
      return decode_stl(bytes, name, options);
    case MeshFormat::obj:
      return decode_obj(bytes, name, options);
    case MeshFormat::drc:
      return decode_drc(bytes, name);
  }
  return failure(ErrorKind::bad_input, std::string(name).append(": unknown mesh format"));
}

TriangleMesh rounded_to_float(const TriangleMesh& mesh) {
  TriangleMesh rounded = mesh;
  for (glm::dvec3& point : rounded.points) point = file_point(point);
  return rounded;
}

}  // namespace clay::solid::inline formats
