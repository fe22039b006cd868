#include "claystack/export/formats.hpp"
#include "claystack/version.hpp"
#include "core/cancel.hpp"
#include "core/colour_scale.hpp"
#include "core/little_endian.hpp"
#include "core/material.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/glb.hpp"
#include "export/formats/glb_packed.hpp"
#ifdef CLAYSTACK_DRACO
#include "export/formats/draco_mesh.hpp"
#endif

#include <cmath>
#include <limits>
#include <utility>

namespace clay::solid::inline formats {
namespace {

using namespace glb;

TriangleMesh in_metres(const TriangleMesh& mesh) {
  TriangleMesh turned = mesh;
  for (glm::dvec3& point : turned.points) {
    step_of_loop();
    point = glm::dvec3(file_point(to_metres(point)));
  }
  return turned;
}

/// The wall map, in linear light as glTF states colours; empty without walls.
std::vector<Colour16> colours_of(const FileContents& contents) {
  constexpr float kOne = 65535.0F;
  std::vector<Colour16> colours;
  colours.reserve(contents.wall_mm.size());
  for (const float wall_mm : contents.wall_mm) {
    step_of_loop();
    Colour16& colour = colours.emplace_back();
    colour[3] = static_cast<std::uint16_t>(kOne);
    const LinearColour light = scale_colour(double{wall_mm} / contents.wall_top_mm);
    for (std::size_t i = 0; i < light.size(); ++i)
      colour[i] = static_cast<std::uint16_t>(std::lround(kOne * light[i]));
  }
  return colours;
}

OrderedJson accessor(int type, bool normalized, std::size_t count, std::string_view shape) {
  OrderedJson json = {{"componentType", type}, {"count", count}, {"type", shape}};
  if (normalized) json["normalized"] = true;
  return json;
}

/// Points, indices and colours, without the places of their bytes.
OrderedJson accessors(std::size_t points, std::size_t indices, const Bounds& bounds, bool colours) {
  OrderedJson all = {accessor(kFloat32, false, points, "VEC3"),
                     accessor(kUint32, false, indices, "SCALAR")};
  all[0]["min"] = numbers(bounds.low);
  all[0]["max"] = numbers(bounds.high);
  if (colours) all.push_back(accessor(kUint16, true, points, "VEC4"));
  return all;
}

Packed plain_of(const TriangleMesh& metres, std::span<const Colour16> colours) {
  const std::vector<glm::vec3> points(metres.points.begin(), metres.points.end());
  Packed plain;
  plain.accessors =
      accessors(points.size(), 3 * metres.triangles.size(), bounds_of(points), !colours.empty());
  std::string stream(12 * points.size(), '\0');
  char* at = stream.data();
  for (const glm::vec3& point : points) {
    step_of_loop();
    for (int axis = 0; axis < 3; ++axis, at += 4) store_f32(at, point[axis]);
  }
  plain.accessors[0]["bufferView"] = plain.add_view(stream, {{"target", kVertexTarget}});
  stream.assign(12 * metres.triangles.size(), '\0');
  at = stream.data();
  for (const auto& triangle : metres.triangles) {
    step_of_loop();
    for (const std::uint32_t index : triangle) {
      store_u32(at, index);
      at += 4;
    }
  }
  plain.accessors[1]["bufferView"] = plain.add_view(stream, {{"target", kIndexTarget}});
  if (colours.empty()) return plain;
  stream.clear();
  for (const Colour16& colour : colours) {
    step_of_loop();
    for (const std::uint16_t channel : colour)
      stream.append({static_cast<char>(channel & 0xFFU), static_cast<char>(channel >> 8U)});
  }
  plain.accessors[2]["bufferView"] = plain.add_view(stream, {{"target", kVertexTarget}});
  return plain;
}

#ifdef CLAYSTACK_DRACO
Result<Packed> packed_by_draco(const TriangleMesh& metres, std::span<const Colour16> colours,
                               DracoSettings settings) {
  constexpr double kRoundings = roundings_of(MeshFormat::glb);
  const auto error = error_left(metres, settings.max_error_mm, kRoundings);
  if (!error) return tl::make_unexpected(error.error());
  const GridFile file{".glb", kMmPerMetre, settings.max_error_mm - kMmPerMetre * *error};
  settings.max_error_mm = *error;
  return encode_draco(metres, settings, colours, file).map([&](const EncodedDraco& encoded) {
    Packed packed;
    packed.accessors = accessors(encoded.points, 3 * encoded.triangles, {encoded.low, encoded.high},
                                 !colours.empty());
    packed.extensions = {kDraco};
    OrderedJson attributes = {{"POSITION", 0}};
    if (!colours.empty()) attributes["COLOR_0"] = 1;
    packed.primitive["extensions"][kDraco] = {
        {"bufferView", packed.add_view(encoded.bytes, OrderedJson::object())},
        {"attributes", attributes}};
    return packed;
  });
}
#endif

Result<Packed> packed(const TriangleMesh& metres, const FileContents& contents) {
  const std::vector<Colour16> colours = colours_of(contents);
  switch (contents.glb) {
    case GlbMesh::meshopt:
      return packed_by_meshopt(metres, colours, contents.draco);
#ifdef CLAYSTACK_DRACO
    case GlbMesh::draco:
      return packed_by_draco(metres, colours, contents.draco);
#endif
    default:
      return plain_of(metres, colours);
  }
}

constexpr const char* kClearcoat = "KHR_materials_clearcoat";

/// White below the colours of a wall map.
OrderedJson material_json(const Material& material, bool colours) {
  const auto factor = [](float value) { return std::round(1e4 * double{value}) / 1e4; };
  const Reflectance base = colours ? Reflectance{1.0f, 1.0f, 1.0f} : material.base;
  OrderedJson json = {
      {"name", colours ? "wall map" : material.id},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {factor(base[0]), factor(base[1]), factor(base[2]), 1.0}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", factor(material.roughness)}}}};
  if (!colours && material.coat > 0.0f)
    json["extensions"][kClearcoat] = {
        {"clearcoatFactor", factor(material.coat)},
        {"clearcoatRoughnessFactor", factor(material.coat_roughness)}};
  return json;
}

OrderedJson extras_of(const FileContents& contents) {
  OrderedJson extras = {{"name", one_line(contents.name)}};
  for (const auto& [key, value] : contents.notes) extras[key] = one_line(value);
  if (contents.wall_mm.empty()) return extras;
  OrderedJson colours = OrderedJson::array();
  for (const std::uint32_t rgb : kScaleColours) {
    std::string text = "#";
    for (int shift = 16; shift >= 0; shift -= 8)
      append_hexadecimal(text, static_cast<std::uint8_t>(rgb >> shift & 255U));
    colours.push_back(std::move(text));
  }
  extras["wall_map"] = {
      {"unit", "mm"}, {"range", {0.0, contents.wall_top_mm}}, {"colours_srgb", std::move(colours)}};
  return extras;
}

OrderedJson document(Packed& packed, const Material& material, const FileContents& contents) {
  const std::string name = one_line(contents.name);
  const bool colours = packed.accessors.size() > 2;
  OrderedJson json = {{"asset",
                       {{"version", "2.0"},
                        {"generator", "claystack " CLAYSTACK_VERSION},
                        {"extras", {{"claystack", extras_of(contents)}}}}}};
  for (const std::string_view extension : packed.extensions)
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      json[list].push_back(extension);
  if (!colours && material.coat > 0.0f) json["extensionsUsed"].push_back(kClearcoat);
  OrderedJson primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}};
  if (colours) primitive["attributes"]["COLOR_0"] = 2;
  primitive.update(packed.primitive);
  OrderedJson node = {{"name", name}, {"mesh", 0}};
  node.update(packed.node);
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = OrderedJson::array({node});  // Clang copies an object in single braces
  json["meshes"] = {{{"name", name}, {"primitives", {primitive}}}};
  json["materials"] = OrderedJson::array({material_json(material, colours)});
  json["accessors"] = std::move(packed.accessors);
  json["bufferViews"] = std::move(packed.views);
  json["buffers"] = {{{"byteLength", packed.bytes.size()}}};
  if (packed.unpacked_bytes > 0)
    json["buffers"].push_back({{"byteLength", packed.unpacked_bytes},
                               {"extensions", {{kMeshopt, {{"fallback", true}}}}}});
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
  return packed(in_metres(mesh), contents).and_then([&](Packed packed) -> Result<std::string> {
    const std::string json = document(packed, *material, contents)
                                 .dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    std::string file(kGlbHeaderBytes, '\0');
    append_chunk(file, kJsonChunk, json, ' ');
    append_chunk(file, kBinaryChunk, std::move(packed.bytes), '\0');
    if (file.size() > std::numeric_limits<std::uint32_t>::max())
      return failure(ErrorKind::bad_input, "cannot write .glb: more than 4 GiB");
    store_u32(file.data(), kMagic);
    store_u32(file.data() + 4, kVersion);
    store_u32(file.data() + 8, static_cast<std::uint32_t>(file.size()));
    return file;
  });
}

}  // namespace clay::solid::inline formats
