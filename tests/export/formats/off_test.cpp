#include "claystack/export/formats.hpp"
#include "tests/export/formats/refused.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>

namespace clay::solid {
namespace {

using samples::refused;
using samples::tetrahedron;

TEST(Off, ReadsCommentsColoursAndNormals) {
  for (const char* file :
       {"OFF\n4 4 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n",
        "OFF 4 4 6\n# points\n0 0 0 # the first\n10 0 0\n\n0 10 0\n0 0 10\n3 0 2 1 255 0 0\n"
        "3 0 1 3 0.5 0.5 0.5 1\n3 1 2 3 7\n3 0 3 2",
        "COFF\r\n4 4 0\r\n0 0 0 1 1 1 1\r\n10 0 0 1 1 1 1\r\n0 10 0 1 1 1 1\r\n0 0 10 1 1 1 1\r\n"
        "3 0 2 1\r\n3 0 1 3\r\n3 1 2 3\r\n3 0 3 2\r\n",
        "COFF\n4 4 0#of each\n0 0 0#red\n10 0 0 1 0 0#red 2\n0 10 0# 3 4\n0 0 10\n3 0 2 1#\n"
        "3 0 1 3 #\n3 1 2 3\n3 0 3 2#last",
        "STCNOFF\n4 4 0\n0 0 0 0 0 1 9 9 9 0 0\n10 0 0 0\n0 10 0 0\n0 0 10 0\n3 0 2 1\n3 0 1 3\n"
        "3 1 2 3\n3 0 3 2\n"})
    EXPECT_EQ(decode_off(file, "x").value(), tetrahedron()) << file;
}

TEST(Off, ReadsNormalsThatAreNotFinite) {
  std::vector<std::string> notes;
  const char* const file =
      "NOFF\n4 4 0\n0 0 0 nan nan nan\n10 0 0 0 0 1\n0 10 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n"
      "3 0 3 2\n";
  EXPECT_EQ(decode_off(file, "x", {.notes = &notes}), tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"line 3: NaN or infinity in 3 numbers of normals or "
                                            "other attributes, which are not used"});
}

TEST(Off, ReadsAFileWithoutKeywordWithANote) {
  std::vector<std::string> notes;
  const char* const file =
      "# points\n4 4 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  EXPECT_EQ(decode_off(file, "x", {.notes = &notes}).value(), tetrahedron());
  EXPECT_EQ(notes, std::vector<std::string>{"line 2: the file begins without the keyword OFF"});
  EXPECT_TRUE(decode_off(file, "x"));
}

TEST(Off, MergesEqualPointsThatTrianglesDoNotShare) {
  // Each triangle of the tetrahedron has its own corners.
  const TriangleMesh whole = tetrahedron();
  std::string apart = "OFF\n12 4 0\n", faces;
  for (const auto& triangle : whole.triangles) {
    for (const std::uint32_t v : triangle) {
      const glm::dvec3& p = whole.points[v];
      apart += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    const auto first = static_cast<int>(&triangle - whole.triangles.data()) * 3;
    faces += "3 " + std::to_string(first) + " " + std::to_string(first + 1) + " " +
             std::to_string(first + 2) + "\n";
  }
  std::vector<std::string> notes;
  const auto mesh = decode_off(apart + faces, "x", {.notes = &notes}).value();
  EXPECT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(notes, std::vector<std::string>{"triangles do not share their points in the file: 8 "
                                            "equal points merged"});
}

TEST(Off, KeepsEqualPointsOfClosedShells) {
  // Two tetrahedra that touch at equal points: as written, each is closed.
  const std::string points = "0 0 0\n10 0 0\n0 10 0\n0 0 10\n";
  const std::string file = "OFF\n8 8 0\n" + points + points +
                           "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
                           "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 4 7 6\n";
  EXPECT_EQ(decode_off(file, "x").value().points.size(), 8u);
}

TEST(Off, ReadsPolygonsAsFans) {
  const auto mesh = decode_off("OFF\n4 1 0\n0 0 0 1 0 0 1 1 0 0 1 0\n4 0 1 2 3\n", "x");
  EXPECT_FALSE(mesh);  // the rest of a vertex's line is its colour
  const auto square = decode_off("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "x");
  EXPECT_EQ(square.value().triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Off, RefusesOtherKindsAndBadValues) {
  const std::string points = "0 0 0\n10 0 0\n0 10 0\n";
  const auto expect = [](const std::string& file, const std::string& because) {
    EXPECT_TRUE(refused(decode_off(file, "p.off"), ErrorKind::bad_input, because)) << file;
  };
  expect("", "p.off:1: expected OFF");
  expect("4OFF\n3 1 0\n", "expected OFF, COFF, NOFF or STOFF, found '4OFF'");
  expect("OFF BINARY\n", "found binary OFF");
  expect("1.5 4 0\n", "expected OFF, COFF, NOFF or STOFF, found '1.5'");
  expect("4 1 0\n0 0 0\n10 0 0\n0 10 0\n", "expected a coordinate");
  expect("OFF\n3 0 0\n" + points, "triangles, found 0");
  expect("OFF\n3 1 0\n" + points + "3 0 1 3\n",
         "p.off:6: expected the number of a vertex, from 0 to 2, found 3");
  expect("OFF\n3 1 0\n" + points + "3 0 1 -1\n", "found -1");
  expect("OFF\n3 1 0\n" + points + "2 0 1\n", "a face of 3 to 65536 corners, found 2");
  expect("OFF\n3 1 0\n" + points, "the end of the line or file");
  expect("OFF\n3 1 0\n" + points + "3 0 1 2\n3 0 1 2\n", "the end of the file after its faces");
  expect("OFF\n4000000000 1 0\n" + points, "expected a count of vertices that the file's");
  expect("OFF\n3 1 0\n0 0 inf\n", "expected a coordinate");
}

}  // namespace
}  // namespace clay::solid
