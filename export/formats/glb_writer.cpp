#include "claystack/export/formats.hpp"
#include "claystack/version.hpp"
#include "core/cancel.hpp"
#include "core/little_endian.hpp"
#include "core/material.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/glb.hpp"
#ifdef CLAYSTACK_DRACO
#include "export/formats/draco_mesh.hpp"
#endif

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

namespace clay::solid::inline formats {
namespace {

using namespace glb;
using OrderedJson = nlohmann::ordered_json;

/// The mesh as the file holds it, with what the accessors state.
struct Packed {
  std::string bytes;
  std::size_t points = 0, indices = 0, points_bytes = 0;
  glm::vec3 low{0.0F}, high{0.0F};
  bool draco = false;
};

TriangleMesh in_metres(const TriangleMesh& mesh) {
  TriangleMesh turned = mesh;
  for (glm::dvec3& point : turned.points) point = glm::dvec3(file_point(to_metres(point)));
  return turned;
}

Packed plain_of(const TriangleMesh& metres) {
  Packed plain;
  plain.points = metres.points.size();
  plain.indices = 3 * metres.triangles.size();
  plain.points_bytes = 12 * plain.points;
  plain.bytes.resize(plain.points_bytes + 4 * plain.indices);
  plain.low = plain.high =
      glm::vec3(metres.points.empty() ? glm::dvec3(0.0) : metres.points.front());
  char* at = plain.bytes.data();
  for (const glm::dvec3& p : metres.points) {
    const glm::vec3 point(p);
    plain.low = glm::min(plain.low, point);
    plain.high = glm::max(plain.high, point);
    for (int axis = 0; axis < 3; ++axis, at += 4) store_f32(at, point[axis]);
  }
  for (const auto& triangle : metres.triangles)
    for (const std::uint32_t index : triangle) {
      store_u32(at, index);
      at += 4;
    }
  return plain;
}

#ifdef CLAYSTACK_DRACO
/// A vertex is rounded to float32 in metres before Draco's grid, and to float32 in mm by a reader
/// after it; the grid keeps what is left of the error.
Result<Packed> compressed(const TriangleMesh& metres, DracoSettings settings) {
  double farthest = 0.0;
  for (const glm::dvec3& point : metres.points) farthest = std::max(farthest, glm::length(point));
  constexpr double kRoundings = 3.0;
  settings.max_error_mm =
      settings.max_error_mm / kMmPerMetre - kRoundings * std::ldexp(farthest, -24);
  if (!(settings.max_error_mm > 0.0))
    return failure(ErrorKind::bad_input,
                   "cannot write .glb: expected a vertex error above the rounding to float32");
  return encode_draco(metres, settings).map([](EncodedDraco encoded) {
    return Packed{std::move(encoded.bytes),
                  encoded.points,
                  3 * encoded.triangles,
                  0,
                  encoded.low,
                  encoded.high,
                  true};
  });
}
#endif

Result<Packed> packed(const TriangleMesh& metres, const FileContents& contents) {
#ifdef CLAYSTACK_DRACO
  if (contents.glb == GlbMesh::draco) return compressed(metres, contents.draco);
#else
  (void)contents;
#endif
  return plain_of(metres);
}

/// float32 as the shortest decimals that read back as the same double.
OrderedJson numbers(const glm::vec3& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

constexpr const char* kClearcoat = "KHR_materials_clearcoat";

OrderedJson material_json(const Material& material) {
  const auto factor = [](float value) { return std::round(1e4 * double{value}) / 1e4; };
  const Reflectance& base = material.base;
  OrderedJson json = {
      {"name", material.id},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {factor(base[0]), factor(base[1]), factor(base[2]), 1.0}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", factor(material.roughness)}}}};
  if (material.coat > 0.0f)
    json["extensions"][kClearcoat] = {
        {"clearcoatFactor", factor(material.coat)},
        {"clearcoatRoughnessFactor", factor(material.coat_roughness)}};
  return json;
}

OrderedJson document(const Packed& packed, const Material& material, const FileContents& contents) {
  const std::string name = one_line(contents.name);
  OrderedJson extras = {{"name", name}};
  for (const auto& [key, value] : contents.notes) extras[key] = one_line(value);
  OrderedJson points = {{"componentType", kFloat32},
                        {"count", packed.points},
                        {"type", "VEC3"},
                        {"min", numbers(packed.low)},
                        {"max", numbers(packed.high)}};
  OrderedJson indices = {{"componentType", kUint32}, {"count", packed.indices}, {"type", "SCALAR"}};
  OrderedJson primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}};
  OrderedJson views = OrderedJson::array();
  OrderedJson json = {{"asset",
                       {{"version", "2.0"},
                        {"generator", "claystack " CLAYSTACK_VERSION},
                        {"extras", {{"claystack", extras}}}}}};
  if (material.coat > 0.0f) json["extensionsUsed"].push_back(kClearcoat);
  if (packed.draco) {
    json["extensionsUsed"].push_back(kDraco);
    json["extensionsRequired"] = {kDraco};
    views.push_back({{"buffer", 0}, {"byteLength", packed.bytes.size()}});
    primitive["extensions"][kDraco] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  } else {
    constexpr int kVertices = 34962, kIndices = 34963;
    points["bufferView"] = 0;
    indices["bufferView"] = 1;
    views.push_back({{"buffer", 0}, {"byteLength", packed.points_bytes}, {"target", kVertices}});
    views.push_back({{"buffer", 0},
                     {"byteOffset", packed.points_bytes},
                     {"byteLength", packed.bytes.size() - packed.points_bytes},
                     {"target", kIndices}});
  }
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"name", name}, {"mesh", 0}}};
  json["meshes"] = {{{"name", name}, {"primitives", {primitive}}}};
  json["materials"] = OrderedJson::array({material_json(material)});
  json["accessors"] = {points, indices};
  json["bufferViews"] = views;
  json["buffers"] = {{{"byteLength", packed.bytes.size()}}};
  return json;
}

void append_chunk(std::string& file, std::uint32_t type, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  char header[kChunkHeaderBytes];
  store_u32(header, static_cast<std::uint32_t>(bytes.size()));
  store_u32(header + 4, type);
  file.append(header, sizeof header).append(bytes);
}

}  // namespace

Result<std::string> encode_glb(const TriangleMesh& mesh, const FileContents& contents) {
  const Material* const material = find_material(contents.material);
  if (material == nullptr)
    return failure(ErrorKind::bad_input, "cannot write .glb: expected a clay or a glaze, found '" +
                                             one_line(contents.material) + "'");
  return packed(in_metres(mesh), contents)
      .and_then([&](const Packed& packed) -> Result<std::string> {
        std::string file(kGlbHeaderBytes, '\0');
        append_chunk(file, kJsonChunk,
                     document(packed, *material, contents)
                         .dump(-1, ' ', false, OrderedJson::error_handler_t::replace),
                     ' ');
        append_chunk(file, kBinaryChunk, packed.bytes, '\0');
        if (file.size() > std::numeric_limits<std::uint32_t>::max())
          return failure(ErrorKind::bad_input, "cannot write .glb: more than 4 GiB");
        store_u32(file.data(), kMagic);
        store_u32(file.data() + 4, kVersion);
        store_u32(file.data() + 8, static_cast<std::uint32_t>(file.size()));
        return file;
      });
}

}  // namespace clay::solid::inline formats
