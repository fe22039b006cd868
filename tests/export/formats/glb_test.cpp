#include "claystack/export/formats.hpp"
#include "core/little_endian.hpp"
#include "core/material.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

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

TEST(Glb, KeepsTheErrorLimitAndItsAccessorsAreTrue) {
  const TriangleMesh mesh = samples::torus(60, 40);
  for (const double limit : {0.5, 0.01, 0.001}) {
    FileContents contents{.name = "a \"pot\"", .notes = {{"process", "sla"}}};
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
    const auto max = json["accessors"][0]["max"];
    EXPECT_NEAR(max[0].get<double>(), 0.055, 2e-3 * limit);
    EXPECT_NEAR(max[1].get<double>(), 0.015, 2e-3 * limit);
    double highest = 0.0;
    for (const glm::dvec3& point : read.points) highest = std::max(highest, point.z);
    EXPECT_NEAR(max[1].get<double>(), highest / 1000.0, 1e-8);
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
  expect(changed("/accessors/0/count", 5), "expected 5 values within bufferView 0");
  expect(changed("/accessors/0/count", 4000000000U), "values within bufferView 0");
  expect(changed("/accessors/1/count", 11), "3 corners for each triangle");
  expect(changed("/accessors/0/componentType", 5123), "POSITION: expected 3 float32");
  expect(changed("/accessors/0/sparse", Json::object()), "no sparse accessor");
  expect(changed("/bufferViews/1/byteOffset", 60), "within the 72 bytes of the buffer");
  expect(changed("/buffers/0/uri", "https://example.org"), "the buffer of the file itself");
  expect(changed("/extensionsRequired", {"EXT_meshopt_compression"}), "no required extension but");
  expect(changed("/nodes/0/children", {0}), "expected a tree of nodes");
  expect(changed("/nodes/0/mesh", 7), "meshes: expected the number of one of 1, found 7");
  expect(changed("/scenes/0/nodes", Json::array()), "triangles, found 0");
  Plain wrong;
  wrong.binary[48] = 4;
  expect(wrong.file(), "index 1: expected the number of one of 4 points, found 4");
  Plain huge;
  store_f32(huge.binary.data(), 1e9F);
  expect(huge.file(), "expected a coordinate within");
  Json deep;
  for (int i = 0; i < 100; ++i) deep = Json::array({deep});
  expect(changed("/extras", deep), "nested at most 32 deep");
}

}  // namespace
}  // namespace clay::solid
