#include "tests/app/cli/mesh_files.hpp"
#include "tests/support/schema_check.hpp"

#include "claystack/export/formats.hpp"
#include "tests/export/solid/shapes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <ostream>
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

/// A fault in a mesh of cubes, its place in the cube's numbering, and the result of repair.
struct Planted {
  std::string name;
  TriangleMesh mesh;
  std::string what, where;
  std::vector<std::pair<std::string, std::size_t>> repaired;
  double volume_mm3 = 8000.0;
};

void PrintTo(const Planted& planted, std::ostream* out) { *out << planted.name; }

TriangleMesh hole() {
  TriangleMesh mesh = cube(20.0);
  mesh.triangles.pop_back();
  return mesh;
}
TriangleMesh flip() {
  TriangleMesh mesh = cube(20.0);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  return mesh;
}
TriangleMesh duplicate() {
  TriangleMesh mesh = cube(20.0);
  mesh.triangles.push_back(mesh.triangles[4]);
  return mesh;
}
TriangleMesh crack() {
  TriangleMesh mesh = cube(20.0);
  mesh.points.push_back({20.0, 20.0, std::nextafter(20.0F, 21.0F)});
  for (const std::size_t t : {2u, 3u})
    std::replace(mesh.triangles[t].begin(), mesh.triangles[t].end(), 6u, 8u);
  return mesh;
}
TriangleMesh fin() {
  TriangleMesh mesh = cube(20.0);
  mesh.points.push_back({30, -30, 10});
  mesh.triangles.push_back({0, 1, 8});
  return mesh;
}
TriangleMesh sliver() {
  TriangleMesh mesh = cube(20.0);
  mesh.points.push_back({10, 0, 0});
  std::erase(mesh.triangles, (std::array<std::uint32_t, 3>{0, 1, 5}));
  mesh.triangles.insert(mesh.triangles.end(), {{0, 8, 5}, {8, 1, 5}, {0, 1, 8}});
  return mesh;
}

std::vector<Planted> faults() {
  const TriangleMesh good = cube(20.0);
  return {
      {"hole", hole(), "open edge", "triangle 11 at (0, 10, 10) mm", {{"hole filled", 1}}},
      {"flip",
       flip(),
       "edge between faces of opposite orientation",
       "triangles 3, 4 at (10, 10, 20) mm",
       {{"triangle turned", 1}}},
      {"duplicate",
       duplicate(),
       "duplicate triangle",
       "triangles 5, 13 at (13.3333333, 0, 6.66666667) mm",
       {{"duplicate triangle removed", 1}}},
      {"crack",
       crack(),
       "open edge",
       "triangle 8 at (20, 10, 20) mm",
       {{"points welded across a crack", 1}}},
      {"fin",
       fin(),
       "non-manifold edge",
       "triangles 1, 5, 13 at (10, 0, 0) mm",
       {{"triangle of a fin removed", 1}}},
      {"touching",
       together(good, moved(good, {20, 20, 0})),
       "self-intersection",
       "triangles 1, 13 at (20, 20, 0) mm",
       {{"points of one place merged", 2},
        {"non-manifold edge cut apart", 1},
        {"vertex pulled apart where surfaces touch", 2}},
       16000.0},
      {"inner",
       together(good, moved(cube(10.0), {5, 5, 5})),
       "closed shell inside another one that faces outward; a slicer fills it",
       "triangle 13 at (11.6666667, 8.33333333, 5) mm",
       {{"triangle inside the solid removed", 12}},
       8000.0},
      {"outside-in", inverted(good), "inside out", "volume -8000 mm^3", {{"shell turned", 1}}},
      {"sliver",
       sliver(),
       "degenerate triangle",
       "triangle 14 at (10, 0, 0) mm",
       {{"triangle without area removed", 1}}},
      {"crossing",
       together(good, moved(good, {10, 10, 10})),
       "self-intersection",
       "triangles 3, 17 at (20, 10, 20) mm",
       {{"pair of intersecting triangles resolved", 18}, {"triangle inside the solid removed", 12}},
       15000.0},
  };
}

class PlantedFault : public testing::TestWithParam<Planted> {
 protected:
  std::string write(const ScratchFolder& folder) const {
    const std::string name = folder.file(GetParam().name + ".obj");
    write_text(name, solid::encode_obj(GetParam().mesh, "fault"));
    return name;
  }
};

const nlohmann::json* find(const nlohmann::json& list, const std::string& what) {
  for (const auto& entry : list)
    if (entry.at("what") == what) return &entry;
  return nullptr;
}

