#include "claystack/export/formats.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace clay::solid {
namespace {

using samples::tetrahedron;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::vector<glm::dvec3> kSquarePoints = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

std::string obj_message(const std::string& text) {
  const auto mesh = decode_obj(text, "pot.obj");
  return mesh ? "no error" : mesh.error().message;
}

Triangles triangles_of(const std::string& text) {
  const auto mesh = decode_obj(text, "pot.obj");
  EXPECT_TRUE(mesh.has_value()) << mesh.error().message << "\n" << text;
  return mesh ? mesh->triangles : Triangles{};
}

// ---- writing

RC_GTEST_PROP(Obj, KeepsEveryBitAndIndex, ()) {
  const TriangleMesh mesh = *samples::any_mesh();
  const auto read = decode_obj(encode_obj(mesh, "any"), "x").value();
  RC_ASSERT(read == rounded_to_float(mesh));
  RC_ASSERT(!samples::has_negative_zero(read));
}

TEST(Obj, WritesTheShortestTextThatReadsBack) {
  const TriangleMesh mesh{{{0.1, -0.0, 1e-30}, {16777216, 0, 0}, {0, 1.0 / 3.0, 0}}, {{2, 1, 0}}};
  EXPECT_EQ(encode_obj(mesh, "my pot\nf 9 9 9\\"),
            "# claystack: units mm\no my pot_f 9 9 9_\nv 0.1 0 1e-30\nv 16777216 0 0\n"
            "v 0 0.33333334 0\nf 3 2 1\n");
}

TEST(Obj, MergesEqualPointsThatTrianglesDoNotShare) {
  const char* const apart =
      "v 0 0 0\nv 0 10 0\nv 10 0 0\nv 0 0 0\nv 10 0 0\nv 0 0 10\nv 10 0 0\nv 0 10 0\nv 0 0 "
      "10\nv 0 0 0\nv 0 0 10\nv 0 10 0\nf 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\n";
  std::vector<std::string> notes;
  EXPECT_EQ(decode_obj(apart, "x", {.notes = &notes}).value().points.size(), 4u);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(Obj, ReadsAttributesThatAreNotFinite) {
  for (const std::string line : {"vn nan -nan(ind) 0\n", "vt inf -1.#IND\n"}) {
    std::vector<std::string> notes;
    const auto mesh = decode_obj(kSquare + line + "f 1 2 3\n", "x", {.notes = &notes}).value();
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(notes, std::vector<std::string>{"line 5: NaN or infinity in 2 numbers of normals or "
                                              "other attributes, which are not used"});
  }
}

/// A backslash at the end of a comment does not continue the line.
TEST(Obj, ReadsCommentsAtTheEndOfALine) {
  const std::string text =
      "v 0 0 0 # first\nv 1 0 0#\nv 1 1 0 # C:\\\nv 0 1 0\nvn 0 0 1 # up\nf 1 2 3 # 4\nf 1 3 "
      "4#2\\\n"
      "#end";
  std::vector<std::string> notes;
  bool reads_less = false;
  const auto mesh = decode_obj(text, "x", {.notes = &notes, .slicer_reads_less = &reads_less});
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points, kSquarePoints);
  EXPECT_EQ(mesh->triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  // PrusaSlicer 2.5 refuses it.
  EXPECT_TRUE(reads_less);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(notes[0].starts_with("line 1: 5 lines of points or faces with a comment: "))
      << notes[0];
}

TEST(Obj, ShortensAnOverlongName) {
  const std::string text = encode_obj(tetrahedron(), std::string(100'000, 'n'));
  EXPECT_EQ(decode_obj(text, "x").value(), tetrahedron());
}

// ---- reading

TEST(Obj, ReadsEveryKindOfCorner) {
  const std::string rest = "vt 0 0\nvt 0.5\nvt 1 1 1\nvn 0 0 1\n";
  for (const char* face :
       {"f 1 2 3\n", "f 1/1 2/2 3/3\n", "f 1//1 2//1 3//1\n", "f 1/1/1 2/2/1 3/3/1\n",
        "f -4 -3 -2\n", "f -4/-3/-1 -3/-2/-1 3/-1/1\n", "f +1 2 3 \t\r\n"}) {
    EXPECT_EQ(triangles_of(kSquare + rest + face), (Triangles{{0, 1, 2}})) << face;
  }
}

TEST(Obj, AcceptsPointsWithWeightOrColour) {
  const auto mesh =
      decode_obj("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv +1 1e-50 0\nf 1 2 3\n", "x").value();
  EXPECT_EQ(mesh.points, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}));
}

TEST(Obj, SplitsPolygonsIntoFans) {
  EXPECT_EQ(triangles_of(kSquare + "f 1 2 3 4\n"), (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Obj, NegativeNumbersCountFromTheLatestVertex) {
  const std::string text = kSquare + "f -4 -3 -2\nv 0 0 1\nf -5 -1 1\n";
  EXPECT_EQ(triangles_of(text), (Triangles{{0, 1, 2}, {0, 4, 0}}));
}

TEST(Obj, AcceptsFacesBeforeTheirVertices) {
  EXPECT_EQ(triangles_of("f 1 2 3/1\n" + kSquare + "vt 0\n"), (Triangles{{0, 1, 2}}));
}

TEST(Obj, IgnoresStatementsWithoutSurface) {
  const std::string names = "#\no pot\ng a b \\\n c\ns off\nmtllib /dev/zero\nusemtl clay\n";
  const std::string text = names + kSquare + "l 1 2\np 1\n\n   \nf 1 2 3\n#end";
  EXPECT_EQ(triangles_of(text), (Triangles{{0, 1, 2}}));
}

TEST(Obj, CommentsEndAtTheirLine) {
  EXPECT_EQ(triangles_of("# C:\\pots\\\n" + kSquare + "f 2 3 4\n"), (Triangles{{1, 2, 3}}));
}

TEST(Obj, BackslashContinuesALine) {
  EXPECT_EQ(triangles_of(kSquare + "f 1 2\\\n 3 \\\r\n4\n"), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(obj_message(kSquare + "f 1 \\\n2 \\\n0\n"),
            "pot.obj:7: expected the number of a vertex, from 1 to 4, found 0");
}

TEST(Obj, KeepsPointsThatCoincide) {
  const std::string text = "v 0 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\nf 1 1 3\n";
  EXPECT_EQ(triangles_of(text), (Triangles{{0, 1, 2}, {0, 0, 2}}));
}

struct BadObj {
  std::string text;
  std::string says;
};

TEST(Obj, ErrorsNameTheLine) {
  std::string corners = "f";
  for (int i = 0; i < 65'537; ++i) corners += " 1";
  for (const BadObj& bad : std::vector<BadObj>{
           {"", "pot.obj: expected 1 to 20000000 triangles, found 0"},
           {kSquare, "pot.obj: expected 1 to 20000000 triangles, found 0"},
           {kSquare + "f 1 2 0\n",
            "pot.obj:5: expected the number of a vertex, from 1 to 4, found 0"},
           {kSquare + "f 1 2 5\n",
            "pot.obj:5: expected the number of a vertex, from 1 to 4, found 5"},
           {kSquare + "f 1 2 3\nf 1 2 -5\n",
            "pot.obj:6: expected the number of a vertex, from 1 to 4, found -5"},
           {"v 0 0 0\nf -1 -2 -3\nv 0 0 0\nv 0 0 0\n",
            "pot.obj:2: expected the number of a vertex, from 1 to 1, found -2"},
           {kSquare + "f 1 2 99999999999\n",
            "pot.obj:5: expected the number of a vertex, from 1 to 4, found 99999999999"},
           {kSquare + "f 1 2 99999999999999999999\n", "pot.obj:5: expected a whole number"},
           {kSquare + "f 1 2 -9223372036854775808\n",
            "pot.obj:5: expected the number of a vertex, from 1 to 4"},
           {kSquare + "f 1 2\n", "pot.obj:5: expected a face of at least 3 corners, found 2"},
           {kSquare + "f\n", "pot.obj:5: expected a face of at least 3 corners, found 0"},
           {kSquare + "f /1 /2 /3\n", "pot.obj:5: expected a whole number"},
           {kSquare + "vt 0\nvn 0 0 1\nf 1/1/1/1 2 3\n",
            "pot.obj:7: expected a whole number, found '1/1'"},
           {kSquare + "f 1.5 2 3\n", "pot.obj:5: expected a whole number, found '1.5'"},
           {kSquare + corners + "\n", "pot.obj:5: expected a face of at most 65536 corners"},
           {"v 0 0\n",
            "pot.obj:1: expected a coordinate within +-1e6 mm, found the end of the line or file"},
           {"v 0 0 x\n", "pot.obj:1: expected a coordinate within +-1e6 mm, found 'x'"},
           {"v 0 0 nan\n", "pot.obj:1: expected a coordinate"},
           {"v 0 0 1e7\n", "pot.obj:1: expected a coordinate"},
           {"v 0 0 0 0 0\n", "pot.obj:1: expected v with 3, 4 or 6 numbers, found 5"},
           {"v 0 0 0 0 0 0 0\n", "pot.obj:1: expected the end of the line, found '0'"},
           {"v 0 0 0 up\n", "pot.obj:1: expected a number, found 'up'"},
           {"vt\n", "pot.obj:1: expected a number, found the end of the line or file"},
           {"vt up\n", "pot.obj:1: expected a number, found 'up'"},
           {"vt 0 0 0 0\n", "pot.obj:1: expected the end of the line, found '0'"},
           {"vn 0 0\n", "pot.obj:1: expected a number, found the end of the line or file"},
           {"v 0 0 0\ncurv 0 1\n",
            "pot.obj:2: expected a statement of a polygon mesh, found 'curv'"},
           {kSquare + "f 1 2 3\nF 2 3 4\n",
            "pot.obj:6: expected a statement of a polygon mesh, found 'F'"},
           {kSquare + "f 1 2 3\nsurf 0 1 0 1 1 2 3\n",
            "pot.obj:6: expected a statement of a polygon mesh, found 'surf'"},
           {kSquare + "f 1 2 3\nhello\nvn 0 0 1\n",
            "pot.obj:6: expected a statement of a polygon mesh, found 'hello'"},
           {"vn 0 0 1\nhello\n", "pot.obj:2: expected a statement of a polygon mesh"},
           {"hello\n", "pot.obj: expected 1 to 20000000 triangles, found 0"},
           {kSquare + "f 1/x 2 3\n", "pot.obj:5: expected a whole number, found 'x'"},
           {kSquare + "f 1 2 3\\", "pot.obj:5: expected a whole number"},
           {kSquare + std::string("f 1 2\0 3\n", 9), "pot.obj:5: expected text, found a NUL byte"},
           {std::string("#\n#").append(std::size_t{17} << 20, 'x'),
            "pot.obj:2: expected a line of at most 16384 KiB"},
       }) {
    EXPECT_EQ(obj_message(bad.text).rfind(bad.says, 0), 0u)
        << "wanted: " << bad.says << "\nfound:  " << obj_message(bad.text);
  }
}

/// Faults that do not change the surface, as programs write them.
TEST(Obj, PassesOverWhatIsNoPartOfTheSurfaceWithANote) {
  struct Case {
    std::string text;
    std::vector<std::string> notes;
  };
  const std::string no_vt = "a face names a vt that the file does not define";
  const std::string no_vn = "a face names a vn that the file does not define";
  const std::string odd =
      " with a slash at the end of a corner, or on several lines: PrusaSlicer does not read such "
      "faces";
  for (const Case& c : std::vector<Case>{
           {kSquare + "f 1/ 2/ 3/\n", {"line 5: 1 face" + odd}},
           {kSquare + "f 1// 2// 3//\nf 1 2 3\nf 1 2/ 3\n", {"line 5: 2 faces" + odd}},
           {kSquare + "vt 0\nf 1/1/ 2/1/ 3/1/\n", {"line 6: 1 face" + odd}},
           {kSquare + "f 1 2 \\\n3\nf 1 2 3\n", {"line 5: 1 face" + odd}},
           {kSquare + "f 1/1 2/1 3/1\n", {"line 5: " + no_vt}},
           {kSquare + "f 1//1 2//1 3//1\nvn 0 0 1\n", {}},
           {kSquare + "f 1//1 2//1 3//1\n", {"line 5: " + no_vn}},
           {kSquare + "vt 0\nf 1/1 2/0 3/1\nf 1/-2 1 1\n", {"line 6: " + no_vt}},
           {kSquare + "vn 0 0 1\nf 1/9/2 2//1 3//1\n", {"line 6: " + no_vt, "line 6: " + no_vn}},
           {"# a\nMade by hand\n\nVersion 1.0 \\\n f\n" + kSquare + "f 1 2 3\n",
            {"line 2: 2 lines before the mesh were not read"}},
           {kSquare + "f 1 2 3\n<!-- end -->\n# a\ng b\nPK of something\n",
            {"line 6: 2 lines after the mesh were not read"}},
       }) {
    std::vector<std::string> notes;
    bool reads_less = false;
    const auto mesh = decode_obj(
        c.text, "pot.obj", {.repair = false, .notes = &notes, .slicer_reads_less = &reads_less});
    ASSERT_TRUE(mesh) << mesh.error().message << "\n" << c.text;
    EXPECT_EQ(mesh->triangles.front(), (std::array<std::uint32_t, 3>{0, 1, 2})) << c.text;
    EXPECT_EQ(mesh->points, kSquarePoints) << c.text;
    EXPECT_EQ(notes, c.notes) << c.text;
    EXPECT_EQ(reads_less, !notes.empty() && notes.back().ends_with(odd)) << c.text;
    EXPECT_TRUE(decode_obj(c.text, "pot.obj"));
  }
}

TEST(Obj, SkipsAByteOrderMark) {
  EXPECT_EQ(triangles_of("\xEF\xBB\xBF" + kSquare + "f 1 2 3\n"),
            triangles_of(kSquare + "f 1 2 3\n"));
}

TEST(Obj, AcceptsAFaceOf4096Corners) {
  std::string face = "f";
  for (int i = 0; i < 4096; ++i) face.append(" ").append(std::to_string(1 + i % 4));
  EXPECT_EQ(triangles_of(kSquare + face).size(), 4094u);
}

/// The bottom of a round vase, as CAD programs write it: one line of far more than 64 KiB.
TEST(Obj, ReadsAFaceOnALongLine) {
  constexpr int kCorners = 60'000;
  std::string text, face = "f";
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 6.283185307179586 * i / kCorners;
    text += "v " + std::to_string(1000 * std::cos(angle)) + " " +
            std::to_string(1000 * std::sin(angle)) + " 0\n";
    const std::string number = std::to_string(i + 1);
    face += " " + number + "/" + number + "/" + number;
  }
  face += std::string(std::size_t{5} << 20, ' ');
  EXPECT_EQ(triangles_of(text + face + "\nf 1 2 3\n").size(), kCorners - 2 + 1);
}

TEST(Obj, LeavesOutFacesOfTwoCornersForRepairs) {
  const std::string text = kSquare + "f 1 2\nf 1 2 3\nf 3\n";
  EXPECT_EQ(obj_message(text),
            "pot.obj:5: expected a face of at least 3 corners, found 2; a repair leaves it "
            "out");
  std::vector<std::string> notes;
  const auto mesh = decode_obj(text, "pot.obj", {.repair = true, .notes = &notes});
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(notes, std::vector<std::string>{"line 5: 2 faces of fewer than 3 corners left out"});
}

}  // namespace
}  // namespace clay::solid
