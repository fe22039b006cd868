// The file that check --repair writes: its format, its grid, and the bounds of the change.

#include "tests/app/cli/mesh_files.hpp"
#include "tests/export/solid/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace clay::test {
namespace {

using solid::TriangleMesh;
using solid::shapes::ball;
using solid::shapes::cube;
using solid::shapes::inverted;
using solid::shapes::moved;
using solid::shapes::together;

class RepairedFile : public MeshFiles {};

TEST_F(RepairedFile, WritesASoundMeshUnchanged) {
  const std::string in = write("in.stl", ball(10.0)), out = folder.file("out.stl");
  const Ran run = claystack("check --json --repair " + in + " -o " + out);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.json().at("found").empty());
  EXPECT_TRUE(run.json().at("repaired").empty());
  EXPECT_EQ(read_text(out), read_text(in));
}

TEST_F(RepairedFile, WritesSoundMeshesInFormatsWithAGrid) {
  // Thinner than the grid that the usual error bound gives: both faces would lie on one another.
  TriangleMesh plate = cube(20.0);
  for (glm::dvec3& p : plate.points) p.z *= 0.004 / 20.0;
  const std::string in = write("in.stl", plate);
  for (const char* name : {"out.drc", "out.glb"}) {
    const std::string out = folder.file(name);
    const Ran run = claystack("check --json --repair " + in + " -o " + out);
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    const Ran again = claystack("check --json " + out);
    EXPECT_EQ(again.status, 0) << again.out;
    EXPECT_NEAR(again.json().at("volume_mm3").get<double>(), 400.0 * 0.004, 400.0 * 0.001);
  }
}

TEST_F(RepairedFile, KeepsTheVolumeOfThinPlatesInFormatsWithAGrid) {
  for (const double mm : {0.01, 0.05, 0.3}) {
    TriangleMesh plate = cube(60.0);
    for (glm::dvec3& p : plate.points) p = p * glm::dvec3(1.0, 1.0, mm / 60.0) + 0.123;
    const std::string in = write("in.stl", plate);
    for (const char* name : {"out.drc", "out.glb"}) {
      const std::string out = folder.file(name);
      const Ran run = claystack("check --json --repair " + in + " -o " + out);
      EXPECT_EQ(run.status, 0) << run.out << run.err;
      const double volume = claystack("check --json " + out).json().at("volume_mm3");
      EXPECT_NEAR(volume, 3600.0 * mm, 0.01 * 3600.0 * mm) << name << mm;
    }
  }
}

TEST_F(RepairedFile, BoundsTheChangeOfTheWrittenFile) {
  const std::string in = write("in.stl", moved(ball(30.0), {0.123, 0.0, 0.0}));
  for (const char* name : {"out.drc", "out.glb"}) {
    const Ran run = claystack("check --json --repair " + in + " -o " + folder.file(name));
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    // A grid of the size, at most: 1e-5 of 104 mm, and the bound is within 1e-4 of it.
    EXPECT_GT(run.json().at("change").at("added_mm"), 0.0) << name;
    EXPECT_GT(run.json().at("change").at("removed_mm"), 0.0) << name;
    EXPECT_LE(run.json().at("change").at("added_mm"), 0.0015 + 0.0104) << name;
  }
}

TEST_F(RepairedFile, BoundsTheRoundingOfPointsAsRead) {
  // At 100 m, float32 has steps of 2^-7 mm: 0.1 mm more is 12.8 of them.
  std::string obj;
  for (const char* point : {"100000.1 0 0", "100020.1 0 0", "100000.1 20 0", "100000.1 0 20"})
    obj.append("v ").append(point).append("\n");
  for (const char* face : {"1 3 2", "1 2 4", "1 4 3", "2 3 4"})
    obj.append("f ").append(face).append("\n");
  write_text(folder.file("in.obj"), obj);
  const std::string out = folder.file("out.stl");
  const Ran run = claystack("check --json --repair " + folder.file("in.obj") + " -o " + out);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_GE(run.json().at("change").at("reading_mm"), 0.2 * 0x1p-7);
  EXPECT_LE(run.json().at("change").at("reading_mm"), std::sqrt(3.0) * 0x1p-7);
  const Ran again = claystack("check --json --repair --dry-run " + out);
  EXPECT_EQ(again.json().at("change").at("reading_mm"), 0.0);
}

TEST_F(RepairedFile, CountsDecimationInTheChange) {
  // Of a ball of 20 mm radius, 12 triangles leave faces far inside it.
  const std::string in = write("in.stl", ball(20.0)), out = folder.file("out.stl");
  const Ran run = claystack("check --json " + in + " --max-triangles 12 -o " + out);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_GT(run.json().at("change").at("added_mm"), 2.0);
  EXPECT_GT(run.json().at("change").at("removed_mm"), 2.0);
}

TEST_F(RepairedFile, StatesThatTheResultOfA3mfHasNoPot) {
  const std::string pot = folder.file("bowl.pot.json"), in = folder.file("bowl.3mf");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  ASSERT_LE(claystack("export -q " + pot + " " + in).status, 1);
  const Ran run = claystack("check --repair " + in + " -o " + folder.file("out.3mf"));
  EXPECT_NE(run.out.find("neither the pot nor the certificate"), std::string::npos) << run.out;
  const Ran plain = claystack("check " + in);
  EXPECT_EQ(plain.out.find("before shrinkage"), std::string::npos) << "it has the size of the pot";
}

