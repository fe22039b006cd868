#include "export/formats/glb_meshes.hpp"

#include "core/cancel.hpp"
#include "core/little_endian.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/stated_sizes.hpp"

#include <algorithm>
#include <string>

namespace clay::solid::inline formats::glb {
namespace {

/// Storage of a coordinate.
struct Component {
  std::size_t size = 0;  ///< bytes; 0: not a type of coordinates
  double most = 0.0;     ///< number that stands for 1, if normalised; 0: none
  double (*read)(const char* at) = nullptr;
};

template <class Whole>
double whole_at(const char* at) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < sizeof(Whole); ++i)
    bits |= std::uint32_t{static_cast<unsigned char>(at[i])} << 8U * i;
  return static_cast<double>(static_cast<Whole>(bits));
}

double float_at(const char* at) { return double{load_f32(at)}; }

Component component_of(std::size_t type) {
  switch (std::min<std::size_t>(type, 0xFFFF)) {
    case kInt8:
      return {1, 127.0, whole_at<std::int8_t>};
    case kUint8:
      return {1, 255.0, whole_at<std::uint8_t>};
    case kInt16:
      return {2, 32767.0, whole_at<std::int16_t>};
    case kUint16:
      return {2, 65535.0, whole_at<std::uint16_t>};
    case kFloat32:
      return {4, 0.0, float_at};
    default:
      return {};
  }
}

std::size_t triangles_of(std::size_t corners, std::size_t mode) {
  return corners < 3 ? 0 : (corners - 3) / (mode == kTriangles ? 3 : 1) + 1;
}

/// The Draco extension of a primitive, or null.
const Json* draco_in(const Json& primitive) {
  const auto extensions = primitive.find("extensions");
  if (extensions == primitive.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(kDraco);
  return found == extensions->end() ? nullptr : &*found;
}

}  // namespace

const TriangleMesh& Meshes::read(std::size_t index) {
  const auto [found, is_new] = meshes_.try_emplace(index);
  if (is_new)
    for (const Json& primitive : primitives_of(index)) add_primitive(primitive, found->second);
  return found->second;
}

std::uint64_t Meshes::stated_triangles(std::size_t index) const {
  std::uint64_t triangles = 0;
  for (const Json& primitive : primitives_of(index)) triangles += stated_triangles_of(primitive);
  return triangles;
}

/// Objects.
const Json& Meshes::primitives_of(std::size_t mesh) const {
  const Json& json = object_at(json_, "meshes", mesh);
  const auto primitives = json.find("primitives");
  if (primitives == json.end() || !primitives->is_array())
    throw BadGlb("primitives: expected a list");
  for (std::size_t i = 0; i < primitives->size(); ++i) (void)object_at(json, "primitives", i);
  return *primitives;
}

std::uint64_t Meshes::stated_triangles_of(const Json& primitive) const {
  const std::size_t mode = count_in(primitive, "mode", kTriangles);
  if (mode < kTriangles) return 0;
  if (const Json* const draco = draco_in(primitive)) {
    return drc_triangles(buffers_.stored_view(count_in(*draco, "bufferView")), name_).value_or(0);
  }
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end()) return 0;
  const std::size_t accessor = primitive.contains("indices") ? count_in(primitive, "indices")
                                                             : count_in(*attributes, "POSITION");
  const std::size_t corners = count_in(object_at(json_, "accessors", accessor), "count");
  return std::min(triangles_of(corners, mode), kMaxTriangles + 1);
}

/// Counts triangles and points of the file, before they take memory.
void Meshes::expect_room(std::size_t points, std::size_t triangles) {
  points_ += points;
  triangles_ += triangles;
  if (triangles_ > kMaxTriangles) throw BadGlb(expected_at_most(kMaxTriangles, "triangles"));
  if (points_ > kMaxPoints) throw BadGlb(expected_at_most(kMaxPoints, "vertices"));
}

