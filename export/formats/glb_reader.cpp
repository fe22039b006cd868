#include "claystack/export/formats.hpp"
#include "core/cancel.hpp"
#include "core/little_endian.hpp"
#include "core/text.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/glb_buffers.hpp"
#include "export/formats/glb_json.hpp"
#include "export/formats/glb_scene.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/stated_sizes.hpp"
#include "export/solid/vertex_welder.hpp"

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <vector>

namespace clay::solid::inline formats {
namespace {

using namespace glb;

/// The error of the reader of a compressed mesh within the file.
struct BadStream {
  Error error;
};

// ---- numbers

/// How a coordinate is stored.
struct Component {
  std::size_t size = 0;  ///< bytes; 0: no coordinate is stored so
  double most = 0.0;     ///< the number that means 1, if normalised; 0: none
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

// ---- meshes

class GlbReader {
 public:
  GlbReader(std::string_view file, std::string_view name, const ReadOptions& options)
      : chunks_(chunks_of(file)),
        json_(parsed(chunks_.json)),
        buffers_(json_, chunks_.binary),
        scene_(scene_of(json_)),
        name_(name),
        options_(options) {}

  Result<TriangleMesh> read() {
    for (const auto& [mesh, matrix] : scene_.placed) load(mesh);
    if (auto fits = check_limit(); !fits) return tl::make_unexpected(fits.error());
    for (const auto& [mesh, matrix] : scene_.placed) place(meshes_.at(mesh), matrix);
    note_differences();
    return std::move(mesh_);
  }

  /// By the accessors, and by the headers of Draco's meshes.
  std::uint64_t stated_triangles() {
    std::map<std::size_t, std::uint64_t> stated;
    std::uint64_t triangles = 0;
    for (const auto& [mesh, matrix] : scene_.placed) {
      const auto [found, is_new] = stated.try_emplace(mesh);
      if (is_new)
        for (const Json& primitive : primitives_of(mesh))
          found->second += stated_triangles_of(primitive);
      triangles += found->second;
    }
    return triangles;
  }

 private:
  /// Reads a mesh once, in metres and y up, without transforms.
  void load(std::size_t index) {
    if (meshes_.contains(index)) return;
    TriangleMesh& mesh = meshes_[index];
    for (const Json& primitive : primitives_of(index)) add_primitive(primitive, mesh);
  }

  /// Objects.
  [[nodiscard]] const Json& primitives_of(std::size_t mesh) const {
    const Json& json = object_at(json_, "meshes", mesh);
    const auto primitives = json.find("primitives");
    if (primitives == json.end() || !primitives->is_array())
      throw BadGlb("primitives: expected a list");
    for (std::size_t i = 0; i < primitives->size(); ++i) (void)object_at(json, "primitives", i);
    return *primitives;
  }

