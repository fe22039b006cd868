#include "cancel.hpp"
#include "claystack/export/mesh_formats.hpp"
#include "describe.hpp"
#include "file_floats.hpp"
#include "mesh_limits.hpp"
#include "stl_layout.hpp"
#include "text_scanner.hpp"
#include "vertex_welder.hpp"

#include <array>

namespace clay::solid {
namespace {

using stl::Corners;
using stl::kFacetBytes;
using stl::kHeaderBytes;
using stl::kPointBytes;
using stl::kPrologueBytes;

Corners corners_of(const std::array<std::uint32_t, 3>& triangle,
                   const std::vector<glm::vec3>& points) noexcept {
  return {points[triangle[0]], points[triangle[1]], points[triangle[2]]};
}

/// A closed mesh has half as many points as triangles.
TriangleMesh mesh_with_room_for(std::size_t facets) {
  TriangleMesh mesh;
  mesh.triangles.reserve(facets);
  mesh.points.reserve(facets / 2 + 3);
  return mesh;
}

class StlTextReader {
 public:
  StlTextReader(std::string_view text, std::string_view name)
      : scanner_(text, name, LineRule::plain), name_(name) {}

  Result<TriangleMesh> read() {
    while (read_solid()) {
    }
    if (scanner_.fault()) return tl::make_unexpected(*scanner_.fault());
    return check_facet_count(mesh_.triangles.size(), name_).map([&] { return std::move(mesh_); });
  }

 private:
  bool read_solid() {
    const std::string_view keyword = scanner_.word();
    if (keyword.empty()) return false;
    if (!equal_ignoring_case(keyword, "solid")) scanner_.fail_expected("solid", keyword);
    scanner_.skip_line();
    while (read_facet()) {
    }
    scanner_.skip_line();
    return !scanner_.fault();
  }

  /// False after "endsolid" or a fault.
  bool read_facet() {
    const std::string_view keyword = scanner_.word();
    if (equal_ignoring_case(keyword, "endsolid")) return false;
    if (!equal_ignoring_case(keyword, "facet")) {
      scanner_.fail_expected("facet or endsolid", keyword);
      return false;
    }
    if (mesh_.triangles.size() == kMaxTriangles) scanner_.fail("expected at most 20000000 facets");
    scanner_.expect("normal");
    for (int axis = 0; axis < 3; ++axis) scanner_.finite_number(scanner_.word());
    scanner_.expect("outer");
    scanner_.expect("loop");
    Corners corners;
    for (glm::vec3& corner : corners) {
      scanner_.expect("vertex");
      for (int axis = 0; axis < 3; ++axis) corner[axis] = scanner_.coordinate(scanner_.word());
    }
    scanner_.expect("endloop");
    scanner_.expect("endfacet");
    if (scanner_.fault()) return false;
    add(corners);
    return true;
  }

  void add(const Corners& corners) {
    auto& triangle = mesh_.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = welder_.index_of(corners[i]);
  }

  TextScanner scanner_;
  std::string_view name_;
  TriangleMesh mesh_;
  VertexWelder welder_{mesh_.points, 0};
};

Result<TriangleMesh> decode_binary(std::string_view bytes, std::size_t facets,
                                   std::string_view name) {
  if (auto fits = check_facet_count(facets, name); !fits) return tl::make_unexpected(fits.error());
  TriangleMesh mesh = mesh_with_room_for(facets);
  VertexWelder welder(mesh.points, facets);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    step_of_loop();
    const char* const at = bytes.data() + stl::file_bytes(facet);
    auto& triangle = mesh.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3 corner = stl::load_point(at + kPointBytes * (i + 1));
      if (const auto bad = find_bad_coordinate(corner)) {
        return bad_file(name, "facet " + std::to_string(facet + 1) + ": " + *bad);
      }
      triangle[i] = welder.index_of(corner);
    }
  }
  return mesh;
}

bool begins_with_solid(std::string_view bytes) {
  bytes = without_byte_order_mark(bytes);
  const std::size_t begin = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  return equal_ignoring_case(bytes.substr(begin, 5), "solid");
}

tl::unexpected<Error> wrong_size(std::string_view bytes, std::string_view name) {
  if (const auto kind = known_kind(bytes); !kind.empty())
    return bad_file(name, std::string("expected an STL file, found ").append(kind));
  const std::string found = ", found " + std::to_string(bytes.size()) + " bytes";
  if (bytes.size() < kPrologueBytes) {
    return bad_file(name, "expected an STL file: the word solid, or at least 84 bytes" + found);
  }
  const std::size_t facets = load_u32(bytes.data() + kHeaderBytes);
  return bad_file(name, "expected " + std::to_string(stl::file_bytes(facets)) +
                            " bytes of binary STL for the " + std::to_string(facets) +
                            " facets it counts" + found);
}

Result<TriangleMesh> decode_either(std::string_view bytes, std::string_view name) {
  if (bytes.size() >= kPrologueBytes) {
    const std::size_t facets = load_u32(bytes.data() + kHeaderBytes);
    if (bytes.size() == stl::file_bytes(facets)) return decode_binary(bytes, facets, name);
  }
  if (!begins_with_solid(bytes)) return wrong_size(bytes, name);
  return StlTextReader(bytes, name).read();
}

}  // namespace

std::string encode_stl_binary(const TriangleMesh& mesh) {
  const std::vector<glm::vec3> points = file_points(mesh.points);
  std::string bytes(stl::file_bytes(mesh.triangles.size()), '\0');
  stl::store_prologue(bytes.data(), mesh.triangles.size());
  char* at = bytes.data() + kPrologueBytes;
  for (const auto& triangle : mesh.triangles) {
    stl::store_facet(at, corners_of(triangle, points));
    at += kFacetBytes;
  }
  return bytes;
}

std::string encode_stl_ascii(const TriangleMesh& mesh, std::string_view solid_name) {
  constexpr std::size_t kUsualFacetBytes = 260;
  const std::vector<glm::vec3> points = file_points(mesh.points);
  const std::string solid = "solid " + one_line(solid_name) + '\n';
  std::string text;
  text.reserve(2 * solid.size() + kUsualFacetBytes * mesh.triangles.size());
  text += solid;
  for (const auto& triangle : mesh.triangles) {
    const Corners corners = corners_of(triangle, points);
    append_point_line(text, "facet normal", stl::facet_normal(corners));
    text += "  outer loop\n";
    for (const glm::vec3& corner : corners) append_point_line(text, "    vertex", corner);
    text += "  endloop\nendfacet\n";
  }
  return text.append("end").append(solid);
}

Result<TriangleMesh> decode_stl(std::string_view bytes, std::string_view name) {
  return guarded(name, [&] {
    return check_file_size(bytes, name).and_then([&] { return decode_either(bytes, name); });
  });
}

}  // namespace clay::solid