void Meshes::add_primitive(const Json& primitive, TriangleMesh& mesh) {
  const std::size_t mode = count_in(primitive, "mode", kTriangles);
  if (mode < kTriangles) return void(++without_surface_);
  if (mode > kTriangleFan) throw BadGlb("mode: expected 0 to 6, found " + std::to_string(mode));
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object())
    throw BadGlb("attributes: expected an object");
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  if (const Json* const draco = draco_in(primitive)) return add_draco(*draco, mesh);
  add_points(count_in(*attributes, "POSITION"), mesh.points);
  const auto count = static_cast<std::uint32_t>(mesh.points.size() - first);
  std::vector<std::uint32_t> corners;
  if (primitive.contains("indices")) {
    corners = indices_of(count_in(primitive, "indices"), count);
  } else {
    corners.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) corners[i] = i;
  }
  add_triangles(corners, mode, first, mesh);
}

void Meshes::add_triangles(const std::vector<std::uint32_t>& c, std::size_t mode,
                           std::uint32_t first, TriangleMesh& mesh) {
  if (mode == kTriangles && c.size() % 3 != 0)
    throw BadGlb("expected 3 corners for each triangle, found " + std::to_string(c.size()));
  const std::size_t step = mode == kTriangles ? 3 : 1;
  expect_room(0, triangles_of(c.size(), mode));
  for (std::size_t i = 0; i + 2 < c.size(); i += step) {
    step_of_loop();
    const std::size_t odd = mode == kTriangleStrip ? i % 2 : 0;
    mesh.triangles.push_back(
        {first + c[mode == kTriangleFan ? 0 : i], first + c[i + 1 + odd], first + c[i + 2 - odd]});
  }
}

void Meshes::add_draco(const Json& draco, TriangleMesh& mesh) {
  if (!draco.is_object()) throw BadGlb(std::string(kDraco) + ": expected an object");
  const std::string_view bytes = buffers_.view(count_in(draco, "bufferView"));
  auto decoded = decode_drc(bytes, name_);
  if (!decoded) throw BadStream{decoded.error()};
  expect_room(decoded->points.size(), decoded->triangles.size());
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), decoded->points.begin(), decoded->points.end());
  for (const auto& [a, b, c] : decoded->triangles)
    mesh.triangles.push_back({first + a, first + b, first + c});
}

/// Whole numbers are values or, if normalised, fractions of the largest number.
void Meshes::add_points(std::size_t index, std::vector<glm::dvec3>& points) {
  const Json& accessor = object_at(json_, "accessors", index);
  const Component component = component_of(count_in(accessor, "componentType"));
  const bool normalized = accessor.value("normalized", false);
  if (component.size == 0 || accessor.value("type", "") != "VEC3" ||
      (normalized && component.most == 0.0))
    throw BadGlb("POSITION: expected 3 float32, or whole numbers of 8 or 16 bits");
  const Values found = buffers_.values(accessor, 3 * component.size);
  expect_room(found.count, 0);
  for (std::size_t i = 0; i < found.count; ++i) {
    step_of_loop();
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const double value =
          component.read(found.at(i) + static_cast<std::size_t>(axis) * component.size);
      point[axis] = normalized ? std::max(value / component.most, -1.0) : value;
    }
    if (const auto bad = find_bad_coordinate(glm::vec3(point)))
      throw BadGlb("position " + std::to_string(i + 1) + ": " + *bad);
    points.emplace_back(point);
  }
}

std::vector<std::uint32_t> Meshes::indices_of(std::size_t index, std::uint32_t points) {
  const Json& accessor = object_at(json_, "accessors", index);
  const std::size_t type = count_in(accessor, "componentType");
  const std::size_t size = type == kUint8 ? 1 : type == kUint16 ? 2 : type == kUint32 ? 4 : 0;
  if (size == 0 || accessor.value("type", "") != "SCALAR")
    throw BadGlb("indices: expected whole numbers of 8, 16 or 32 bits");
  const Values found = buffers_.values(accessor, size);
  if (found.count > 3 * kMaxTriangles) throw BadGlb(expected_at_most(kMaxTriangles, "triangles"));
  std::vector<std::uint32_t> corners(found.count);
  for (std::size_t i = 0; i < found.count; ++i) {
    step_of_loop();
    char bytes[4] = {};
    std::copy_n(found.at(i), size, bytes);
    corners[i] = load_u32(bytes);
    if (corners[i] >= points)
      throw BadGlb("index " + std::to_string(i + 1) + ": " + expected_number("a point", 0, points) +
                   ", found " + std::to_string(corners[i]));
  }
  return corners;
}

}  // namespace clay::solid::inline formats::glb
