#include "claystack/export/formats.hpp"
#include "claystack/export/mesh_estimate.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/byte_stream.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/format_marks.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/stl_layout.hpp"
#include "export/formats/text_scanner.hpp"
#include "export/solid/vertex_welder.hpp"

#include <array>

namespace clay::solid::inline formats {
namespace {

constexpr std::size_t kUsualTextFacetBytes = 260;

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
  StlTextReader(ByteStream& text, std::string_view name, const ReadOptions& options)
      : scanner_(text, name, LineRule::plain), name_(name), options_(options) {}

  Result<TriangleMesh> read() {
    while (read_solid()) {
    }
    if (scanner_.fault()) return tl::make_unexpected(*scanner_.fault());
    scanner_.note_not_finite(options_.notes);
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

  /// Returns false after "endsolid" or a fault, and for repairs at the end of the file.
  bool read_facet() {
    const std::string_view keyword = scanner_.word();
    if (equal_ignoring_case(keyword, "endsolid")) return false;
    if (keyword.empty() && !scanner_.fault() && !mesh_.triangles.empty()) return end_without_word();
    if (!equal_ignoring_case(keyword, "facet")) {
      scanner_.fail_expected("facet or endsolid", keyword);
      return false;
    }
    if (mesh_.triangles.size() == kMaxTriangles)
      scanner_.fail(expected_at_most(kMaxTriangles, "facets"));
    scanner_.expect("normal");
    for (int axis = 0; axis < 3; ++axis) scanner_.unused_number(scanner_.word());
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

  /// The file may have been cut off between two facets.
  bool end_without_word() {
    if (!options_.repair)
      scanner_.fail("expected facet or endsolid, found the end of the file; " +
                    std::string(kByRepair) + " reads the " +
                    counted(mesh_.triangles.size(), "facet") + " that are there");
    else if (options_.notes != nullptr)
      options_.notes->push_back("line " + std::to_string(scanner_.line()) +
                                ": the file ends without endsolid, so facets may be missing");
    return false;
  }

  void add(const Corners& corners) {
    auto& triangle = mesh_.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = welder_.index_of(corners[i]);
  }

  TextScanner scanner_;
  std::string_view name_;
  ReadOptions options_;
  TriangleMesh mesh_;
  VertexWelder welder_{mesh_.points, 0};
};

tl::unexpected<Error> wrong_size(std::uint64_t bytes, std::uint64_t facets, std::string_view name) {
  return bad_file(name, "expected " + std::to_string(stl::file_bytes(facets)) +
                            " bytes of binary STL for the " + std::to_string(facets) +
                            " facets it counts, found " + std::to_string(bytes) + " bytes");
}

/// Reads from the end of the prologue.
Result<TriangleMesh> read_facets(ByteStream& stream, std::size_t facets, std::string_view name) {
  TriangleMesh mesh = mesh_with_room_for(facets);
  VertexWelder welder(mesh.points, facets);
  for (std::size_t facet = 0; facet < facets; ++facet) {
    step_of_loop();
    if (!stream.fill(kFacetBytes)) {
      if (stream.fault()) return tl::make_unexpected(*stream.fault());
      return wrong_size(stl::file_bytes(facet) + stream.ahead().size(), facets, name);
    }
    const char* const at = stream.ahead().data();
    auto& triangle = mesh.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3 corner = stl::load_point(at + kPointBytes * (i + 1));
      if (const auto bad = find_bad_coordinate(corner)) {
        return bad_file(name, "facet " + std::to_string(facet + 1) + ": " + *bad);
      }
      triangle[i] = welder.index_of(corner);
    }
    stream.take(kFacetBytes);
  }
  return mesh;
}

Result<TriangleMesh> read_binary(const ByteSource& source, ByteStream& stream, std::size_t facets,
                                 std::string_view name) {
  stream.take(kPrologueBytes);
  return check_facet_count(facets, name)
      .and_then([&] { return source.announce ? source.announce(facets) : Result<void>(); })
      .and_then([&] { return read_facets(stream, facets, name); });
}

/// Certainly not a binary STL.
bool is_of_another_kind(std::string_view head) {
  return (!head.empty() && is_text(head)) ||
         (!begins_with_solid(head) && !known_kind(head).empty());
}

tl::unexpected<Error> no_stl(std::string_view head, std::uint64_t bytes, std::string_view name) {
  if (is_of_another_kind(head))
    return bad_file(name, "expected an STL file, found " + kind_of_file(head));
  if (head.size() < kPrologueBytes)
    return bad_file(name, "expected an STL file: the word solid, or at least 84 bytes, found " +
                              std::to_string(head.size()) + " bytes");
  auto wrong = wrong_size(bytes, load_u32(head.data() + kHeaderBytes), name);
  if (bytes >= stl::file_bytes(1))
    wrong.value().message +=
        std::string("; ").append(kByRepair).append(" reads the whole facets that are there");
  return wrong;
}

/// The whole facets of a file whose size and count disagree: at most as many as it counts, unless
/// only facets follow the prologue.
std::size_t facets_there(std::uint64_t bytes, std::uint64_t counted) {
  const std::uint64_t whole = (bytes - kPrologueBytes) / kFacetBytes;
  const bool only_facets = (bytes - kPrologueBytes) % kFacetBytes == 0;
  return static_cast<std::size_t>(only_facets || counted == 0 ? whole : std::min(whole, counted));
}

Result<TriangleMesh> read_either(const ByteSource& source, std::string_view name,
                                 const ReadOptions& options) {
  ByteStream stream(source);
  stream.fill(ByteStream::kStretch);
  if (stream.fault()) return tl::make_unexpected(*stream.fault());
  const std::string_view head = stream.ahead();
  const std::size_t facets =
      head.size() < kPrologueBytes ? 0 : load_u32(head.data() + kHeaderBytes);
  if (head.size() >= kPrologueBytes && source.size == stl::file_bytes(facets))
    return read_binary(source, stream, facets, name);
  if (!begins_with_solid(head) || (head.size() >= kPrologueBytes && !is_text(head))) {
    if (!options.repair || source.size < stl::file_bytes(1) || is_of_another_kind(head))
      return no_stl(head, source.size, name);
    const std::size_t there = facets_there(source.size, facets);
    if (options.notes != nullptr)
      options.notes->push_back("the file counts " + std::to_string(facets) + " facets; its " +
                               std::to_string(source.size) + " bytes hold " +
                               std::to_string(there) + ", which were read");
    return read_binary(source, stream, there, name);
  }
  return check_text_size(source, kUsualTextFacetBytes, name).and_then([&] {
    return StlTextReader(stream, name, options).read();
  });
}

}  // namespace

std::optional<FacetCount> missing_facets(std::string_view head, std::uint64_t size) {
  static_assert(kStlPrologueBytes == kPrologueBytes);
  if (head.size() < kPrologueBytes || is_of_another_kind(head.substr(0, kPrologueBytes)))
    return std::nullopt;
  const std::uint64_t facets = load_u32(head.data() + kHeaderBytes);
  // A larger count is damage to the count, and says nothing about the facets.
  if (facets > kMaxTriangles || size >= stl::file_bytes(facets)) return std::nullopt;
  return FacetCount{facets, facets_there(size, facets)};
}

std::string encode_stl_binary(const TriangleMesh& mesh) {
  const std::vector<glm::vec3> points = file_points(mesh.points);
  std::string bytes(stl::file_bytes(mesh.triangles.size()), '\0');
  stl::store_prologue(bytes.data(), mesh.triangles.size());
  char* at = bytes.data() + kPrologueBytes;
  for (const auto& triangle : mesh.triangles) {
    step_of_loop();
    stl::store_facet(at, corners_of(triangle, points));
    at += kFacetBytes;
  }
  return bytes;
}

std::string encode_stl_ascii(const TriangleMesh& mesh, std::string_view solid_name) {
  const std::vector<glm::vec3> points = file_points(mesh.points);
  const std::string solid = "solid " + one_line(solid_name) + '\n';
  std::string text;
  text.reserve(2 * solid.size() + kUsualTextFacetBytes * mesh.triangles.size());
  text += solid;
  for (const auto& triangle : mesh.triangles) {
    step_of_loop();
    const Corners corners = corners_of(triangle, points);
    append_point_line(text, "facet normal", stl::facet_normal(corners));
    text += "  outer loop\n";
    for (const glm::vec3& corner : corners) append_point_line(text, "    vertex", corner);
    text += "  endloop\nendfacet\n";
  }
  return text.append("end").append(solid);
}

Result<TriangleMesh> read_stl(const ByteSource& source, std::string_view name,
                              const ReadOptions& options) {
  return guarded(name, [&] { return read_either(source, name, options); });
}

Result<TriangleMesh> decode_stl(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return check_file_size(bytes, name).and_then([&] {
    return read_stl(source_of(bytes), name, options);
  });
}

}  // namespace clay::solid::inline formats
