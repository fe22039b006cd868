#include "claystack/export/formats.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <draco/compression/encode.h>
#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>

#include <cstring>
#include <utility>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace clay::solid {
namespace {

using samples::largest_move;
using samples::tetrahedron;
using samples::torus;

std::string message_of(const Result<TriangleMesh>& mesh) {
  return mesh ? "no error" : mesh.error().message;
}

bool in_range(const TriangleMesh& mesh) {
  return std::ranges::all_of(mesh.triangles, [&](const auto& triangle) {
    return std::ranges::max(triangle) < mesh.points.size();
  });
}

TEST(ReadDrc, RefusesEveryTruncation) {
  const std::string whole = encode_drc(torus(6, 5), {}).value();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string message =
        message_of(decode_drc(std::string_view(whole).substr(0, size), "pot.drc"));
    EXPECT_EQ(message.rfind("pot.drc: ", 0), 0u) << "cut at " << size << ": " << message;
    EXPECT_GT(message.size(), std::string_view("pot.drc: Draco: ").size());
  }
  EXPECT_EQ(message_of(decode_drc(whole + "xy", "pot.drc")),
            "pot.drc: expected the end of the file after the mesh, found 2 more bytes");
}

TEST(ReadDrc, ErrorsNameTheFaultInTheHeader) {
  const std::string good = encode_drc(tetrahedron(), {}).value();
  const auto with = [&](std::size_t at, int value) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(value);
    return message_of(decode_drc(bytes, "pot.drc"));
  };
  EXPECT_EQ(with(0, 'd'), "pot.drc: expected a Draco file, which begins with DRACO");
  EXPECT_EQ(with(5, 0), "pot.drc: expected Draco version 1.0 to 2.2, found 0.2");
  EXPECT_EQ(with(5, 3), "pot.drc: expected Draco version 1.0 to 2.2, found 3.2");
  EXPECT_EQ(with(6, 255), "pot.drc: expected Draco version 1.0 to 2.2, found 2.255");
  EXPECT_EQ(with(7, 0), "pot.drc: expected a triangle mesh, found Draco geometry 0");
  EXPECT_EQ(with(8, 2), "pot.drc: expected Draco mesh method 0 or 1, found 2");
  EXPECT_EQ(message_of(decode_drc("DRACO\2\2", "pot.drc")), "pot.drc: the Draco header ends early");
}

/// A tetrahedron in the sequential encoding, uncompressed, as the versions lay it out. Draco writes
/// its newest version only.
std::string old_file(int major, int minor) {
  const int version = 256 * major + minor;
  std::string bytes = "DRACO";
  const auto byte = [&](int value) { bytes += static_cast<char>(value); };
  const auto whole = [&](std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) byte(static_cast<int>(value >> shift & 0xFF));
  };
  byte(major), byte(minor);
  byte(1), byte(0);  // a mesh, sequential
  byte(0), byte(0);  // flags
  if (version < 0x0202)
    whole(4), whole(4);  // triangles, points
  else
    byte(4), byte(4);
  byte(1);  // indices as they are
  for (const int index : {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}) byte(index);
  byte(1);  // one decoder of attributes
  if (version < 0x0200)
    whole(1);
  else
    byte(1);                           // one attribute:
  byte(0), byte(9), byte(3), byte(0);  // positions of 3 float32, not normalised
  byte(0);
  if (version < 0x0103) byte(0);  // its id
  byte(0);                        // as they are
  for (const float value : {0.F, 0.F, 0.F, 10.F, 0.F, 0.F, 0.F, 10.F, 0.F, 0.F, 0.F, 10.F}) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    bytes.append(raw, 4);
  }
  return bytes;
}

TEST(ReadDrc, ReadsOlderVersions) {
  for (const auto& [major, minor] :
       {std::pair{1, 0}, {1, 1}, {1, 2}, {1, 3}, {2, 0}, {2, 1}, {2, 2}}) {
    const auto mesh = decode_drc(old_file(major, minor), "pot.drc");
    ASSERT_TRUE(mesh) << major << "." << minor << ": " << mesh.error().message;
    EXPECT_EQ(mesh->points,
              (std::vector<glm::dvec3>{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}}));
    EXPECT_EQ(mesh->triangles, (std::vector<std::array<std::uint32_t, 3>>{
                                   {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}));
    EXPECT_FALSE(decode_drc(old_file(major, minor) + "x", "pot.drc"));
  }
  EXPECT_FALSE(decode_drc(old_file(0, 9), "pot.drc"));
}

/// Seven bits per byte, the lowest first.
std::string packed(std::uint32_t value) {
  std::string bytes;
  for (; value >= 0x80U; value >>= 7) bytes += static_cast<char>(value | 0x80U);
  return bytes + static_cast<char>(value);
}

TEST(ReadDrc, RefusesCountsThatWouldTakeGigabytes) {
  // Draco allocates by the counts at the start, before it finds that the file ends.
  const auto edgebreaker = [](std::uint32_t points, std::uint32_t triangles, std::uint32_t splits) {
    return std::string("DRACO\2\2\1\1\0\0\0", 12) + packed(points) + packed(triangles) + '\0' +
           packed(4) + packed(splits);
  };
  const auto sequential = [](std::uint32_t points, std::uint32_t triangles) {
    return std::string("DRACO\2\2\1\0\0\0", 11) + packed(triangles) + packed(points);
  };
  const std::string triangles = "pot.drc: expected 1 to 20000000 triangles, found ",
                    points = "pot.drc: expected at most 60000000 points, found ";
  EXPECT_EQ(message_of(decode_drc(edgebreaker(4, 300'000'000, 0), "pot.drc")),
            triangles + "300000000");
  EXPECT_EQ(message_of(decode_drc(edgebreaker(4, 0, 0), "pot.drc")), triangles + "0");
  EXPECT_EQ(message_of(decode_drc(edgebreaker(400'000'000, 4, 0), "pot.drc")),
            points + "400000000");
  EXPECT_EQ(message_of(decode_drc(edgebreaker(4, 4, 400'000'000), "pot.drc")),
            points + "400000004");
  EXPECT_EQ(message_of(decode_drc(sequential(4, 20'000'001), "pot.drc")), triangles + "20000001");
  EXPECT_EQ(message_of(decode_drc(sequential(60'000'001, 4), "pot.drc")), points + "60000001");
}

