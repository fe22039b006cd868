#include "claystack/export/formats.hpp"
#include "core/little_endian.hpp"
#include "core/material.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#ifdef CLAYSTACK_MESHOPT
#include <meshoptimizer.h>
#endif
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace clay::solid {
namespace {

using samples::refused;
using samples::tetrahedron;
using Json = nlohmann::json;

std::string glb_of(const Json& json, std::string binary = {}) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string file;
  const auto add = [&](std::size_t number) {
    char bytes[4];
    store_u32(bytes, static_cast<std::uint32_t>(number));
    file.append(bytes, 4);
  };
  file += "glTF";
  add(2);
  add(12 + 8 + text.size() + 8 + binary.size());
  add(text.size());
  file += "JSON" + text;
  add(binary.size());
  file.append("BIN\0", 4);
  return file + binary;
}

/// A tetrahedron of 1 m, with float32 points and indices of 16 bits.
struct Plain {
  Json json = Json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
    "indices": 1}]}], "accessors": [{"componentType": 5126, "count": 4, "type": "VEC3",
    "bufferView": 0}, {"componentType": 5123, "count": 12, "type": "SCALAR", "bufferView": 1}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48,
    "byteLength": 24}], "buffers": [{"byteLength": 72}]})");
  std::string binary = std::string(72, '\0');

  Plain() {
    for (std::size_t axis = 0; axis < 3; ++axis)
      store_f32(binary.data() + 12 * (axis + 1) + 4 * axis, 1.0F);
    std::size_t at = 48;
    for (const auto& triangle : tetrahedron().triangles)
      for (const std::uint32_t index : triangle) {
        binary[at] = static_cast<char>(index);
        at += 2;
      }
  }
  [[nodiscard]] std::string file() const { return glb_of(json, binary); }
};

Json json_of(const std::string& glb) {
  return Json::parse(glb.substr(20, load_u32(glb.data() + 12)));
}

const std::vector<std::pair<GlbMesh, double>> kLimits{
    {GlbMesh::draco, 0.5},    {GlbMesh::draco, 0.01},   {GlbMesh::draco, 0.001},
#ifdef CLAYSTACK_MESHOPT
    {GlbMesh::meshopt, 0.5},  {GlbMesh::meshopt, 0.01}, {GlbMesh::meshopt, 0.001},
    {GlbMesh::meshopt, 1e-4},  // more than 16 bits
#endif
};

/// The limits in the messages, in mm as the settings, are themselves accepted.
TEST(Glb, NamesTheSmallestVertexErrorThatItKeeps) {
  const TriangleMesh mesh = samples::torus(60, 40);
  FileContents contents;
  double& limit_mm = contents.draco.max_error_mm = 1e-9;
  for (const std::string words : {"cannot write .glb: expected a vertex error above ",
                                  " mm needs more than 30 bits; the smallest possible is "}) {
    const auto refused = encode_glb(mesh, contents);
    if (refused) break;  // without Draco, float32 keeps any error
    const std::string& message = refused.error().message;
    ASSERT_EQ(message.rfind("cannot write .glb: ", 0), 0u) << message;
    ASSERT_NE(message.find(words), std::string::npos) << message;
    limit_mm = std::stod(message.substr(message.find(words) + words.size()));
  }
  const auto bytes = encode_glb(mesh, contents);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const double moved_mm = samples::largest_move(mesh, decode_glb(*bytes, "x").value());
  EXPECT_LE(moved_mm, limit_mm);
  EXPECT_GT(moved_mm, 0.01 * limit_mm);
}

