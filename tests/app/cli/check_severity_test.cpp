#include "claystack/export/check.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "tests/export/solid/shapes.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace clay::test {
namespace {

/// The verdict on a mesh, with the exit status of each --accept.
class CheckSeverity : public testing::Test {
 protected:
  void expect(const solid::TriangleMesh& mesh, const std::string& verdict, int strict, int accepted,
              const std::string& options = {}) {
    const std::string file = folder.file("mesh.obj");
    write_text(file, solid::encode_obj(mesh, "mesh"));
    for (const auto& [accept, status] :
         {std::pair{"", strict}, {"--accept sound ", strict}, {"--accept prints ", accepted}}) {
      const Ran run = claystack("check --json " + options + accept + file);
      EXPECT_EQ(run.status, status) << accept << run.out;
      EXPECT_EQ(run.json().at("verdict"), verdict) << run.out;
      EXPECT_EQ(run.json().at("passes"), status == 0);
      EXPECT_EQ(violation(load_schema("check"), Json::parse(run.out)), "") << run.out;
    }
  }
  ScratchFolder folder;
};

TEST_F(CheckSeverity, AcceptsWhatASlicerUnites) {
  using solid::shapes::cube, solid::shapes::moved, solid::shapes::together, solid::shapes::inverted;
  const solid::TriangleMesh good = cube(20.0);
  expect(good, "sound", 0, 0);
  expect(together(good, moved(good, {10, 10, 10})), "prints", 1, 0);
  expect(together(good, moved(cube(10.0), {5, 5, 5})), "prints", 1, 0);
  // A shell turned inward is no clay, and an open one has no inside.
  expect(together(good, moved(inverted(good), {10, 10, 10})), "will not print", 1, 1);
  expect(inverted(good), "will not print", 1, 1);
  solid::TriangleMesh open = good;
  open.triangles.pop_back();
  expect(open, "will not print", 1, 1);
  // Other checks still count.
  expect(together(good, moved(good, {10, 10, 10})), "prints", 1, 1, "--min-wall 30 ");
}

/// A surface inside of another shell bounds no wall.
TEST_F(CheckSeverity, MeasuresTheWallsOfTheUnionOfShells) {
  using solid::shapes::cube, solid::shapes::moved, solid::shapes::together;
  // Walls of 2 mm, less 0.2 % in the middle of a facet. A block overlaps them from outside.
  const solid::TriangleMesh cup =
      solid::revolve({{{{0, 0}, {20, 0}, {20, 40}, {18, 40}, {18, 6}, {0, 6}}}}, 48);
  struct Case {
    solid::TriangleMesh mesh;
    double least_mm;  // of its union
  };
  for (const Case& c :
       std::vector<Case>{{together(cube(10.0), moved(cube(10.0), {9.5, 0, 0})), 10.0},
                         {together(cube(20.0), moved(cube(10.0), {5, 5, 5})), 20.0},
                         {together(cup, moved(cube(10.0), {19.5, -5, 10})), 1.99},
                         {together(cup, moved(cube(10.0), {18.5, -5, 10})), 1.99}}) {
    const std::string file = folder.file("mesh.obj");
    write_text(file, solid::encode_obj(c.mesh, "mesh"));
    const Ran run = claystack("check --json --accept prints --min-wall 1.9 " + file);
    EXPECT_EQ(run.status, 0) << run.out;
    const auto wall = run.json().at("wall_sampled");
    EXPECT_GE(wall.at("least_mm"), c.least_mm - 1e-5) << run.out;
    EXPECT_EQ(wall.at("united"), true);
    EXPECT_FALSE(wall.contains("triangle"));
    EXPECT_EQ(violation(load_schema("check"), Json::parse(run.out)), "") << run.out;
  }
  expect(together(cup, moved(cube(10.0), {19.5, -5, 10})), "prints", 1, 1, "--min-wall 2.1 ");
}

TEST_F(CheckSeverity, MeasuresNoWallOfShellsThatASlicerMayNotUnite) {
  using solid::shapes::cube, solid::shapes::inverted, solid::shapes::moved, solid::shapes::together;
  const std::string file = folder.file("mesh.obj");
  write_text(file, solid::encode_obj(
                       together(cube(20.0), moved(inverted(cube(20.0)), {10, 10, 10})), "mesh"));
  const Ran run = claystack("check --json --min-wall 1 " + file);
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_FALSE(run.json().contains("wall_sampled"));
  EXPECT_NE(run.json().at("checks").dump().find("not measured: shells intersect"),
            std::string::npos)
      << run.out;
}

/// PrusaSlicer passes over faces such as "f 1/ 2/ 3/" without a message.
TEST_F(CheckSeverity, FacesThatASlicerDoesNotReadDoNotPrint) {
  using solid::shapes::cube, solid::shapes::moved, solid::shapes::together;
  const solid::TriangleMesh crossing = together(cube(20.0), moved(cube(20.0), {10, 10, 10}));
  const std::string obj = solid::encode_obj(crossing, "mesh");
  const std::string slashes =
      std::regex_replace(obj, std::regex(R"((f \d+) (\d+) (\d+))"), "$1/ $2/ $3/");
  const std::string file = folder.file("slashes.obj");
  write_text(file, slashes);
  const Ran run = claystack("check --json " + file);
  EXPECT_EQ(run.json().at("verdict"), "will not print") << run.out;
  EXPECT_NE(run.json().at("notes").dump().find("24 faces"), std::string::npos) << run.out;
  // The repaired file is written without.
  const std::string out = folder.file("repaired.obj");
  EXPECT_EQ(claystack("check --repair -o " + out + " " + file).status, 0);
  EXPECT_EQ(read_text(out).find('/'), std::string::npos);
}

TEST_F(CheckSeverity, ManyIntersectionsDoNotPrint) {
  using solid::shapes::ball, solid::shapes::moved, solid::shapes::together;
  solid::TriangleMesh balls = ball(10.0);
  for (const double k : {1.0, 2.0, 3.0})
    balls = together(balls, moved(ball(10.0), {3.3 * k, 1.7 * k, 0.9 * k}));
  ASSERT_GT(solid::check_mesh(balls).value().self_intersections, solid::kMostUnitedPairs);
  expect(balls, "will not print", 1, 1);
}

TEST_F(CheckSeverity, NotesAVolumeThatCountsOverlapsTwice) {
  using solid::shapes::cube, solid::shapes::inverted, solid::shapes::moved, solid::shapes::together;
  const auto noted = [&](const solid::TriangleMesh& mesh) {
    const std::string file = folder.file("mesh.obj");
    write_text(file, solid::encode_obj(mesh, "mesh"));
    const Ran run = claystack("check " + file);
    return run.out.find(" cm3 (counted twice where shells overlap)") != std::string::npos;
  };
  const solid::TriangleMesh good = cube(20.0), small = moved(cube(10.0), {5, 5, 5});
  EXPECT_TRUE(noted(together(good, moved(good, {10, 10, 10}))));
  EXPECT_TRUE(noted(together(good, small)));
  EXPECT_FALSE(noted(together(good, inverted(small))));
  EXPECT_FALSE(noted(together(good, moved(good, {30, 0, 0}))));
}

}  // namespace
}  // namespace clay::test