TEST_P(PlantedFault, IsReportedWithItsPlace) {
  const ScratchFolder folder;
  const Ran run = claystack("check --json " + write(folder));
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  const auto problems = run.json().at("problems");
  const auto* problem = find(problems, GetParam().what);
  ASSERT_NE(problem, nullptr) << problems.dump(2);
  EXPECT_NE(problem->at("where").get<std::string>().find(GetParam().where), std::string::npos)
      << problem->dump();
}

TEST_P(PlantedFault, IsRepaired) {
  const ScratchFolder folder;
  const Planted& planted = GetParam();
  const std::string out = folder.file("repaired.stl");
  const Ran run = claystack("check --json --repair " + write(folder) + " -o " + out);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const auto json = run.json();
  EXPECT_EQ(violation(load_schema("check"), Json::parse(run.out)), "") << run.out;
  EXPECT_NE(find(json.at("found"), planted.what), nullptr);
  ASSERT_EQ(json.at("repaired").size(), planted.repaired.size()) << json.at("repaired").dump(2);
  for (const auto& [what, count] : planted.repaired) {
    const auto* repaired = find(json.at("repaired"), what);
    ASSERT_NE(repaired, nullptr) << json.at("repaired").dump(2);
    EXPECT_EQ(repaired->at("count"), count);
  }
  EXPECT_TRUE(json.at("remaining").empty()) << json.at("remaining").dump(2);
  // Parts that touch are pulled apart by about 0.0001 mm.
  EXPECT_NEAR(json.at("volume_mm3"), planted.volume_mm3, 0.1);
  // The file gives the same result when checked separately.
  const Ran again = claystack("check --json " + out);
  EXPECT_EQ(again.status, run.status);
  EXPECT_EQ(again.json().at("problems"), json.at("remaining"));
}