TEST(Glb, KeepsTheErrorLimitAndItsAccessorsAreTrue) {
  const TriangleMesh mesh = samples::torus(60, 40);
  for (const auto& [glb, limit] : kLimits) {
    FileContents contents{.name = "a \"pot\"", .glb = glb, .notes = {{"process", "sla"}}};
    contents.draco.max_error_mm = limit;
    const std::string bytes = encode_glb(mesh, contents).value();
    EXPECT_EQ(bytes, encode_glb(mesh, contents).value());
    const TriangleMesh read = decode_glb(bytes, "x").value();
    EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
    EXPECT_LE(samples::largest_move(mesh, read), limit);
    const Json json = json_of(bytes);
    EXPECT_EQ(json["asset"]["extras"]["claystack"]["process"], "sla");
    EXPECT_EQ(json["accessors"][0]["count"], read.points.size());
    EXPECT_EQ(json["accessors"][1]["count"], 3 * read.triangles.size());
    // Metres, y up: a torus about z of 55 mm, 15 mm high.
    std::array<double, 3> max{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Json& node = json["nodes"][0];
      max[axis] = json["accessors"][0]["max"][axis].get<double>();
      if (node.contains("scale"))
        max[axis] =
            max[axis] * node["scale"][axis].get<double>() + node["translation"][axis].get<double>();
    }
    EXPECT_NEAR(max[0], 0.055, 2e-3 * limit);
    EXPECT_NEAR(max[1], 0.015, 2e-3 * limit);
    double highest = 0.0;
    for (const glm::dvec3& point : read.points) highest = std::max(highest, point.z);
    EXPECT_NEAR(max[1], highest / 1000.0, 1e-8);
  }
}

TEST(Glb, HasTheChosenClayOrGlaze) {
  const TriangleMesh mesh = samples::torus(12, 8);
  for (const GlbMesh kind : {GlbMesh::core, GlbMesh::draco})
    for (const Material& wanted : kMaterials) {
      FileContents contents{.glb = kind, .material = wanted.id};
      const std::string bytes = encode_glb(mesh, contents).value();
      const Json json = json_of(bytes), material = json["materials"][0];
      EXPECT_EQ(material["name"], wanted.id);
      const Json& pbr = material["pbrMetallicRoughness"];
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(pbr["baseColorFactor"][i].get<float>(), wanted.base[i], 1e-4f);
      EXPECT_NEAR(pbr["roughnessFactor"].get<float>(), wanted.roughness, 1e-4f);
      const bool used =
          json.contains("extensionsUsed") &&
          json["extensionsUsed"].dump().find("KHR_materials_clearcoat") != std::string::npos;
      EXPECT_EQ(used, wanted.coat > 0.0f) << wanted.id;
      EXPECT_EQ(material.contains("extensions"), used);
      if (used) {
        const Json& coat = material["extensions"]["KHR_materials_clearcoat"];
        EXPECT_NEAR(coat["clearcoatFactor"].get<float>(), wanted.coat, 1e-4f);
        EXPECT_NEAR(coat["clearcoatRoughnessFactor"].get<float>(), wanted.coat_roughness, 1e-4f);
      }
      EXPECT_TRUE(decode_glb(bytes, "x"));
    }
  EXPECT_EQ(encode_glb(mesh, {.material = "brick"}).error().kind, ErrorKind::bad_input);
}

TEST(Glb, ReadsPlainMeshesWithTransforms) {
  const Plain plain;
  const double volume = 1e9 / 6.0;
  const TriangleMesh mesh = decode_glb(plain.file(), "x").value();
  EXPECT_NEAR(signed_volume(mesh), volume, 1.0);
  EXPECT_EQ(mesh.points[3 - 1], glm::dvec3(0, 0, 1000));  // y is up in the file
  Plain moved = plain;
  moved.json["nodes"] = Json::parse(R"([{"children": [1, 2]}, {"mesh": 0, "scale": [-2, 1, 1]},
    {"mesh": 0, "translation": [5, 0, 0], "rotation": [0, 0.7071067811865476, 0,
    0.7071067811865476]}])");
  EXPECT_NEAR(signed_volume(decode_glb(moved.file(), "x").value()), 3.0 * volume, 100.0);
}

TEST(Glb, RefusesARotationThatScalesAndTwoTransformsOfANode) {
  const auto read = [](const char* transform) {
    Plain plain;
    plain.json["nodes"][0].update(Json::parse(transform));
    return decode_glb(plain.file(), "x");
  };
  EXPECT_TRUE(refused(read(R"({"rotation": [0, 0, 1, 1]})"), ErrorKind::bad_input,
                      "rotation: expected a quaternion of length 1, found 1.4"));
  EXPECT_TRUE(refused(read(R"({"rotation": [0, 0, 0, 0]})"), ErrorKind::bad_input, "found 0"));
  // Rounded to three digits, it turns and does not scale.
  EXPECT_NEAR(signed_volume(read(R"({"rotation": [0, 0, 0.707, 0.707]})").value()), 1e9 / 6.0, 1.0);
  const std::string matrix = R"("matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])";
  EXPECT_TRUE(read(("{" + matrix + "}").c_str()));
  for (const char* other :
       {"\"translation\": [1, 0, 0]", "\"rotation\": [0, 0, 0, 1]", "\"scale\": [1, 1, 1]"}) {
    const std::string both = "{" + matrix + ", " + other + "}";
    EXPECT_TRUE(refused(read(both.c_str()), ErrorKind::bad_input, "with both"));
  }
}