TEST(ReadDrc, StatesItsTrianglesBeforeDecoding) {
  DracoSettings settings;
  const std::string plain = encode_drc(torus(6, 5), settings).value();
  EXPECT_EQ(drc_triangles(plain, "pot.drc").value(), 60U);
  const DracoClaims claims{.volume_mm3 = 1.0, .vertex_error_mm = 0.01};
  EXPECT_EQ(drc_triangles(encode_drc(torus(6, 5), settings, &claims).value(), "pot.drc").value(),
            60U);
  for (const auto& [major, minor] : {std::pair{1, 0}, {2, 1}, {2, 2}})
    EXPECT_EQ(drc_triangles(old_file(major, minor), "pot.drc").value(), 4U);
}

/// A mesh made by Draco itself, with the properties that the test sets.
struct DracoFile {
  int components = 3;
  draco::DataType type = draco::DT_FLOAT32;
  draco::GeometryAttribute::Type meaning = draco::GeometryAttribute::POSITION;
  int method = draco::MESH_SEQUENTIAL_ENCODING;
  float height = 10.0F;

  [[nodiscard]] std::string encode() const {
    draco::Mesh mesh;
    mesh.set_num_points(4);
    draco::GeometryAttribute layout;
    layout.Init(meaning, nullptr, static_cast<std::uint8_t>(components), type, false,
                4 * components, 0);
    const int id = mesh.AddAttribute(layout, true, 4);
    const float corners[4][4] = {{0, 0, 0, 0}, {10, 0, 0, 0}, {0, 10, 0, 0}, {0, 0, height, 0}};
    for (std::uint32_t i = 0; i < 4; ++i) {
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), corners[i]);
    }
    for (const auto& [a, b, c] : tetrahedron().triangles) {
      mesh.AddFace({draco::PointIndex(a), draco::PointIndex(b), draco::PointIndex(c)});
    }
    draco::ExpertEncoder encoder(mesh);
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {buffer.data(), buffer.size()};
  }
};

TEST(ReadDrc, ReadsFilesOfOtherWriters) {
  EXPECT_EQ(decode_drc(DracoFile{}.encode(), "x").value(), tetrahedron());
  const auto edgebreaker = DracoFile{.method = draco::MESH_EDGEBREAKER_ENCODING}.encode();
  EXPECT_EQ(largest_move(decode_drc(edgebreaker, "x").value(), tetrahedron()), 0.0);
}

TEST(ReadDrc, RefusesMeshesWithoutUsablePositions) {
  const auto message = [](const DracoFile& file) {
    return message_of(decode_drc(file.encode(), "pot.drc"));
  };
  EXPECT_EQ(message({.components = 4}), "pot.drc: expected positions of 3 float32");
  EXPECT_EQ(message({.type = draco::DT_INT32}), "pot.drc: expected positions of 3 float32");
  EXPECT_EQ(message({.meaning = draco::GeometryAttribute::NORMAL}),
            "pot.drc: expected a position attribute, found none");
  EXPECT_EQ(message({.height = 2e6F}),
            "pot.drc: position 4: expected a coordinate within +-1e6 mm, found 2e+06");
  EXPECT_EQ(message({.height = std::nanf("")}),
            "pot.drc: position 4: expected a coordinate within +-1e6 mm, found nan");
}

/// Draco 1.5 returns the indices of a sequential mesh unchecked.
TEST(ReadDrc, FlippedBytesNeverGiveAnIndexOutOfRange) {
  bool named = false;
  std::vector<std::string> files{DracoFile{}.encode(), encode_drc(torus(5, 4), {}).value()};
  for (const int minor : {0, 1, 2, 3}) files.push_back(old_file(1, minor));
  for (const int minor : {0, 1}) {
    files.push_back(old_file(2, minor));
    files.push_back(files[1]);  // read by the rules of that version, mostly nonsense
    files.back()[6] = static_cast<char>(minor);
  }
  for (const std::string& good : files) {
    for (std::size_t at = 0; at < good.size(); ++at) {
      for (int bit = 0; bit < 8; ++bit) {
        std::string bytes = good;
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
        const auto mesh = decode_drc(bytes, "pot.drc");
        if (mesh) {
          EXPECT_TRUE(in_range(*mesh)) << "bit " << bit << " of byte " << at;
        } else {
          named |= mesh.error().message.find("expected the number of a point, from 0 to 3") !=
                   std::string::npos;
        }
      }
    }
  }
  EXPECT_TRUE(named);
}

TEST(ReadDrc, RefusesPointClouds) {
  draco::PointCloud cloud;
  cloud.set_num_points(4);
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  cloud.AddAttribute(layout, true, 4);
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  ASSERT_TRUE(encoder.EncodePointCloudToBuffer(cloud, &buffer).ok());
  EXPECT_EQ(message_of(decode_drc({buffer.data(), buffer.size()}, "pot.drc")),
            "pot.drc: expected a triangle mesh, found Draco geometry 0");
}

}  // namespace
}  // namespace clay::solid
