#include "export/formats/glb.hpp"
#include "export/formats/glb_packed.hpp"

#include "core/cancel.hpp"
#include "export/formats/mesh_limits.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace clay::solid::inline formats::glb {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF and the codec are little-endian");

using Words = std::vector<std::uint32_t>;
using Cell = std::array<std::uint16_t, 4>;  // three coordinates and padding

/// A vertex at `origin + step * cell` [m]. Both are float32, so that decoders agree.
struct Grid {
  glm::dvec3 origin{0.0};
  double step = 0.0;
};

/// The coarsest grid within the error, of at least 2^min_bits cells across; empty: 16 bits are too
/// few.
std::optional<Grid> grid_for(const Bounds& bounds, double error, int min_bits) {
  const glm::dvec3 low(bounds.low), high(bounds.high);
  const glm::dvec3 size = high - low;
  const double side = std::max({size.x, size.y, size.z});
  const double widest =
      std::min(2.0 * error / std::numbers::sqrt3, side / (std::exp2(min_bits) - 1.0));
  const double step = double{std::nextafter(static_cast<float>(widest), 0.0F)};
  if (!(step > 0.0)) return std::nullopt;
  Grid grid{{}, step};
  for (int axis = 0; axis < 3; ++axis) {
    // A multiple of the step: the axis of the pot is on the grid.
    grid.origin[axis] = double{static_cast<float>(step * std::floor(low[axis] / step)) + 0.0F};
    const double cells = std::round((high[axis] - grid.origin[axis]) / step);
    if (cells > double{std::numeric_limits<std::uint16_t>::max()}) return std::nullopt;
  }
  return grid;
}

std::vector<Cell> cells_of(const TriangleMesh& metres, const Grid& grid) {
  std::vector<Cell> cells;
  cells.reserve(metres.points.size());
  for (const glm::dvec3& point : metres.points) {
    const glm::dvec3 at = glm::max(glm::round((point - grid.origin) / grid.step), 0.0);
    cells.push_back({static_cast<std::uint16_t>(at.x), static_cast<std::uint16_t>(at.y),
                     static_cast<std::uint16_t>(at.z), 0});
  }
  return cells;
}

/// Vertices of any kind, `stride` bytes each.
struct Vertices {
  std::string bytes;
  std::size_t stride = 0;
};
template <class Vertex>
Vertices vertices_of(std::span<const Vertex> all) {
  return {std::string(reinterpret_cast<const char*>(all.data()), all.size_bytes()), sizeof(Vertex)};
}

struct Streams {
  std::string indices;
  std::vector<std::string> vertices;
  [[nodiscard]] std::size_t size() const {
    std::size_t sum = indices.size();
    for (const std::string& stream : vertices) sum += stream.size();
    return sum;
  }
};

std::string encoded_indices(const Words& indices, std::size_t points) {
  // The version that the extension requires, for all threads.
  static const bool kVersion =
      (meshopt_encodeIndexVersion(1), meshopt_encodeVertexVersion(0), true);
  (void)kVersion;
  std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), points), '\0');
  bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                         bytes.size(), indices.data(), indices.size()));
  return bytes;
}

std::string encoded_vertices(const Vertices& vertices, const Words& place) {
  const std::size_t count = place.size();
  std::string moved(vertices.bytes.size(), '\0');
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(moved.data() + place[i] * vertices.stride,
                vertices.bytes.data() + i * vertices.stride, vertices.stride);
  std::string bytes(meshopt_encodeVertexBufferBound(count, vertices.stride), '\0');
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                          bytes.size(), moved.data(), count, vertices.stride));
  return bytes;
}

/// With the triangles in this order, and vertices in the order of their use.
Streams encoded(Words indices, std::size_t points, const std::vector<Vertices>& vertices) {
  stop_if_cancelled();
  Words place(points);
  meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(), points);
  for (std::uint32_t& index : indices) index = place[index];
  Streams streams{encoded_indices(indices, points), {}};
  for (const Vertices& kind : vertices) streams.vertices.push_back(encoded_vertices(kind, place));
  return streams;
}

/// The smaller of two orders: strips that follow each other over the surface, and the mesh's own.
Streams smallest(const TriangleMesh& metres, const std::vector<Vertices>& vertices) {
  Words own;
  own.reserve(3 * metres.triangles.size());
  for (const auto& triangle : metres.triangles)
    own.insert(own.end(), triangle.begin(), triangle.end());
  const std::size_t points = metres.points.size();
  Words strips(own.size());
  meshopt_optimizeVertexCacheStrip(strips.data(), own.data(), own.size(), points);
  Streams best = encoded(std::move(strips), points, vertices);
  Streams other = encoded(std::move(own), points, vertices);
  return other.size() < best.size() ? other : best;
}