TEST(Glb, ReadsStripsAndFans) {
  for (const int mode : {5, 6}) {
    Plain plain;
    plain.json["meshes"][0]["primitives"][0]["mode"] = mode;
    plain.json["accessors"][1]["count"] = 4;
    for (std::size_t i = 0; i < 4; ++i) plain.binary[48 + 2 * i] = static_cast<char>(i);
    const TriangleMesh mesh = decode_glb(plain.file(), "x").value();
    ASSERT_EQ(mesh.triangles.size(), 2u);
    const auto points = [&](std::size_t t) {
      std::array<std::uint32_t, 3> corners = mesh.triangles[t];
      std::ranges::sort(corners);
      return corners;
    };
    EXPECT_EQ(points(0), (std::array<std::uint32_t, 3>{0, 1, 2}));
    EXPECT_EQ(points(1), (mode == 5 ? std::array<std::uint32_t, 3>{1, 2, 3}
                                    : std::array<std::uint32_t, 3>{0, 2, 3}));
  }
}

TEST(Glb, ReadsWholeNumbersAsPositions) {
  struct Kind {
    int type, bytes, most;
  };
  for (const Kind kind : {Kind{5120, 1, 127}, {5121, 1, 255}, {5122, 2, 32767}, {5123, 2, 65535}})
    for (const bool normalized : {false, true}) {
      Plain plain;
      plain.json["extensionsRequired"] = {"KHR_mesh_quantization"};
      Json& accessor = plain.json["accessors"][0];
      accessor["componentType"] = kind.type;
      accessor["normalized"] = normalized;
      plain.json["bufferViews"][0]["byteStride"] = 8;
      std::fill_n(plain.binary.begin(), 48, '\0');
      for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < kind.bytes; ++i)
          plain.binary[static_cast<std::size_t>(8 * (axis + 1) + axis * kind.bytes + i)] =
              static_cast<char>(kind.most >> 8 * i);
      const double side = 1000.0 * (normalized ? 1.0 : kind.most);
      if (side > 1e6) {  // beyond the limit of coordinates
        EXPECT_TRUE(refused(decode_glb(plain.file(), "x"), ErrorKind::bad_input, "in mm"));
        continue;
      }
      EXPECT_NEAR(signed_volume(decode_glb(plain.file(), "x").value()) / std::pow(side, 3),
                  1.0 / 6.0, 1e-6);
    }
}

/// The accessor of the colours in a file, and the colours in its data.
struct Colours {
  Json accessor;
  std::vector<std::array<double, 4>> values;
};
Colours colours_in(const std::string& glb) {
  const Json json = json_of(glb);
  const std::size_t number = json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"];
  Colours found{json["accessors"][number], {}};
  const Json view = json["bufferViews"][found.accessor["bufferView"].get<std::size_t>()];
  const char* at =
      glb.data() + 20 + load_u32(glb.data() + 12) + 8 + view.value("byteOffset", std::size_t{0});
  for (std::size_t i = 0; i < found.accessor["count"].get<std::size_t>(); ++i, at += 8) {
    auto& colour = found.values.emplace_back();
    for (std::size_t c = 0; c < 4; ++c)
      colour[c] = (static_cast<unsigned char>(at[2 * c]) +
                   256.0 * static_cast<unsigned char>(at[2 * c + 1])) /
                  65535.0;
  }
  return found;
}

