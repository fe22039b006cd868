#include "claystack/export/formats.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace clay::solid {
namespace {

using samples::refused;
using samples::tetrahedron;

const std::string kTetrahedronBody =
    "0 0 0\n10 0 0\n0 10 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

std::string ply_text(const std::string& encoding = "ascii", const std::string& body = {}) {
  return "ply\nformat " + encoding +
         " 1.0\ncomment made by hand\nobj_info none\nelement vertex 4\nproperty float x\n"
         "property float y\nproperty float z\nelement face 4\n"
         "property list uchar int vertex_indices\nend_header\n" +
         (body.empty() ? kTetrahedronBody : body);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

/// The tetrahedron with every number in this byte order, as double and int16.
std::string ply_binary(std::endian order) {
  std::string body;
  const auto add = [&](auto value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (order != std::endian::native) std::ranges::reverse(bytes);
    body += bytes;
  };
  for (const glm::dvec3& point : tetrahedron().points)
    for (int axis = 0; axis < 3; ++axis) add(point[axis]);
  for (const auto& triangle : tetrahedron().triangles) {
    add(std::int32_t{3});
    for (const std::uint32_t index : triangle) add(static_cast<std::int16_t>(index));
  }
  std::string file =
      ply_text(order == std::endian::big ? "binary_big_endian" : "binary_little_endian", body);
  for (const char* axis : {"x", "y", "z"})
    file = with(file, std::string("float ") + axis, std::string("double ") + axis);
  return with(file, "uchar int vertex_indices", "int short vertex_index");
}

// ---- writing

RC_GTEST_PROP(Ply, KeepsEveryBitAndIndex, ()) {
  const TriangleMesh mesh = *samples::any_mesh();
  const std::vector<float> walls(mesh.points.size(), 3.0F);
  for (const std::string& bytes : {encode_ply(mesh, "any"), encode_ply(mesh, "any", walls)}) {
    const auto read = decode_ply(bytes, "x").value();
    RC_ASSERT(read == rounded_to_float(mesh));
    RC_ASSERT(!samples::has_negative_zero(read));
  }
}

TEST(Ply, WritesTheDocumentedLayout) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment claystack: units mm\ncomment a_pot\n"
      "comment thickness: of the wall, in mm\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nproperty float thickness\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::vector<float> walls{1.0F, 2.0F, 3.0F, 4.5F};
  const std::string bytes = encode_ply(tetrahedron(), "a\npot", walls);
  ASSERT_EQ(bytes.substr(0, header.size()), header);
  ASSERT_EQ(bytes.size(), header.size() + 4 * 16 + 4 * 13);
  float values[4];
  std::memcpy(values, bytes.data() + header.size() + 3 * 16, sizeof values);
  EXPECT_EQ(values[2], 10.0F);
  EXPECT_EQ(values[3], 4.5F);
}

// ---- reading

TEST(Ply, ReadsTextWithAttributesThatAreNotFinite) {
  const std::string file =
      with(with(ply_text(), "property float z\n", "property float z\nproperty float nx\n"),
           kTetrahedronBody.substr(0, 27), "0 0 0 nan\n10 0 0 inf\n0 10 0 0\n0 0 10 0\n");
  std::vector<std::string> notes;
  EXPECT_EQ(decode_ply(file, "x", {.notes = &notes}), tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"line 13: NaN or infinity in 2 numbers of normals or "
                                            "other attributes, which are not used"});
}

