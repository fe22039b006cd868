#include "claystack/export/formats.hpp"
#include "tests/export/fallen/peer_program.hpp"
#include "tests/export/solid/mesh_generators.hpp"
#include "tests/fuzz/sample_meshes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace clay::solid {
namespace {

using samples::corners_of;
using samples::tetrahedron;
using samples::torus;

constexpr std::size_t kPrologue = 84;
constexpr std::size_t kFacet = 50;

template <class Number>
void overwrite(std::string& bytes, std::size_t at, Number value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

template <class Number>
Number read_at(const std::string& bytes, std::size_t at) {
  Number value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string message_of(const std::string& bytes) {
  const auto mesh = decode_stl(bytes, "pot.stl");
  return mesh ? "no error" : mesh.error().message;
}

std::string one_facet(const std::string& vertices) {
  return "solid a b\nfacet normal 0 0 1\nouter loop\n" + vertices + "endloop\nendfacet\nendsolid\n";
}

const std::string kThreeVertices = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";

// ---- writing

RC_GTEST_PROP(Stl, KeepsEveryBitInBothFormats, ()) {
  const TriangleMesh mesh = *samples::any_mesh();
  const auto binary = decode_stl(encode_stl_binary(mesh), "b").value();
  const auto text = decode_stl(encode_stl_ascii(mesh, "t"), "t").value();
  RC_ASSERT(corners_of(binary) == corners_of(rounded_to_float(mesh)));
  RC_ASSERT(text == binary);
  RC_ASSERT(samples::is_welded(binary));
  RC_ASSERT(!samples::has_negative_zero(binary));
}

TEST(Stl, FollowsTheBinaryLayout) {
  TriangleMesh mesh{{{1, 1, -0.0}, {3, 1, 0}, {1, 4, 0}, {5, 1, 0}}, {{0, 1, 2}, {0, 1, 3}}};
  const std::string bytes = encode_stl_binary(mesh);
  ASSERT_EQ(bytes.size(), kPrologue + 2 * kFacet);
  EXPECT_EQ(bytes.substr(0, 9), "claystack");
  EXPECT_EQ(read_at<std::uint32_t>(bytes, 80), 2u);
  // The normal of a triangle in the plane z = 0, its corners, and no attribute.
  const float first[12] = {0, 0, 1, 1, 1, 0, 3, 1, 0, 1, 4, 0};
  EXPECT_EQ(std::memcmp(bytes.data() + kPrologue, first, sizeof first), 0);
  EXPECT_EQ(read_at<std::uint16_t>(bytes, kPrologue + 48), 0u);
  // Three collinear corners have no normal.
  const float second[12] = {0, 0, 0, 1, 1, 0, 3, 1, 0, 5, 1, 0};
  EXPECT_EQ(std::memcmp(bytes.data() + kPrologue + kFacet, second, sizeof second), 0);
}

TEST(Stl, NormalsSurviveTinyTriangles) {
  const double tiny = std::numeric_limits<float>::denorm_min();
  const std::string bytes =
      encode_stl_binary({{{0, 0, 0}, {0, tiny, 0}, {0, 0, tiny}}, {{0, 1, 2}}});
  EXPECT_EQ(read_at<float>(bytes, kPrologue), 1.0F);
}

TEST(Stl, WritesTheShortestTextThatReadsBack) {
  const TriangleMesh mesh{{{0.1, -0.0, 1e-30}, {16777216, 0, 0}, {0, 1.0 / 3.0, 0}}, {{0, 1, 2}}};
  const std::string text = encode_stl_ascii(mesh, "a\nb\\");
  EXPECT_TRUE(text.starts_with("solid a_b_\nfacet normal ")) << text;
  EXPECT_NE(text.find("  outer loop\n    vertex 0.1 0 1e-30\n    vertex 16777216 0 0\n"
                      "    vertex 0 0.33333334 0\n  endloop\nendfacet\nendsolid a_b_\n"),
            text.npos)
      << text;
}

TEST(Stl, AdmeshAgrees) {
  const TriangleMesh mesh = torus(20, 10);
  for (const std::string& bytes : {encode_stl_binary(mesh), encode_stl_ascii(mesh, "torus")}) {
    const samples::ScratchFile file(".stl", bytes);
    const std::string output = samples::output_of("admesh " + file.path());
    EXPECT_NE(output.find("Number of facets                 :   400                 400"),
              output.npos)
        << output;
    EXPECT_NE(output.find("Total disconnected facets        :     0                   0"),
              output.npos);
    EXPECT_NE(output.find("Normals fixed         :     0"), output.npos);
  }
}

// ---- reading

TEST(Stl, WeldsOnlyEqualFloats) {
  const float one_up = std::nextafter(1.0F, 2.0F);
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {one_up, 0, 0}},
                          {{0, 1, 2}, {0, 3, 2}}};
  EXPECT_EQ(decode_stl(encode_stl_binary(mesh), "x").value(), mesh);
}

TEST(Stl, WeldsNegativeZeroWithZero) {
  // Many pairs, because a single one might collide in the hash table by chance.
  TriangleMesh mesh{{{1, 0, 0}, {2, 0, 0}}, {}};
  for (std::uint32_t i = 0; i < 50; ++i) {
    mesh.points.push_back({0, i, 0});
    mesh.triangles.insert(mesh.triangles.end(), 2, {0, 1, i + 2});
  }
  std::string bytes = encode_stl_binary(mesh);
  for (std::size_t i = 0; i < 50; ++i)
    overwrite(bytes, kPrologue + kFacet * (2 * i + i % 2) + 36, -0.0F);
  const auto read = decode_stl(bytes, "x").value();
  EXPECT_EQ(read, mesh);
  EXPECT_FALSE(samples::has_negative_zero(read));
}

TEST(Stl, SizeDistinguishesBinaryFromText) {
  std::string bytes = encode_stl_binary(torus(5, 4));
  bytes.replace(0, 6, "solid ");
  EXPECT_EQ(decode_stl(bytes, "x").value(),
            decode_stl(encode_stl_binary(torus(5, 4)), "x").value());
  bytes += '\0';
  EXPECT_EQ(message_of(bytes),
            "pot.stl: expected 2084 bytes of binary STL for the 40 facets it counts, found 2085 "
            "bytes; a repair reads the whole facets that are there");
}

TEST(Stl, IgnoresBinaryNormalsAndAttributes) {
  std::string bytes = encode_stl_binary(tetrahedron());
  overwrite(bytes, kPrologue, std::nanf(""));
  overwrite(bytes, kPrologue + 48, std::uint16_t{0x8123});
  EXPECT_EQ(corners_of(decode_stl(bytes, "x").value()), corners_of(tetrahedron()));
}

/// As some programs write them for facets without area.
TEST(Stl, ReadsTextWithNormalsThatAreNotFinite) {
  const TriangleMesh plain = decode_stl(one_facet(kThreeVertices), "x").value();
  for (const std::string word :
       {"nan", "-nan", "NaN", "-nan(ind)", "inf", "-inf", "-1.#IND", "1.#QNAN0", "1.#INF00"}) {
    std::string text = one_facet(kThreeVertices);
    text.replace(text.find("0 0 1"), 5, word + " " + word + " 1");
    std::vector<std::string> notes;
    EXPECT_EQ(decode_stl(text, "x", {.notes = &notes}), plain) << word;
    EXPECT_EQ(notes, std::vector<std::string>{"line 2: NaN or infinity in 2 numbers of normals or "
                                              "other attributes, which are not used"})
        << word;
  }
}

TEST(Stl, ReadsTextOfOtherWriters) {
  const TriangleMesh plain = decode_stl(one_facet(kThreeVertices), "x").value();
  EXPECT_EQ(plain, (TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
  std::string windows = one_facet(kThreeVertices);
  for (std::size_t at = 0; (at = windows.find('\n', at)) != windows.npos; at += 2) {
    windows.insert(at, 1, '\r');
  }
  std::string shouting = one_facet(kThreeVertices);
  std::ranges::transform(shouting, shouting.begin(),
                         [](unsigned char c) { return std::toupper(c); });
  for (const std::string& other :
       {windows, shouting,
        one_facet("vertex +0 -0. .0e+9\nvertex +1.0E0 1e-50 -1e-46\nvertex 0 1 0\n"),
        std::string("\xEF\xBB\xBF").append(one_facet(kThreeVertices)),
        std::string("\n  ").append(one_facet("\tvertex 0\n0 0 vertex 1 0 0 vertex 0 1 0 "))}) {
    EXPECT_EQ(decode_stl(other, "x").value(), plain) << other;
  }
}

TEST(Stl, JoinsSeveralSolids) {
  const std::string two =
      one_facet(kThreeVertices) + one_facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n");
  const auto mesh = decode_stl(two, "x").value();
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.points.size(), 4u);
}

struct BadText {
  std::string text;
  std::string says;
};

TEST(Stl, ErrorsNameTheLineInText) {
  const std::string head = "solid\n";
  for (const BadText& bad : std::vector<BadText>{
           {"",
            "pot.stl: expected an STL file: the word solid, or at least 84 bytes, found 0 bytes"},
           {"sol", "pot.stl: expected an STL file"},
           {"{\"schema\": \"claystack-pot-1\"" + std::string(100, ' '),
            "pot.stl: expected an STL file, found a pot"},
           {std::string("PK\x03\x04") + std::string(200, 'x'),
            "pot.stl: expected an STL file, found a zip archive, as 3MF is"},
           {"solid", "pot.stl:1: expected facet or endsolid, found the end of the line or file"},
           {"solid\nendsolid\n", "pot.stl: expected 1 to 20000000 triangles, found 0"},
           {"solids\n", "pot.stl:1: expected solid, found 'solids'"},
           {head + "facets\n", "pot.stl:2: expected facet or endsolid, found 'facets'"},
           {head + "facet 0 0 1\n", "pot.stl:2: expected normal, found '0'"},
           {head + "facet normal 0 0 up\n", "pot.stl:2: expected a number, found 'up'"},
           {head + "facet normal 0 0 1\ninner loop\n", "pot.stl:3: expected outer, found 'inner'"},
           {one_facet("vertex 0 0 0\nvertex 1 0 0\n"),
            "pot.stl:6: expected vertex, found 'endloop'"},
           {one_facet(kThreeVertices + "vertex 1 1 0\n"),
            "pot.stl:7: expected endloop, found 'vertex'"},
           {one_facet("vertex 0 0\nvertex 1 0 0\nvertex 0 1 0\n"),
            "pot.stl:5: expected a coordinate within +-1e6 mm, found 'vertex'"},
           {one_facet("vertex 0 0 inf\n"),
            "pot.stl:4: expected a coordinate within +-1e6 mm, found 'inf'"},
           {one_facet("vertex 0 0 NaN\n"), "pot.stl:4: expected a coordinate"},
           {one_facet("vertex 0 0 1000001\n"), "pot.stl:4: expected a coordinate"},
           {one_facet("vertex 0 0 1e400\n"), "pot.stl:4: expected a coordinate"},
           {one_facet("vertex 0 0 1,5\n"),
            "pot.stl:4: expected a coordinate within +-1e6 mm, found '1,5'"},
           {one_facet("vertex 0 0 0x1p3\n"), "pot.stl:4: expected a coordinate"},
           {one_facet("vertex 0 0 +-1\n"), "pot.stl:4: expected a coordinate"},
           {one_facet("vertex 0 0 1\x1b[31m\n"), "found '1?[31m'"},
           {one_facet(kThreeVertices) + "junk\n", "pot.stl:10: expected solid, found 'junk'"},
           {head + std::string("facet\0normal", 12), "pot.stl:2: expected text, found a NUL byte"},
           {head + std::string(70'000, ' '), "pot.stl:2: expected a line of at most 64 KiB"},
           {head + std::string(300, ' '), "pot.stl:2: expected facet or endsolid, found the end"},
       }) {
    EXPECT_NE(message_of(bad.text).find(bad.says), std::string::npos)
        << "wanted: " << bad.says << "\nfound:  " << message_of(bad.text);
  }
}

TEST(Stl, ErrorsNameTheLastLineOfTruncatedText) {
  const std::string whole = encode_stl_ascii(tetrahedron(), "pot");
  const std::size_t closed = whole.rfind("endsolid") + std::strlen("endsolid");
  for (std::size_t size = std::strlen("solid"); size < closed; ++size) {
    const std::string cut = whole.substr(0, size);
    const auto lines = 1 + std::count(cut.begin(), cut.end() - 1, '\n');
    const std::string place = std::string("pot.stl:").append(std::to_string(lines)).append(": ");
    EXPECT_TRUE(message_of(cut).starts_with(place)) << message_of(cut) << " cut at " << size;
  }
  EXPECT_TRUE(decode_stl(whole.substr(0, closed), "x").has_value());
}

TEST(Stl, ErrorsNameTheFacetInBinary) {
  struct BadCorner {
    std::size_t facet, corner;
    float value;
    const char* says;
  };
  for (const BadCorner& bad : {
           BadCorner{0, 0, std::nanf(""),
                     "pot.stl: facet 1: expected a coordinate within +-1e6 mm, found nan"},
           BadCorner{2, 1, -std::numeric_limits<float>::infinity(),
                     "pot.stl: facet 3: expected a coordinate within +-1e6 mm, found -inf"},
           BadCorner{3, 2, std::nextafter(1e6F, 2e6F),
                     "pot.stl: facet 4: expected a coordinate within +-1e6 mm, found 1000000"},
       }) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::string bytes = encode_stl_binary(tetrahedron());
      overwrite(bytes, kPrologue + kFacet * bad.facet + 12 * (1 + bad.corner) + 4 * axis,
                bad.value);
      EXPECT_EQ(message_of(bytes).substr(0, std::strlen(bad.says)), bad.says);
    }
  }
}

TEST(Stl, RepairReadsTheWholeFacetsThatAreThere) {
  const TriangleMesh mesh = tetrahedron();
  const std::string whole = encode_stl_binary(mesh);
  struct Case {
    std::size_t bytes;    // of the file, or with zeros after it
    std::uint32_t count;  // as stated
    std::size_t read;     // facets
  };
  for (const Case& c : std::vector<Case>{{284, 0, 4},
                                         {284, 3, 4},
                                         {284, 5, 4},
                                         {284, 0xFFFFFFFFu, 4},
                                         {285, 4, 4},
                                         {333, 4, 4},
                                         {283, 4, 3},
                                         {134, 4, 1}}) {
    std::string bytes = whole;
    bytes.resize(c.bytes, '\0');
    overwrite(bytes, 80, c.count);
    std::vector<std::string> notes;
    const auto read = decode_stl(bytes, "pot.stl", {true, &notes});
    ASSERT_TRUE(read) << read.error().message;
    const TriangleMesh first = decode_stl(encode_stl_binary([&] {
                                            TriangleMesh part = mesh;
                                            part.triangles.resize(c.read);
                                            return part;
                                          }()),
                                          "x")
                                   .value();
    EXPECT_EQ(*read, first) << c.bytes << " " << c.count;
    EXPECT_EQ(notes,
              std::vector<std::string>{"the file counts " + std::to_string(c.count) +
                                       " facets; its " + std::to_string(c.bytes) + " bytes hold " +
                                       std::to_string(c.read) + ", which were read"});
    EXPECT_FALSE(decode_stl(bytes, "pot.stl"));
  }
  EXPECT_FALSE(decode_stl(whole.substr(0, 133), "pot.stl", {true, nullptr}));  // no whole facet
  EXPECT_FALSE(decode_stl("\x89PNG\r\n\x1a\n" + whole, "pot.stl", {true, nullptr}));
}

TEST(Stl, RepairsTextWithoutEndsolid) {
  const std::string whole = encode_stl_ascii(tetrahedron(), "pot");
  const std::string cut = whole.substr(0, whole.rfind("endsolid"));
  EXPECT_EQ(decode_stl(cut, "pot.stl").error().message,
            "pot.stl:29: expected facet or endsolid, found the end of the file; a repair reads the "
            "4 facets that are there");
  std::vector<std::string> notes;
  EXPECT_EQ(decode_stl(cut, "pot.stl", {.repair = true, .notes = &notes}).value(),
            decode_stl(whole, "pot.stl").value());
  EXPECT_EQ(notes, std::vector<std::string>{
                       "line 29: the file ends without endsolid, so facets may be missing"});
  // Inside a facet, it is not complete.
  EXPECT_FALSE(decode_stl(cut.substr(0, cut.rfind("endfacet")), "pot.stl", {.repair = true}));
}

TEST(Stl, ABinaryHeaderMayBeginWithTheWordSolid) {
  std::string bytes = encode_stl_binary(tetrahedron());
  const std::string word = "solid cup";
  bytes.replace(0, word.size() + 1, word + '\0');
  EXPECT_TRUE(decode_stl(bytes, "pot.stl"));
  const std::string cut = bytes.substr(0, bytes.size() - 7);
  EXPECT_NE(message_of(cut).find("284 bytes of binary STL"), std::string::npos) << message_of(cut);
  EXPECT_EQ(decode_stl(cut, "pot.stl", {.repair = true}).value().triangles.size(), 3u);
}

TEST(Stl, RefusesBinaryOfAnyOtherSize) {
  const std::string whole = encode_stl_binary(tetrahedron());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // Fewer bytes than the header and the count state no count, so the message names only the
    // format.
    const std::string found = size < 84 ? "expected an STL file" : std::to_string(size) + " bytes";
    EXPECT_NE(message_of(whole.substr(0, size)).find(found), std::string::npos) << size;
  }
  EXPECT_EQ(
      message_of(whole + "x"),
      "pot.stl: expected 284 bytes of binary STL for the 4 facets it counts, found 285 bytes; "
      "a repair reads the whole facets that are there");
  for (const std::uint32_t count : {0u, 3u, 5u, 0xFFFFFFFFu}) {
    std::string bytes = whole;
    overwrite(bytes, 80, count);
    EXPECT_NE(message_of(bytes).find(
                  std::string("for the ").append(std::to_string(count)).append(" facets")),
              std::string::npos);
  }
  std::string none = whole.substr(0, kPrologue);
  overwrite(none, 80, 0u);
  EXPECT_EQ(message_of(none), "pot.stl: expected 1 to 20000000 triangles, found 0");
}

}  // namespace
}  // namespace clay::solid