TEST(Glb, StatesTheWallMapInLinearLight) {
  const std::vector<float> walls{0.0F, 5.0F, 20.0F, 40.0F};
  const FileContents contents{.wall_mm = walls, .wall_top_mm = 20.0, .glb = GlbMesh::core};
  const std::string bytes = encode_glb(tetrahedron(), contents).value();
  const Colours colours = colours_in(bytes);
  EXPECT_EQ(colours.accessor["normalized"], true);
  EXPECT_EQ(colours.accessor["componentType"], 5123);
  // viridis from 0x440154 to 0xFDE725, a quarter up 0x3B528B; by the curve of sRGB.
  const auto linear = [](int byte) { return std::pow((byte / 255.0 + 0.055) / 1.055, 2.4); };
  const auto expect = [&](std::size_t point, int red, int green, int blue) {
    const std::array<double, 4>& found = colours.values.at(point);
    EXPECT_NEAR(found[0], linear(red), 2e-5);
    EXPECT_NEAR(found[1], green == 1 ? 1 / 255.0 / 12.92 : linear(green), 2e-5);
    EXPECT_NEAR(found[2], linear(blue), 2e-5);
    EXPECT_EQ(found[3], 1.0);
  };
  expect(0, 0x44, 0x01, 0x54);
  expect(1, 0x3B, 0x52, 0x8B);
  expect(2, 0xFD, 0xE7, 0x25);
  expect(3, 0xFD, 0xE7, 0x25);  // thicker than the top
  const Json json = json_of(bytes);
  const Json map = json["asset"]["extras"]["claystack"]["wall_map"];
  EXPECT_EQ(map["range"], Json::parse("[0, 20]"));
  EXPECT_EQ(map["colours_srgb"].front(), "#440154");
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
            Json::parse("[1, 1, 1, 1]"));
  EXPECT_FALSE(json_of(encode_glb(tetrahedron(), {.glb = GlbMesh::core})
                           .value())["meshes"][0]["primitives"][0]["attributes"]
                   .contains("COLOR_0"));
}

#ifdef CLAYSTACK_DRACO
TEST(Glb, CompressesTheWallMapBesideThePoints) {
  const TriangleMesh mesh = samples::torus(60, 40);
  const std::vector<float> walls(mesh.points.size(), 4.0F);
  const std::string bytes = encode_glb(mesh, {.wall_mm = walls}).value();
  const Json json = json_of(bytes);
  EXPECT_EQ(json["accessors"][2]["count"], json["accessors"][0]["count"]);
  EXPECT_EQ(
      json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"],
      Json::parse(R"({"POSITION": 0, "COLOR_0": 1})"));
  EXPECT_LE(samples::largest_move(mesh, decode_glb(bytes, "x").value()), 0.01);
  // Without compression, the colours of 2400 points take 14 400 bytes.
  EXPECT_LT(bytes.size(), encode_glb(mesh, {}).value().size() + 1000);
}
#endif

TEST(Glb, ReadsFilesThatRequireExtensionsOfAppearance) {
  const auto requiring = [](const char* extension) {
    Plain plain;
    plain.json["extensionsRequired"] = {extension};
    return decode_glb(plain.file(), "p.glb");
  };
  const TriangleMesh plain = decode_glb(Plain().file(), "p.glb").value();
  for (const char* extension :
       {"EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds", "KHR_texture_basisu",
        "KHR_materials_unlit", "EXT_lights_image_based", "KHR_lights_punctual"}) {
    const auto mesh = requiring(extension);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(*mesh, plain) << extension;
  }
  for (const char* extension : {"EXT_mesh_gpu_instancing", "KHR_node_lights_x", "lights"})
    EXPECT_TRUE(refused(requiring(extension), ErrorKind::bad_input,
                        std::string("materials, textures and lights, found '") + extension + "'"));
}