INSTANTIATE_TEST_SUITE_P(Check, PlantedFault, testing::ValuesIn(faults()), [](const auto& row) {
  std::string name = row.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

class CheckRepair : public MeshFiles {};

TEST_F(CheckRepair, RefusesNanAndWritesNothing) {
  std::string obj = solid::encode_obj(cube(20.0), "fault");
  obj.replace(obj.find("\nv ") + 3, 1, "nan ");
  write_text(folder.file("nan.obj"), obj);
  const std::string out = folder.file("out.stl");
  const Ran run = claystack("check --repair " + folder.file("nan.obj") + " -o " + out);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("nan.obj:"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

/// A cube of 20 mm without its lid.
TriangleMesh open_cup() {
  TriangleMesh cup = cube(20.0);
  std::erase_if(cup.triangles, [&](const auto& t) {
    return cup.points[t[0]].z + cup.points[t[1]].z + cup.points[t[2]].z == 60.0;
  });
  return cup;
}

TEST_F(CheckRepair, KeepsTheReportOnTheInputBesideAnError) {
  const std::string cup = write("cup.stl", open_cup());
  const auto failed = [&](const std::string& arguments, int status) {
    const Ran run = claystack("check --json " + arguments);
    EXPECT_EQ(run.status, status) << run.out << run.err;
    EXPECT_EQ(violation(load_schema("check"), Json::parse(run.out)), "") << run.out;
    EXPECT_FALSE(run.json().at("passes"));
    return run.json();
  };
  const auto refused = failed("--repair --dry-run " + cup, 1);
  EXPECT_EQ(refused.at("verdict"), "will not print");
  EXPECT_EQ(refused.at("triangles"), 10);
  EXPECT_EQ(refused.at("kind"), "unsound");
  EXPECT_TRUE(refused.at("written").is_null());
  const auto thin = failed("--repair --dry-run --thicken 0.001 " + cup, 2);
  EXPECT_EQ(thin.at("verdict"), "will not print");
  EXPECT_EQ(thin.at("kind"), "bad_input");
  // No mesh has been read yet.
  for (const char* arguments : {"--repair ", "--repair -o /nonexistent/out.stl "}) {
    const Ran usage = claystack("check --json " + (arguments + cup));
    EXPECT_EQ(violation(load_schema("error"), Json::parse(usage.out)), "") << usage.out;
    EXPECT_FALSE(usage.json().contains("verdict")) << usage.out;
  }
}

TEST_F(CheckRepair, AdvisesNoDrainHoleForATinyCavity) {
  const auto hollow = [&](double mm) {
    const std::string in =
        write("in.stl", together(cube(20.0), moved(inverted(cube(mm)), {5, 5, 5})));
    std::string all;
    const auto json = claystack("check --json " + in).json();
    for (const auto& check : json.at("checks")) all += check.at("text").get<std::string>() + '\n';
    return all;
  };
  EXPECT_NE(hollow(0.5).find("1 closed cavity, 0.125 mm3 trapped\n"), std::string::npos)
      << hollow(0.5);
  EXPECT_NE(hollow(0.0625).find("less than 0.001 mm3 trapped\n"), std::string::npos);
  EXPECT_NE(hollow(2.0).find("8 mm3 trapped: it needs a drain hole"), std::string::npos);
}

TEST_F(CheckRepair, QuietPrintsFaultsAndWarnings) {
  const std::string open = write("open.stl", hole());
  const Ran broken = claystack("check -q " + open);
  EXPECT_EQ(broken.status, 1);
  EXPECT_EQ(broken.out, "");
  EXPECT_NE(broken.err.find("open edge (3)"), std::string::npos) << broken.err;
  const std::string thin = write("thin.stl", cube(20.0));
  const Ran failed = claystack("check -q --min-wall 50 " + thin);
  EXPECT_EQ(failed.status, 1);
  EXPECT_NE(failed.err.find("walls"), std::string::npos) << failed.err;
  EXPECT_EQ(claystack("check -q " + thin).err, "");
}

TEST_F(CheckRepair, MeasuresNoWallOfAMeshThatIsInsideOut) {
  const std::string in = write("in.stl", inverted(cube(20.0)));
  const Ran run = claystack("check --process fdm " + in);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("walls: fail: not measured: some or all faces point into the clay"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("process: warn: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("overhangs not measured"), std::string::npos) << run.out;
}

TEST_F(CheckRepair, StatesWhereAnIntersectionIs) {
  // The corners of two boxes overlap between 199 and 200 mm.
  const std::string in =
      write("in.stl", together(cube(200.0), moved(cube(200.0), {199.0, 199.0, 199.0})));
  const Ran run = claystack("check --json " + in);
  const std::string where = run.json().at("problems").at(0).at("where").get<std::string>();
  double x = 0.0, y = 0.0, z = 0.0;
  const std::size_t at = where.find("at (");
  ASSERT_NE(at, std::string::npos) << where;
  ASSERT_EQ(std::sscanf(where.c_str() + at, "at (%lf, %lf, %lf)", &x, &y, &z), 3) << where;
  for (const double place : {x, y, z}) {
    EXPECT_GE(place, 199.0) << where;
    EXPECT_LE(place, 200.0) << where;
  }
}

TEST_F(CheckRepair, ReportsWhatItChanged) {
  // Two intersecting balls, and a cube with a hole.
  const TriangleMesh balls = together(ball(10.0), moved(ball(10.0), {3.3, 1.7, 0.9}));
  const std::string in = write("in.stl", together(balls, moved(hole(), {50, 0, 0})));
  const Ran run = claystack("check --repair " + in + " -o " + folder.file("out.obj"));
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  for (const char* line :
       {": will not print before, the result: sound\n", "found: open edge (3)",
        "repaired: hole filled (1)", "repaired: pair of intersecting triangles resolved (",
        "filled: hole of 3 edges, 28.28 mm", "volume: ", "written: "})
    EXPECT_NE(run.out.find(line), std::string::npos) << line << " in\n" << run.out;
  EXPECT_EQ(run.out.find("remaining"), std::string::npos) << run.out;
}

TEST_F(CheckRepair, WritesNothingInADryRun) {
  const std::string in = write("in.stl", hole()), out = folder.file("out.stl");
  for (const std::string& to : {std::string(), " -o " + out}) {
    const Ran run = claystack("check --json --repair --dry-run " + in + to);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(run.json().at("written").is_null());
    ASSERT_EQ(run.json().at("holes").size(), 1u);
    EXPECT_EQ(run.json().at("holes").at(0).at("edges"), 3);
    EXPECT_NEAR(run.json().at("holes").at(0).at("area_mm2"), 200.0, 1e-3);
    EXPECT_FALSE(std::filesystem::exists(out));
  }
  EXPECT_EQ(claystack("check --dry-run " + in).status, 2);
}

TEST_F(CheckRepair, RefusesAnOpenCupUnlessItMayCapIt) {
  const std::string in = write("cup.stl", open_cup()), out = folder.file("out.stl");
  const Ran refused = claystack("check --repair " + in + " -o " + out);
  EXPECT_EQ(refused.status, 1);
  for (const char* part : {"found an opening 28.28 mm wide at (10, 10, 20) mm",
                           "; --thicken MM gives it one, --cap closes it by a cap"})
    EXPECT_NE(refused.err.find(part), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  const Ran capped = claystack("check --json --repair --cap " + in + " -o " + out);
  EXPECT_EQ(capped.status, 0) << capped.err;
  EXPECT_NEAR(capped.json().at("volume_mm3"), 8000.0, 1e-3);
  EXPECT_EQ(claystack("check --cap " + in).status, 2);
}

TEST_F(CheckRepair, MakesAWallAroundAnOpenSurface) {
  const std::string in = write("cup.stl", open_cup()), out = folder.file("out.stl");
  const Ran run = claystack("check --json --repair --thicken 2 " + in + " -o " + out);
  EXPECT_EQ(run.status, 0) << run.err;
  // Five sides of 400 mm2, 2 mm thick, less the corners inside and more at the edges; and up to a
  // fifth more, so that no sample is thinner near the sharp rim.
  EXPECT_GE(run.json().at("volume_mm3"), 3600.0);
  EXPECT_LE(run.json().at("volume_mm3"), 1.2 * 4000.0);
  // 1 mm, and up to 3 sqrt(3) - 2 mm in the corners inside, which a ball of 2 mm radius rounds off
  // between three faces.
  EXPECT_GE(run.json().at("change").at("added_mm"), 0.99);
  EXPECT_LE(run.json().at("change").at("added_mm"), 3.0 * std::sqrt(3.0) - 2.0 + 0.05);
}

/// A cup of 20 mm radius, 30 mm high, as a surface of 32 segments.
TriangleMesh round_cup() {
  constexpr std::uint32_t kSegments = 32;
  TriangleMesh cup{{{0, 0, 0}}, {}};
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSegments;
    for (const double z : {0.0, 30.0})
      cup.points.emplace_back(20.0 * std::cos(angle), 20.0 * std::sin(angle), z);
    const std::uint32_t a = 1 + 2 * i, b = 1 + 2 * ((i + 1) % kSegments);
    cup.triangles.insert(cup.triangles.end(), {{0, b, a}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
  return cup;
}

TEST_F(CheckRepair, MakesAWallOfAtLeastTheThicknessAroundACurvedSurface) {
  const std::string in = write("cup.stl", round_cup()), out = folder.file("out.stl");
  const double area_mm2 = std::numbers::pi * (20.0 * 20.0 + 40.0 * 30.0);
  for (const double mm : {2.0, 3.0}) {
    const std::string thickness = std::to_string(mm);
    const Ran run = claystack("check --json --repair --thicken " + thickness + " --min-wall " +
                              thickness + " " + in + " -o " + out);
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(violation(load_schema("check"), Json::parse(run.out)), "") << run.out;
    const auto wall = run.json().at("thickened");
    EXPECT_EQ(wall.at("asked_mm"), mm);
    EXPECT_GE(wall.at("least_mm"), mm);
    EXPECT_GE(run.json().at("volume_mm3"), 0.99 * area_mm2 * mm);
    EXPECT_LE(run.json().at("volume_mm3"), 1.2 * area_mm2 * mm);
  }
}

TEST_F(CheckRepair, WarnsIfAWallClosesACup) {
  // A cup of 40 mm with a neck of 16 mm: a wall of 5 mm leaves it open, one of 18 mm closes it.
  TriangleMesh cup = round_cup();
  const auto segments = static_cast<std::uint32_t>((cup.points.size() - 1) / 2);
  const auto shoulder = static_cast<std::uint32_t>(cup.points.size()), mouth = shoulder + segments;
  for (const double up : {0.0, 10.0})
    for (std::uint32_t i = 0; i < segments; ++i)
      cup.points.push_back(cup.points[2 + 2 * i] * glm::dvec3(0.4, 0.4, 1.0) +
                           glm::dvec3(0.0, 0.0, up));
  for (std::uint32_t i = 0; i < segments; ++i) {
    const std::uint32_t next = (i + 1) % segments;
    const std::uint32_t low = 2 + 2 * i, low_next = 2 + 2 * next;
    cup.triangles.push_back({low, low_next, shoulder + i});
    cup.triangles.push_back({low_next, shoulder + next, shoulder + i});
    cup.triangles.push_back({shoulder + i, shoulder + next, mouth + i});
    cup.triangles.push_back({shoulder + next, mouth + next, mouth + i});
  }
  const std::string in = write("cup.stl", cup);
  const auto share = [&](const std::string& mm, bool warns) {
    const Ran run = claystack("check --json --repair --dry-run --thicken " + mm + ' ' + in);
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(run.out.find("fills gaps") != std::string::npos, warns) << run.out;
    return run.json().at("thickened").at("filled_share").get<double>();
  };
  EXPECT_LT(share("1.5", false), 0.1);
  EXPECT_LT(share("5", false), 0.2);
  EXPECT_GT(share("18", true), 0.3);  // most places inside
}

/// The library names the operation; a file name with the same words is not changed.
TEST_F(CheckRepair, NamesTheOptionThatReadsADamagedFile) {
  const std::string bytes = read_text(write("whole.stl", open_cup()));
  const std::string cut = folder.file("after a repair.stl");
  write_text(cut, bytes.substr(0, bytes.size() - 10));
  const Ran refused = claystack("check '" + cut + "'");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("; check --repair reads the whole facets that are there"),
            std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find(cut), std::string::npos) << refused.err;
}

TEST_F(CheckRepair, WrapsWhatItCannotRepairOtherwise) {
  // Two triangles that share nothing enclose no clay.
  const TriangleMesh sheets{{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 5}, {9, 0, 5}, {0, 9, 5}},
                            {{0, 1, 2}, {3, 4, 5}}};
  const std::string in = write("sheets.stl", sheets), out = folder.file("out.stl");
  EXPECT_EQ(claystack("check --repair " + in + " -o " + out).status, 1);
  const Ran run = claystack("check --json --repair --wrap 0.5 " + in + " -o " + out);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("wrapped_mm"), 0.5);
  EXPECT_EQ(run.json().at("repaired").at(0).at("what"), "surface replaced by a wrap");
  EXPECT_GE(run.json().at("change").at("added_mm"), 0.5);
}

TEST_F(CheckRepair, ReportsBadUsageBeforeAnyWork) {
  const std::string in = write("in.stl", cube(20.0));
  const auto refused = [&](const std::string& arguments, const std::string& says) {
    const Ran run = claystack("check " + arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  };
  refused("--repair " + in, "-o");
  refused(in + " -o " + folder.file("out.stl"), "--repair");
  refused("--repair " + in + " -o " + in, "in.stl: expected a separate output file");
  refused("--repair " + in + " -o " + folder.file("out.step"), ".obj");
  refused("--repair " + in + " --cap --thicken 3 -o " + folder.file("out.stl"), "--cap");
  refused("--weld 0.1 " + in, "claystack: --weld: expected --repair with it");
  refused("--weld 0.1 --wrap 1 --cap " + in, "--weld, --cap, --wrap: expected --repair with them");
  refused(in + " --max-triangles 3 -o " + folder.file("out.stl"), "max-triangles");
  refused(in + " --min-wall 1 --wall-samples 0", "wall-samples");
  const std::string pot = folder.file("p.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  refused(in + " --wall-samples 100", "--wall-samples: expected --min-wall or --process too");
  refused(pot + " --wall-samples 100", "expected a mesh for --wall-samples, found a pot");
  refused(pot + " --accept prints", "expected a mesh for --accept, found a pot");
  refused("--repair " + pot + " -o " + folder.file("out.stl"), "for meshes");
}

TEST_F(CheckRepair, RefusesAWrapThatIsTooFineForTheMesh) {
  // Five sides of 4 cm2, and 2.7 triangles for each square of the thickness: 500,000 of 0.104 mm.
  const std::string in = write("cup.stl", open_cup());
  for (const auto& [option, says] :
       {std::pair("--thicken 0.001",
                  "thickness of the wall: expected at least 0.104 mm for a surface of 20"),
        std::pair("--wrap 0.001",
                  "distance of the wrap: expected at least 0.0104 mm for a surface of 20")}) {
    const Ran run = claystack("check --repair --dry-run " + in + " " + option);
    EXPECT_EQ(run.status, 2) << option << run.out;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("cm2, found 0.001 mm"), std::string::npos) << run.err;
  }
}

TEST_F(CheckRepair, SamplesTheWallOfAMesh) {
  const TriangleMesh box = together(cube(20.0), moved(inverted(cube(16.0)), {2, 2, 2}));
  const std::string in = write("box.stl", box);
  const Ran thick = claystack("check " + in + " --min-wall 1.99");
  EXPECT_EQ(thick.status, 0) << thick.out;
  EXPECT_NE(thick.out.find("thinnest sample 2.000 mm at ("), std::string::npos) << thick.out;
  EXPECT_NE(thick.out.find("), 10000 rays; a sampled value, not a bound"), std::string::npos);

  const Ran thin = claystack("check --json " + in + " --min-wall 2.01 --wall-samples 500");
  EXPECT_EQ(thin.status, 1);
  const auto json = thin.json();
  EXPECT_TRUE(json.at("sound"));
  const auto checks = json.at("checks");  // the box has a cavity, too
  ASSERT_EQ(checks.size(), 2u) << checks.dump(2);
  EXPECT_EQ(checks.at(0).at("check"), "geometry");
  EXPECT_EQ(checks.at(0).at("verdict"), "warn");
  EXPECT_EQ(checks.at(1).at("check"), "walls");
  EXPECT_EQ(checks.at(1).at("verdict"), "fail");
  EXPECT_EQ(checks.at(1).at("text").get<std::string>().find("thin wall (sampled)"), 0u);
  const auto wall = json.at("wall_sampled");
  EXPECT_DOUBLE_EQ(wall.at("least_mm"), 2.0);
  EXPECT_EQ(wall.at("rays"), 500);
  EXPECT_EQ(wall.at("bound"), false);
  EXPECT_EQ(wall.at("at_mm").size(), 3u);
}

/// Rays from the floor leave through the opening, and those from a side measure the bore.
TEST_F(CheckRepair, MeasuresNoWallOfAnOpenMesh) {
  const std::string sheet = write("sheet.stl", {{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, {{0, 1, 2}}});
  for (const std::string& in : {sheet, write("cup.stl", open_cup())}) {
    const Ran run = claystack("check --json --process stoneware " + in);
    EXPECT_EQ(run.status, 1);
    const std::string checks = run.json().at("checks").dump();
    EXPECT_NE(checks.find("not measured: the mesh is open; check the result of --repair"),
              std::string::npos)
        << run.out;
    EXPECT_FALSE(run.json().contains("wall_sampled"));
  }
  const Ran fdm = claystack("check --process fdm " + write("cup.stl", open_cup()));
  EXPECT_NE(fdm.out.find("process: warn: "), std::string::npos) << fdm.out;
  EXPECT_NE(fdm.out.find("overhangs not measured: the mesh is open"), std::string::npos) << fdm.out;
}

TEST_F(CheckRepair, WarnsIfThickeningHasNoEffect) {
  for (const TriangleMesh& closed : {cube(20.0), hole()}) {
    const std::string in = write("closed.stl", closed);
    const Ran run = claystack("check --repair --dry-run --thicken 1.2 " + in);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("geometry: warn: --thicken has no effect: "), std::string::npos)
        << run.out;
  }
}

TEST_F(CheckRepair, FillsNoWideHoleOfAFileThatWasCutOff) {
  // The last 36 triangles are those above 45 degrees, where the border is 20 sqrt(2) mm wide, times
  // sqrt(pi/3), because a ring of 12 corners has the area of its circle.
  TriangleMesh whole = ball(20.0);
  std::ranges::stable_sort(whole.triangles, {}, [&](const auto& t) {
    return whole.points[t[0]].z + whole.points[t[1]].z + whole.points[t[2]].z;
  });
  const std::string bytes = read_text(write("ball.stl", whole));
  const auto cut = [&](std::size_t facets) {
    write_text(folder.file("cut.stl"), bytes.substr(0, bytes.size() - 50 * facets + 10));
    return folder.file("cut.stl");
  };
  const std::string out = folder.file("out.stl");
  const Ran refused = claystack("check --repair " + cut(36) + " -o " + out);
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("found one 28.94 mm wide"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--cap closes the hole by a cap"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  const Ran capped = claystack("check --repair --cap " + cut(36) + " -o " + out);
  EXPECT_EQ(capped.status, 0) << capped.err;
  EXPECT_NE(capped.out.find("contents: warn: 36 of 168 facets are missing, because the file ends "
                            "early; a hole of 28.94 mm was filled"),
            std::string::npos)
      << capped.out;
  const Ran small = claystack("check --repair --dry-run " + cut(1));
  EXPECT_EQ(small.status, 0) << small.err;
  EXPECT_NE(small.out.find("contents: warn: 1 of 168 facets are missing"), std::string::npos)
      << small.out;
}

}  // namespace
}  // namespace clay::test