TEST(Ply, MergesEqualPointsThatTrianglesDoNotShare) {
  const char* const apart =
      "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty "
      "float "
      "z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n0 10 0\n10 0 0\n0 0 0\n10 0 0\n0 0 10\n10 0 0\n0 10 0\n0 0 10\n0 0 0\n0 0 10\n0 10 "
      "0\n3 0 1 2\n3 3 4 5\n3 6 7 8\n3 9 10 11\n";
  std::vector<std::string> notes;
  EXPECT_EQ(decode_ply(apart, "x", {.notes = &notes}).value().points.size(), 4u);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(Ply, ReadsTextAndBothByteOrders) {
  EXPECT_EQ(decode_ply(ply_text(), "x").value(), tetrahedron());
  EXPECT_EQ(decode_ply(ply_binary(std::endian::little), "x").value(), tetrahedron());
  EXPECT_EQ(decode_ply(ply_binary(std::endian::big), "x").value(), tetrahedron());
}

TEST(Ply, PassesOverOtherPropertiesAndElements) {
  const std::string file =
      "ply\r\nformat ascii 1.0\r\nelement material 2\r\nproperty list uchar float parts\r\n"
      "element face 1\r\nproperty uchar red\r\nproperty list uchar uint vertex_index\r\n"
      "property list uchar float texcoord\r\nelement vertex 4\r\nproperty float nx\r\n"
      "property double z\r\nproperty int y\r\nproperty float x\r\nend_header\r\n"
      "2 0.5 1\r\n0\r\n255 4 0 1 2 3 6 0 0 1 0 1 1\r\n1 5 0 0\r\n1 5 0 1\r\n1 5 1 1\r\n1 5 1 0";
  const TriangleMesh expected{{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(decode_ply(file, "x").value(), expected);
}

/// Only the list of whole numbers names corners.
TEST(Ply, ReadsOneListOfCorners) {
  const std::string two = with(ply_text(), "property list uchar int vertex_indices",
                               "property list uchar float vertex_index\n"
                               "property list uchar int vertex_indices");
  std::string file = two.substr(0, two.find("3 0 2 1"));
  for (const char* corners : {"0 2 1", "0 1 3", "1 2 3", "0 3 2"})
    file += std::string("3 0.5 1 2 3 ") + corners + "\n";
  EXPECT_EQ(decode_ply(file, "x").value(), tetrahedron());
}

TEST(Ply, NotesStrayLinesBeforeTheElements) {
  const std::string file =
      with(ply_text(), "format ascii 1.0\n", "format ascii 1.0\nCreated by a program\nv2\n");
  std::vector<std::string> notes;
  EXPECT_EQ(decode_ply(file, "x", {.notes = &notes}).value(), tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"line 3: 2 lines before the mesh were not read"});
  // Among the elements it may be a property that was mistyped.
  EXPECT_TRUE(refused(decode_ply(with(ply_text(), "property float z\n", "propert float z\n"), "p"),
                      ErrorKind::bad_input, "found 'propert float z'"));
}

TEST(Ply, RefusesWhatIsNoMesh) {
  const auto expect = [](const std::string& file, const std::string& because) {
    EXPECT_TRUE(refused(decode_ply(file, "p.ply"), ErrorKind::bad_input, because)) << file;
  };
  expect("", "p.ply:0: expected ply, found an empty file");
  expect("solid\n", "expected ply");
  expect("ply\nformat ascii 1.0\n", "expected end_header");
  expect(with(ply_text(), "ascii 1.0", "ascii 2.0"), "p.ply:2: expected format");
  expect(with(ply_text(), "format ascii 1.0\n", ""), "expected a line format");
  expect(with(ply_text(), "element face 4", "element faces 4"), "found no face");
  expect(with(ply_text(), "property float y\n", ""), "expected one property y");
  expect(with(ply_text(), "uchar int", "float int"), "p.ply:10: expected property");
  expect(with(ply_text(), "uchar int", "uchar float"), "a list of whole numbers");
  expect(with(ply_text(), "element face 4", "element vertex 4"), "found it twice");
  expect(with(ply_text(), "element vertex 4", "element vertex 4000000000"),
         "p.ply:5: expected a count that the file's");
  expect(with(ply_text(), "element face 4", "element face -4"), "expected a count of elements");
}

TEST(Ply, RefusesBadValues) {
  const auto expect = [](const std::string& file, const std::string& because) {
    EXPECT_TRUE(refused(decode_ply(file, "p.ply"), ErrorKind::bad_input, because)) << file;
  };
  expect(with(ply_text(), "3 0 2 1", "3 0 2 4"),
         "p.ply:16: expected the number of a vertex, from 0 to 3, found 4");
  expect(with(ply_text(), "3 0 2 1", "3 0 2 -1"), "found -1");
  expect(with(ply_text(), "3 0 2 1", "2 0 2"), "a face of 3 to 65536 corners, found 2");
  expect(with(ply_text(), "10 0 0", "nan 0 0"), "p.ply:13: expected a coordinate");
  expect(with(ply_text(), "3 0 3 2\n", ""), "the end of the line or file");
  expect(ply_text() + "9\n", "expected the end of the file after its elements");
  std::string binary = ply_binary(std::endian::little);
  expect(binary + "x", "found 1 more byte");
  expect(binary.substr(0, binary.size() - 1), "face 4: the file ends early");
  const std::size_t body = binary.find("end_header\n") + 11;
  const double bad = std::nan("");
  std::memcpy(binary.data() + body + 8, &bad, sizeof bad);
  expect(binary, "p.ply: vertex 1: expected a coordinate");
}

}  // namespace
}  // namespace clay::solid