TEST_F(RepairedFile, StatesThatTheResultOfAGlbHasNoMaterials) {
  const std::string in = folder.file("in.glb");
  ASSERT_EQ(claystack("check " + write("in.stl", ball(20.0)) + " --repair -o " + in).status, 0);
  const Ran run = claystack("check " + in + " --max-triangles 100 -o " + folder.file("out.glb"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("note: the result has no names, materials and colours of the file\n"),
            std::string::npos)
      << run.out;
}

TEST_F(RepairedFile, DecimatesAfterRepair) {
  TriangleMesh mesh = ball(10.0);
  mesh.triangles.pop_back();
  const std::string in = write("in.stl", mesh), out = folder.file("out.stl");
  const Ran open = claystack("check --json " + in + " --max-triangles 100 -o " + out);
  EXPECT_EQ(open.status, 1);
  EXPECT_NE(open.err.find("manifold mesh to decimate"), std::string::npos) << open.err;
  // The verdict is that on the input.
  EXPECT_EQ(open.json().at("problems").at(0).at("what"), "open edge");
  EXPECT_NE(open.json().at("error").get<std::string>().find("manifold"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out));

  const Ran run = claystack("check --json --repair " + in + " --max-triangles 100 -o " + out);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_LE(run.json().at("triangles"), 100);
  EXPECT_EQ(run.json().at("decimated").at("to_triangles"), run.json().at("triangles"));
  EXPECT_GT(run.json().at("decimated").at("max_error_mm"), 0.0);
  EXPECT_LT(run.json().at("decimated").at("max_error_mm"), 2.0);
}

/// Two overlapping cups become one body. With few triangles its walls would intersect.
TEST_F(RepairedFile, WritesNothingIfDecimationMakesTheResultUnsound) {
  const std::string pot = folder.file("t.pot.json"), cup = folder.file("t.stl");
  ASSERT_EQ(claystack("import -q " + sample("drawings/tumbler.csv") + " --wall 6 -o " + pot).status,
            0);
  ASSERT_EQ(claystack("export -q " + pot + " " + cup).status, 0);
  const auto mesh = solid::decode_mesh(read_text(cup), solid::MeshFormat::stl_binary, "t.stl");
  ASSERT_TRUE(mesh);
  const std::string in = write("two.stl", together(*mesh, moved(*mesh, {10.0, 0.0, 0.0})));
  const std::string out = folder.file("out.stl");
  const Ran run = claystack("check --repair " + in + " --max-triangles 120 -o " + out);
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_NE(run.err.find("--max-triangles 120: expected a sound mesh, found self-intersection"),
            std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

/// Of a mesh with one spike through a wall, the repaired STL has all facets away from it, with the
/// same 50 bytes and in the same order.
TEST_F(RepairedFile, KeepsTheBytesOfFacetsAwayFromAnIntersection) {
  TriangleMesh vase = solid::revolve(
      {{{{0, 0}, {30, 0}, {34, 20}, {30, 50}, {27, 50}, {31, 20}, {27, 3}, {0, 3}}}}, 600);
  const auto spike = static_cast<std::size_t>(
      std::find_if(vase.points.begin(), vase.points.end(),
                   [](const glm::dvec3& p) { return p.z == 20.0 && p.x > 33.9; }) -
      vase.points.begin());
  ASSERT_LT(spike, vase.points.size());
  vase.points[spike] *= glm::dvec3(0.85, 0.85, 1.0);
  const std::string in = write("spike.stl", vase), out = folder.file("out.stl");
  const Ran found = claystack("check --json " + in);
  EXPECT_GE(found.json().at("self_intersections"), 1);
  EXPECT_LE(found.json().at("self_intersections"), 20);
  ASSERT_EQ(claystack("check --repair -o " + out + " " + in).status, 0);
  // A facet is away if it has no corner within 20 degrees of the spike.
  const auto away = [](const std::string& name) {
    const std::string stl = read_text(name);
    std::vector<std::string> facets;
    for (std::size_t at = 84; at + 50 <= stl.size(); at += 50) {
      bool near = false;
      for (std::size_t corner = 1; corner < 4; ++corner) {
        std::array<float, 3> p{};
        std::memcpy(p.data(), stl.data() + at + 12 * corner, sizeof p);
        near = near || (p[0] > 0.0F && std::abs(p[1]) < 0.364F * p[0]);
      }
      if (!near) facets.push_back(stl.substr(at, 50));
    }
    return facets;
  };
  EXPECT_GT(away(in).size(), 6'000U);
  EXPECT_EQ(away(in), away(out));
}

TEST_F(RepairedFile, ReturnsThreeForAnUnwritableOutput) {
  const std::string in = write("in.stl", cube(20.0));
  EXPECT_EQ(claystack("check --repair " + in + " -o /nonexistent/out.stl").status, 3);
}

}  // namespace
}  // namespace clay::test