  [[nodiscard]] std::uint64_t stated_triangles_of(const Json& primitive) const {
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

  [[nodiscard]] static std::size_t triangles_of(std::size_t corners, std::size_t mode) {
    return corners < 3 ? 0 : (corners - 3) / (mode == kTriangles ? 3 : 1) + 1;
  }

  /// The Draco extension of a primitive, or null.
  [[nodiscard]] static const Json* draco_in(const Json& primitive) {
    const auto extensions = primitive.find("extensions");
    if (extensions == primitive.end() || !extensions->is_object()) return nullptr;
    const auto found = extensions->find(kDraco);
    return found == extensions->end() ? nullptr : &*found;
  }

  /// Counts triangles and points of the file, before they take memory.
  void expect_room(std::size_t points, std::size_t triangles) {
    stored_points_ += points;
    stored_ += triangles;
    if (stored_ > kMaxTriangles) throw BadGlb(expected_at_most(kMaxTriangles, "triangles"));
    if (stored_points_ > kMaxPoints) throw BadGlb(expected_at_most(kMaxPoints, "vertices"));
  }

  void add_primitive(const Json& primitive, TriangleMesh& mesh) {
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

  void add_triangles(const std::vector<std::uint32_t>& c, std::size_t mode, std::uint32_t first,
                     TriangleMesh& mesh) {
    if (mode == kTriangles && c.size() % 3 != 0)
      throw BadGlb("expected 3 corners for each triangle, found " + std::to_string(c.size()));
    const std::size_t step = mode == kTriangles ? 3 : 1;
    expect_room(0, triangles_of(c.size(), mode));
    for (std::size_t i = 0; i + 2 < c.size(); i += step) {
      step_of_loop();
      const std::size_t odd = mode == kTriangleStrip ? i % 2 : 0;
      mesh.triangles.push_back({first + c[mode == kTriangleFan ? 0 : i], first + c[i + 1 + odd],
                                first + c[i + 2 - odd]});
    }
  }

  void add_draco(const Json& draco, TriangleMesh& mesh) {
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
  void add_points(std::size_t index, std::vector<glm::dvec3>& points) {
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

  [[nodiscard]] std::vector<std::uint32_t> indices_of(std::size_t index, std::uint32_t points) {
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
        throw BadGlb("index " + std::to_string(i + 1) + ": " +
                     expected_number("a point", 0, points) + ", found " +
                     std::to_string(corners[i]));
    }
    return corners;
  }

  // ---- build

  [[nodiscard]] Result<void> check_limit() const {
    constexpr std::uint64_t kFree = 1'000'000, kMostCopies = 64;
    std::uint64_t points = 0, triangles = 0;
    for (const auto& [mesh, matrix] : scene_.placed) {
      points += meshes_.at(mesh).points.size();
      triangles += meshes_.at(mesh).triangles.size();
    }
    const auto most = [&](std::uint64_t stored, std::uint64_t free, std::string_view what,
                          std::uint64_t found) {
      if (found <= std::max(free, kMostCopies * stored)) return;
      throw BadGlb("expected a scene of at most " + std::to_string(kMostCopies) + " times the " +
                   std::to_string(stored) + " " + std::string(what) + " in the file, found " +
                   std::to_string(found));
    };
    most(stored_, kFree, "triangles", triangles);
    most(stored_points_, 3 * kFree, "points", points);
    if (points > kMaxPoints) throw BadGlb(expected_at_most(kMaxPoints, "vertices"));
    return check_facet_count(triangles, name_);
  }

  void place(const TriangleMesh& mesh, const glm::dmat4& matrix) {
    const bool mirrored = glm::determinant(glm::dmat3(matrix)) < 0.0;
    std::vector<std::uint32_t> number(mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      step_of_loop();
      const glm::vec3 point = to_mm(glm::dvec3(matrix * glm::dvec4(mesh.points[i], 1.0)));
      if (const auto bad = find_bad_coordinate(point)) throw BadGlb("in mm: " + *bad);
      number[i] = welder_.index_of(point);
    }
    for (auto [a, b, c] : mesh.triangles) {
      if (mirrored) std::swap(b, c);
      mesh_.triangles.push_back({number[a], number[b], number[c]});
    }
  }

  void note_differences() const {
    if (options_.notes == nullptr) return;
    const auto note = [&](std::size_t count, std::string_view noun, std::string_view what) {
      if (count > 0) options_.notes->push_back(counted(count, noun).append(what));
    };
    if (scene_.missing)
      options_.notes->push_back("no scene in the file: all its root nodes are read");
    note(scene_.morphed, "node", " with morph weights, which are not applied");
    note(scene_.skinned, "node", " with a skin, whose skeleton is not applied");
    note(scene_.instanced, "node",
         " with EXT_mesh_gpu_instancing, which is not applied: the mesh is read once");
    note(without_surface_, "primitive", " of points or lines not read");
  }

  Chunks chunks_;
  Json json_;
  Buffers buffers_;
  Scene scene_;
  std::string_view name_;
  ReadOptions options_;
  std::size_t without_surface_ = 0;  ///< primitives of points or lines
  std::map<std::size_t, TriangleMesh> meshes_;
  std::uint64_t stored_ = 0, stored_points_ = 0;  ///< triangles and points of all meshes read
  TriangleMesh mesh_;
  VertexWelder welder_{mesh_.points, 0};
};

}  // namespace

Result<TriangleMesh> decode_glb(std::string_view bytes, std::string_view name,
                                const ReadOptions& options) {
  return check_file_size(bytes, name).and_then([&] {
    return guarded(name, [&]() -> Result<TriangleMesh> {
      try {
        return GlbReader(bytes, name, options).read();
      } catch (const BadStream& bad) {
        return tl::make_unexpected(bad.error);
      } catch (const BadGlb& error) {
        return bad_file(name, error.what());
      }
    });
  });
}

std::uint64_t glb_triangles(std::string_view bytes) {
  return check_file_size(bytes, {})
      .and_then([&] {
        return guarded({}, [&]() -> Result<std::uint64_t> {
          return GlbReader(bytes, {}, {}).stated_triangles();
        });
      })
      .value_or(0);
}

}  // namespace clay::solid::inline formats
