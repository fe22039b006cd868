#pragma once
// The guarantee of every reader for arbitrary bytes, and initial files.

#include "claystack/export/formats.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid::samples {

/// Empty if the guarantee holds: an error with a message that names the file, or a mesh of finite
/// points within 1e6 mm and indices in range.
inline std::optional<std::string> broken_promise(std::string_view bytes, MeshFormat format) {
  const auto mesh = decode_mesh(bytes, format, "fuzzed");
  if (!mesh) {
    const bool named = mesh.error().message.starts_with("fuzzed:");
    return named ? std::nullopt : std::optional("unnamed error: " + mesh.error().message);
  }
  if (mesh->triangles.empty()) return "a mesh of nothing";
  for (const glm::dvec3& point : mesh->points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(point[axis]) <= 1e6)) return "a point out of range";
    }
  }
  for (const auto& triangle : mesh->triangles) {
    for (const std::uint32_t index : triangle) {
      if (index >= mesh->points.size()) return "an index out of range";
    }
  }
  return std::nullopt;
}

/// Small valid files of a format: their mutations reach deeper code than random bytes.
inline std::vector<std::string> good_files(MeshFormat format) {
  std::vector<std::string> files;
  const DracoClaims claims{.volume_mm3 = 1.0, .vertex_error_mm = 0.01};
  const std::vector<std::pair<std::string, std::string>> notes{{"process", "sla"}};
  for (const TriangleMesh& mesh : {tetrahedron(), torus(4, 3)}) {
    const std::vector<float> walls(mesh.points.size(), 3.0F);
    switch (format) {
      case MeshFormat::stl_binary:
        files.push_back(encode_stl_binary(mesh));
        break;
      case MeshFormat::stl_ascii:
        files.push_back(encode_stl_ascii(mesh, "pot"));
        break;
      case MeshFormat::obj:
        files.push_back(encode_obj(mesh, "pot"));
        break;
      case MeshFormat::drc:
        for (const int speed : {0, 5, 10}) {
          files.push_back(encode_drc(mesh, {.speed = speed}).value_or(std::string()));
        }
        files.push_back(encode_drc(mesh, {}, &claims).value_or(std::string()));
        break;
      case MeshFormat::ply:
        files.push_back(encode_ply(mesh, "pot", walls));
        break;
      case MeshFormat::off:
        break;
      case MeshFormat::glb:
        for (const GlbMesh glb : {GlbMesh::draco, GlbMesh::meshopt, GlbMesh::core})
          files.push_back(encode_glb(mesh, {.wall_mm = walls, .glb = glb, .notes = notes})
                              .value_or(std::string()));
        break;
      case MeshFormat::three_mf:
      case MeshFormat::three_mf_model: {
        const FileContents contents{
            .wall_mm = walls, .notes = notes, .pot = "pot", .certificate = "{}"};
        const ModelPart model = encode_3mf_model(mesh, contents);
        files.push_back(format == MeshFormat::three_mf_model
                            ? model.xml
                            : pack_3mf(model, contents).value_or(std::string()));
        break;
      }
    }
  }
  if (format == MeshFormat::obj) {
    files.emplace_back(
        "v 0 0 0 1\nv 1 0 0 1 1 1\nv 0 1 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\ng a\\\nb\n"
        "s 1\nusemtl c\nmtllib d\nf 1/1/1 2/1/1 4/1/1 3/1/1\nf -1//-1 -2 -3/1\n");
  }
  const std::string points = "0 0 0 1\n1 0 0 1\n1 1 0 1\n0 1 0 1\n", faces = "4 0 1 2 3\n3 2 1 0\n";
  if (format == MeshFormat::ply)
    for (const char* encoding : {"ascii", "binary_big_endian"})
      files.push_back(std::string("ply\nformat ") + encoding +
                      " 1.0\nelement vertex 4\nproperty char x\nproperty char y\n"
                      "property char z\nproperty char v\nelement face 2\n"
                      "property list char uint8 vertex_index\nelement edge 1\n"
                      "property list uchar float parts\nend_header\n" +
                      (encoding[0] == 'a' ? points + faces + "2 0 1\n"
                                          : std::string("\0\0\0\1\1\0\0\1\1\1\0\1\0\1\0\1\4\0\1"
                                                        "\2\3\3\2\1\0\1\0\0\0\0",
                                                        30)));
  if (format == MeshFormat::off) {
    files.push_back("OFF\n4 2 0\n" + points + faces);
    files.push_back("STCOFF # comment\n4 2 5\n" + points + "4 0 1 2 3 255 0 0\n3 2 1 0 0.5\n");
  }
  return files;
}

}  // namespace clay::solid::samples
