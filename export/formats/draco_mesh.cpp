#include "export/formats/draco_mesh.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"

#include <array>

namespace clay::solid::inline formats {
namespace {

/// Checks the attribute before reading any value.
Result<const draco::PointAttribute*> positions_of(const draco::Mesh& mesh, std::string_view name) {
  const draco::PointAttribute* const positions =
      mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  if (positions == nullptr) return bad_file(name, "expected a position attribute, found none");
  if (positions->num_components() != 3 || positions->data_type() != draco::DT_FLOAT32) {
    return bad_file(name, "expected positions of 3 float32");
  }
  const auto stride = static_cast<std::size_t>(positions->byte_stride());
  const auto offset = static_cast<std::size_t>(positions->byte_offset());
  const bool whole = stride == sizeof(glm::vec3) && positions->buffer() != nullptr &&
                     offset + stride * positions->size() <= positions->buffer()->data_size();
  const bool mapped =
      positions->is_mapping_identity() || positions->indices_map_size() >= mesh.num_points();
  if (!whole || !mapped) return bad_file(name, "the position attribute is not whole");
  return positions;
}

Result<void> append_points(const draco::PointAttribute& positions, std::string_view name,
                           std::vector<glm::dvec3>& points) {
  points.reserve(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    glm::vec3 point;
    positions.GetValue(draco::AttributeValueIndex(i), &point);
    if (const auto bad = find_bad_coordinate(point)) {
      return bad_file(name, "position " + std::to_string(i + 1) + ": " + *bad);
    }
    points.emplace_back(point + 0.0F);  // -0 + 0 is 0
  }
  return {};
}

tl::unexpected<Error> bad_face(std::string_view name, std::size_t face, std::size_t count,
                               std::string_view noun, std::uint32_t found) {
  return bad_file(name, "face " + std::to_string(face + 1) + ": " +
                            expected_number(noun, 0, count) + ", found " + std::to_string(found));
}

Result<void> append_triangles(const draco::Mesh& mesh, const draco::PointAttribute& positions,
                              std::string_view name,
                              std::vector<std::array<std::uint32_t, 3>>& triangles) {
  triangles.reserve(mesh.num_faces());
  for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
    step_of_loop();
    auto& triangle = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const draco::PointIndex point = mesh.face(draco::FaceIndex(face))[i];
      if (point.value() >= mesh.num_points()) {
        return bad_face(name, face, mesh.num_points(), "a point", point.value());
      }
      triangle[i] = positions.mapped_index(point).value();
      if (triangle[i] >= positions.size()) {
        return bad_face(name, face, positions.size(), "a position", triangle[i]);
      }
    }
  }
  return {};
}

}  // namespace

std::unique_ptr<draco::Mesh> to_draco(const TriangleMesh& mesh,
                                      const std::vector<glm::vec3>& points,
                                      std::span<const std::array<std::uint16_t, 4>> colours) {
  auto result = std::make_unique<draco::Mesh>();
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
              sizeof(glm::vec3), 0);
  const auto count = static_cast<std::uint32_t>(points.size());
  result->set_num_points(count);
  const int id = result->AddAttribute(layout, true, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    step_of_loop();
    result->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &points[i]);
  }
  if (!colours.empty()) {
    layout.Init(draco::GeometryAttribute::COLOR, nullptr, 4, draco::DT_UINT16, true,
                sizeof colours[0], 0);
    const int coloured = result->AddAttribute(layout, true, count);
    for (std::uint32_t i = 0; i < count; ++i)
      result->attribute(coloured)->SetAttributeValue(draco::AttributeValueIndex(i), &colours[i]);
  }
  result->SetNumFaces(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    step_of_loop();
    const auto& [a, b, c] = mesh.triangles[i];
    result->SetFace(draco::FaceIndex(i),
                    {draco::PointIndex(a), draco::PointIndex(b), draco::PointIndex(c)});
  }
  return result;
}

Result<TriangleMesh> from_draco(const draco::Mesh& mesh, std::string_view name) {
  TriangleMesh result;
  return check_facet_count(mesh.num_faces(), name)
      .and_then([&] { return positions_of(mesh, name); })
      .and_then([&](const draco::PointAttribute* positions) {
        return append_points(*positions, name, result.points).and_then([&] {
          return append_triangles(mesh, *positions, name, result.triangles);
        });
      })
      .map([&] { return std::move(result); });
}

}  // namespace clay::solid::inline formats