TEST(Glb, RefusesBadFiles) {
  const auto expect = [](const std::string& file, const std::string& because) {
    EXPECT_TRUE(refused(decode_glb(file, "p.glb"), ErrorKind::bad_input, because));
  };
  const auto changed = [](const char* pointer, const Json& value) {
    Plain plain;
    plain.json[Json::json_pointer(pointer)] = value;
    return plain.file();
  };
  const std::string good = Plain().file();
  expect("glTF", "p.glb: expected a GLB file");
  expect(good.substr(0, good.size() - 1), "bytes by the header");
  expect(good + "x", "bytes by the header");
  std::string odd = good;
  store_u32(odd.data() + 12, load_u32(odd.data() + 12) + 1);
  expect(odd, "expected a chunk size that is a multiple of 4, found ");
  store_u32(odd.data() + 12, 1U << 30);
  expect(odd, "the file ends within a chunk");
  expect(changed("/accessors/0/count", 5), "expected 5 values within bufferView 0");
  expect(changed("/accessors/0/count", 4000000000U), "values within bufferView 0");
  expect(changed("/accessors/1/count", 11), "3 corners for each triangle");
  expect(changed("/accessors/0/componentType", 5125), "POSITION: expected 3 float32");
  expect(changed("/accessors/0/normalized", true), "POSITION: expected 3 float32");
  expect(changed("/accessors/0/sparse", Json::object()), "no sparse accessor");
  expect(changed("/bufferViews/1/byteOffset", 60), "within the 72 bytes of the buffer");
  expect(changed("/buffers/0/uri", "https://example.org"), "the buffer of the file itself");
  expect(changed("/extensionsRequired", {"KHR_meshopt_compression"}), "no required extension but");
  expect(changed("/nodes/0/children", {0}), "expected a tree of nodes");
  expect(changed("/nodes/0/mesh", 7),
         "meshes: expected the number of an element, from 0 to 0, found 7");
  expect(changed("/scenes/0/nodes", Json::array()), "triangles, found 0");
  Plain wrong;
  wrong.binary[48] = 4;
  expect(wrong.file(), "index 1: expected the number of a point, from 0 to 3, found 4");
  Plain huge;
  store_f32(huge.binary.data(), 1e9F);
  expect(huge.file(), "expected a coordinate within");
  Json deep;
  for (int i = 0; i < 100; ++i) deep = Json::array({deep});
  expect(changed("/extras", deep), "nested at most 32 deep");
}

std::vector<std::string> notes_on(const Plain& plain, TriangleMesh& mesh) {
  std::vector<std::string> notes;
  const auto read = decode_glb(plain.file(), "x", {.notes = &notes});
  EXPECT_TRUE(read) << read.error().message;
  mesh = read.value_or(TriangleMesh());
  return notes;
}

TEST(Glb, NotesWhatChangesTheShapeAndIsNotApplied) {
  const auto notes_with = [](const char* pointer, const char* value) {
    Plain plain;
    plain.json[Json::json_pointer(pointer)] = Json::parse(value);
    TriangleMesh mesh;
    const auto notes = notes_on(plain, mesh);
    EXPECT_NEAR(signed_volume(mesh), 1e9 / 6.0, 1.0) << pointer;
    return notes;
  };
  using Notes = std::vector<std::string>;
  const std::string morph = "1 node with morph weights, which are not applied";
  EXPECT_EQ(notes_with("/meshes/0/weights", "[0, 0.5]"), Notes{morph});
  EXPECT_EQ(notes_with("/nodes/0/weights", "[1]"), Notes{morph});
  EXPECT_EQ(notes_with("/meshes/0/weights", "[0, 0]"), Notes{});
  EXPECT_EQ(notes_with("/nodes/0/extensions", R"({"EXT_mesh_gpu_instancing": {}})"),
            Notes{"1 node with EXT_mesh_gpu_instancing, which is not applied: the mesh is read "
                  "once"});
  EXPECT_EQ(notes_with("/meshes/0/primitives/1", R"({"attributes": {"POSITION": 0}, "mode": 1})"),
            Notes{"1 primitive of points or lines not read"});
  // The transform of a node with a skin does not move its mesh.
  EXPECT_EQ(notes_with("/nodes/0", R"({"mesh": 0, "skin": 0, "scale": [2, 2, 2]})"),
            Notes{"1 node with a skin, whose skeleton is not applied"});
}

TEST(Glb, ReadsTheRootNodesOfAFileWithoutScenes) {
  Plain plain;
  plain.json.erase("scenes");
  plain.json["nodes"] = Json::parse(R"([{"mesh": 0}, {"children": [0], "scale": [2, 2, 2]}])");
  TriangleMesh mesh;
  EXPECT_EQ(notes_on(plain, mesh),
            std::vector<std::string>{"no scene in the file: all its root nodes are read"});
  EXPECT_NEAR(signed_volume(mesh), 8e9 / 6.0, 10.0);
}

