#pragma once
// The meshes of a GLB, each read once: in metres and y up, without the transforms of its nodes.

#include "claystack/export/formats.hpp"
#include "export/formats/glb_buffers.hpp"
#include "export/formats/glb_json.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats::glb {

/// The error of the reader of a compressed mesh within the file.
struct BadStream {
  Error error;
};

/// Every function throws BadGlb or BadStream.
class Meshes {
 public:
  /// All outlive this.
  Meshes(const Json& json, std::string_view binary, std::string_view name)
      : json_(json), buffers_(json, binary), name_(name) {}

  /// A mesh by its number.
  const TriangleMesh& read(std::size_t index);
  /// Triangles by the accessors, and by the headers of Draco's meshes, before they are read.
  [[nodiscard]] std::uint64_t stated_triangles(std::size_t index) const;

  /// Of all meshes read.
  [[nodiscard]] std::uint64_t triangles() const noexcept { return triangles_; }
  [[nodiscard]] std::uint64_t points() const noexcept { return points_; }
  /// Primitives of points or lines, which are not read.
  [[nodiscard]] std::size_t without_surface() const noexcept { return without_surface_; }

 private:
  [[nodiscard]] const Json& primitives_of(std::size_t mesh) const;
  [[nodiscard]] std::uint64_t stated_triangles_of(const Json& primitive) const;
  void expect_room(std::size_t points, std::size_t triangles);
  void add_primitive(const Json& primitive, TriangleMesh& mesh);
  void add_triangles(const std::vector<std::uint32_t>& c, std::size_t mode, std::uint32_t first,
                     TriangleMesh& mesh);
  void add_draco(const Json& draco, TriangleMesh& mesh);
  void add_points(std::size_t index, std::vector<glm::dvec3>& points);
  [[nodiscard]] std::vector<std::uint32_t> indices_of(std::size_t index, std::uint32_t points);

  const Json& json_;
  Buffers buffers_;
  std::string_view name_;
  std::map<std::size_t, TriangleMesh> meshes_;
  std::uint64_t triangles_ = 0, points_ = 0;
  std::size_t without_surface_ = 0;
};

}  // namespace clay::solid::inline formats::glb