/// Checks that every point is used: the codec orders vertices by their use.
Result<void> check(const TriangleMesh& metres) {
  std::vector<bool> used(metres.points.size(), false);
  for (const auto& triangle : metres.triangles)
    for (const std::uint32_t point : triangle) used[point] = true;
  if (metres.triangles.empty() || std::ranges::find(used, false) != used.end())
    return failure(ErrorKind::unsound,
                   "cannot write .glb: expected a triangle at every point of the mesh");
  return {};
}

/// Views of compressed streams; their unpacked bytes are in no buffer.
class Views {
 public:
  explicit Views(Packed& packed) : packed_(packed) {}

  std::size_t add(std::string_view stream, std::string_view mode, std::size_t count,
                  std::size_t stride) {
    constexpr auto kBuffer = 1;
    OrderedJson compressed = {{"buffer", 0}};
    packed_.bytes.resize((packed_.bytes.size() + 3) / 4 * 4, '\0');
    if (!packed_.bytes.empty()) compressed["byteOffset"] = packed_.bytes.size();
    compressed["byteLength"] = stream.size();
    compressed["byteStride"] = stride;
    compressed["mode"] = mode;
    compressed["count"] = count;
    packed_.bytes += stream;
    const bool vertices = mode == "ATTRIBUTES";
    packed_.unpacked_bytes = (packed_.unpacked_bytes + 3) / 4 * 4;
    OrderedJson view = {{"buffer", kBuffer},
                        {"byteOffset", packed_.unpacked_bytes},
                        {"byteLength", count * stride}};
    if (vertices) view["byteStride"] = stride;
    view["target"] = vertices ? kVertexTarget : kIndexTarget;
    view["extensions"][kMeshopt] = std::move(compressed);
    packed_.unpacked_bytes += count * stride;
    packed_.views.push_back(std::move(view));
    return packed_.views.size() - 1;
  }

 private:
  Packed& packed_;
};

/// Bounds in the numbers of the file.
Bounds stored_bounds(const std::vector<Cell>& cells) {
  std::vector<glm::vec3> points;
  points.reserve(cells.size());
  for (const Cell& cell : cells) points.emplace_back(cell[0], cell[1], cell[2]);
  return bounds_of(points);
}

OrderedJson corner_accessor(Views& views, const Streams& streams, std::size_t points,
                            std::size_t corners) {
  const bool small = points < 65535;  // 65535 restarts a strip
  return {{"bufferView", views.add(streams.indices, "TRIANGLES", corners, small ? 2 : 4)},
          {"componentType", small ? kUint16 : kUint32},
          {"count", corners},
          {"type", "SCALAR"}};
}

OrderedJson colour_accessor(Views& views, const Streams& streams, std::size_t points) {
  return {{"bufferView", views.add(streams.vertices[1], "ATTRIBUTES", points, sizeof(Colour16))},
          {"componentType", kUint16},
          {"normalized", true},
          {"count", points},
          {"type", "VEC4"}};
}

OrderedJson whole_numbers(const glm::vec3& v) {
  return {static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)};
}

}  // namespace

Result<Packed> packed_by_meshopt(const TriangleMesh& metres, std::span<const Colour16> colours,
                                 const DracoSettings& settings) {
  if (auto good = check(metres); !good) return tl::make_unexpected(good.error());
  // Three as for every GLB, and the product and the sum of a decoder.
  constexpr double kRoundings = 5.0;
  const auto error = error_left(metres, settings.max_error_mm, kRoundings);
  if (!error) return tl::make_unexpected(error.error());
  const std::vector<glm::vec3> points(metres.points.begin(), metres.points.end());
  const std::optional<Grid> grid = grid_for(bounds_of(points), *error, settings.min_bits);
  const std::vector<Cell> cells = grid ? cells_of(metres, *grid) : std::vector<Cell>();
  std::vector<Vertices> vertices{grid ? vertices_of(std::span(cells))
                                      : vertices_of(std::span(points))};
  if (!colours.empty()) vertices.push_back(vertices_of(colours));
  const Streams streams = smallest(metres, vertices);

  Packed packed;
  packed.extensions = {kMeshopt};
  if (grid) {
    packed.extensions.push_back(kQuantization);
    packed.node = {{"translation", {grid->origin.x, grid->origin.y, grid->origin.z}},
                   {"scale", {grid->step, grid->step, grid->step}}};
  }
  Views views(packed);
  const std::size_t count = points.size();
  const Bounds bounds = grid ? stored_bounds(cells) : bounds_of(points);
  packed.accessors.push_back(
      {{"bufferView", views.add(streams.vertices[0], "ATTRIBUTES", count, vertices[0].stride)},
       {"componentType", grid ? kUint16 : kFloat32},
       {"count", count},
       {"type", "VEC3"},
       {"min", grid ? whole_numbers(bounds.low) : numbers(bounds.low)},
       {"max", grid ? whole_numbers(bounds.high) : numbers(bounds.high)}});
  packed.accessors.push_back(corner_accessor(views, streams, count, 3 * metres.triangles.size()));
  if (!colours.empty()) packed.accessors.push_back(colour_accessor(views, streams, count));
  return packed;
}

}  // namespace clay::solid::inline formats::glb