/// A strip of one corner too many, before a primitive that is not read.
TEST(Glb, RefusesTooManyTrianglesBeforeTheyTakeMemory) {
  Plain plain;
  plain.binary.resize(48 + kMaxTriangles + 4, '\0');
  plain.json["buffers"][0]["byteLength"] = plain.binary.size();
  plain.json["bufferViews"][1]["byteLength"] = kMaxTriangles + 4;
  plain.json["accessors"][1]["componentType"] = 5121;
  plain.json["accessors"][1]["count"] = kMaxTriangles + 3;
  Json& primitives = plain.json["meshes"][0]["primitives"];
  primitives[0]["mode"] = 5;
  primitives.push_back({{"mode", 9}});
  EXPECT_TRUE(refused(decode_glb(plain.file(), "x"), ErrorKind::bad_input,
                      "expected at most 20000000 triangles"));
}

/// Each copy has few triangles, but all its points.
TEST(Glb, RefusesManyCopiesOfPoints) {
  constexpr std::size_t kPoints = 10'000, kCopies = 400;
  Plain plain;
  const std::string indices = plain.binary.substr(48);
  plain.binary.resize(12 * kPoints, '\0');
  plain.binary += indices;
  plain.json["buffers"][0]["byteLength"] = plain.binary.size();
  plain.json["bufferViews"][0]["byteLength"] = 12 * kPoints;
  plain.json["bufferViews"][1]["byteOffset"] = 12 * kPoints;
  plain.json["accessors"][0]["count"] = kPoints;
  const std::string once = plain.file();
  EXPECT_TRUE(decode_glb(once, "x"));
  for (std::size_t copy = 1; copy < kCopies; ++copy) {
    plain.json["nodes"].push_back({{"mesh", 0}});
    plain.json["scenes"][0]["nodes"].push_back(copy);
  }
  EXPECT_TRUE(refused(decode_glb(plain.file(), "x"), ErrorKind::bad_input,
                      "at most 64 times the 10000 points in the file, found 4000000"));
}

#ifdef CLAYSTACK_MESHOPT

/// A torus, its JSON changed.
struct Packed {
  Json json;
  std::string binary;

  explicit Packed(double limit_mm = 0.01) {
    FileContents contents{.glb = GlbMesh::meshopt};
    contents.draco.max_error_mm = limit_mm;
    const std::string file = encode_glb(samples::torus(60, 40), contents).value();
    json = json_of(file);
    binary = file.substr(20 + load_u32(file.data() + 12) + 8);
  }
  [[nodiscard]] Json& compression(std::size_t view) {
    return json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
  }
  [[nodiscard]] std::string file() const { return glb_of(json, binary); }
};

TEST(Glb, IsSmallerByMeshopt) {
  const TriangleMesh mesh = samples::torus(200, 150);
  const auto size = [&](GlbMesh glb) { return encode_glb(mesh, {.glb = glb}).value().size(); };
  EXPECT_LT(6 * size(GlbMesh::meshopt), size(GlbMesh::core));
}

TEST(Glb, WritesTheVersionsOfTheCodecsThatTheExtensionAsksFor) {
  Packed packed;
  const auto first = [&](std::size_t view) {
    return static_cast<unsigned char>(
        packed.binary.at(packed.compression(view).value("byteOffset", std::size_t{0})));
  };
  EXPECT_EQ(first(0), 0xA0);
  EXPECT_EQ(first(1), 0xE1);
  EXPECT_EQ(packed.json["extensionsRequired"],
            Json::parse(R"(["EXT_meshopt_compression", "KHR_mesh_quantization"])"));
  EXPECT_EQ(packed.json["buffers"][1]["extensions"]["EXT_meshopt_compression"]["fallback"], true);
}

TEST(Glb, RefusesBadMeshoptViews) {
  ASSERT_TRUE(decode_glb(Packed().file(), "x"));
  const auto expect = [](std::size_t view, const Json& changes, const std::string& because) {
    Packed packed;
    packed.compression(view).update(changes);
    EXPECT_TRUE(refused(decode_glb(packed.file(), "p.glb"), ErrorKind::bad_input, because))
        << changes;
  };
  // The view itself must state the length that comes out.
  const auto expect_length = [](std::size_t view, const Json& changes, const std::string& because) {
    Packed packed;
    packed.compression(view).update(changes);
    packed.json["bufferViews"][view]["byteLength"] =
        packed.compression(view)["count"].get<std::size_t>() *
        packed.compression(view)["byteStride"].get<std::size_t>();
    packed.json["bufferViews"][view].erase("byteStride");
    EXPECT_TRUE(refused(decode_glb(packed.file(), "p.glb"), ErrorKind::bad_input, because))
        << changes;
  };
  expect(0, {{"count", 2399}}, "bufferView 0: expected the length and stride");
  expect(0, {{"count", 4000000000U}}, "expected at most 1 GiB unpacked");
  expect(0, {{"buffer", 1}}, "the buffer of the file itself");
  expect(0, {{"byteLength", 1000000000U}}, "expected it within");
  expect(0, {{"mode", "OTHER"}}, "the mode ATTRIBUTES, TRIANGLES or INDICES");
  expect(0, {{"filter", "OTHER"}}, "the filter NONE");
  expect(1, {{"filter", "EXPONENTIAL"}}, "no filter for indices");
  expect(0, {{"byteLength", 10}}, "as many elements as its 10 bytes can hold");
  expect(1, {{"byteLength", 2000}}, "as many elements as its 2000 bytes can hold");
  expect_length(0, {{"byteStride", 6}}, "a stride of 4 to 256");
  expect_length(0, {{"byteStride", 12}}, "found damaged data");
  expect_length(0, {{"filter", "OCTAHEDRAL"}, {"byteStride", 12}}, "another stride");
  expect_length(0, {{"count", 2384}}, "found damaged data");
  expect_length(1, {{"byteStride", 3}}, "indices of 2 or 4 bytes");
  expect_length(1, {{"count", 14399}}, "3 indices for each triangle");
  expect_length(0, {{"count", 100000000U}}, "as many elements as its");
  Packed damaged;
  damaged.binary[0] = 'x';
  EXPECT_TRUE(refused(decode_glb(damaged.file(), "x"), ErrorKind::bad_input, "damaged data"));
}

/// The tetrahedron of `Plain`, by meshoptimizer itself.
struct Filtered {
  Json json = Plain().json;
  std::string binary;

  void compress(std::size_t view, const std::string& stream, Json extension) {
    extension.update({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", stream.size()}});
    Json& parent = json["bufferViews"][view];
    parent = {{"buffer", 1},
              {"byteLength", extension["count"].get<int>() * extension["byteStride"].get<int>()}};
    parent["extensions"]["EXT_meshopt_compression"] = std::move(extension);
    binary += stream;
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
  }

  Filtered() {
    // The exponent is in the upper 8 bits, the mantissa in the lower 24: 1 is 2 * 2^-1.
    constexpr std::uint32_t kOne = 0xFF000002;
    const std::vector<std::uint32_t> filtered{0, 0, 0, kOne, 0, 0, 0, kOne, 0, 0, 0, kOne};
    std::string stream(meshopt_encodeVertexBufferBound(4, 12), '\0');
    auto* const to = reinterpret_cast<unsigned char*>(stream.data());
    stream.resize(meshopt_encodeVertexBuffer(to, stream.size(), filtered.data(), 4, 12));
    compress(0, stream,
             {{"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}, {"count", 4}, {"byteStride", 12}});
    std::vector<std::uint32_t> corners;
    for (const auto& triangle : tetrahedron().triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    stream.assign(meshopt_encodeIndexSequenceBound(12, 4), '\0');
    auto* const next = reinterpret_cast<unsigned char*>(stream.data());
    stream.resize(meshopt_encodeIndexSequence(next, stream.size(), corners.data(), 12));
    compress(1, stream, {{"mode", "INDICES"}, {"count", 12}, {"byteStride", 2}});
    json["buffers"].push_back({{"byteLength", 72}});
  }
};

TEST(Glb, ReadsFiltersAndSequences) {
  Filtered filtered;
  const auto volume = [](const Filtered& file) {
    return decode_glb(glb_of(file.json, file.binary), "x").map(signed_volume);
  };
  EXPECT_NEAR(volume(filtered).value(), 1e9 / 6.0, 1.0);
  filtered.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"].erase("filter");
  EXPECT_FALSE(volume(filtered));
}

#else

TEST(Glb, ReportsThatMeshoptIsNotInThisBuild) {
  const std::string because = "this build has no meshoptimizer";
  EXPECT_TRUE(
      refused(encode_glb(tetrahedron(), {.glb = GlbMesh::meshopt}), ErrorKind::bad_input, because));
}

#endif

}  // namespace
}  // namespace clay::solid
