#include "claystack/export/formats.hpp"
#include "claystack/export/proof.hpp"
#include "tests/export/solid/shapes.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <regex>
#include <string>

namespace clay::test {
namespace {

/// A valid binary STL of the bowl with few triangles, to plant faults in.
class CheckMesh : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const ScratchFolder folder;
    ASSERT_EQ(
        claystack("throw -q " + sample("bowl.scene.json") + " -o " + folder.file("p.pot.json"))
            .status,
        0);
    ASSERT_EQ(
        claystack("export -q --segments 16 " + folder.file("p.pot.json") + " " +
                  folder.file("p.stl") + " " + folder.file("p.obj") + " " + folder.file("p.drc"))
            .status,
        0);
    good_stl = read_text(folder.file("p.stl"));
    good_obj = read_text(folder.file("p.obj"));
    good_drc = read_text(folder.file("p.drc"));
  }
  static char* facet(std::string& stl, std::size_t k) { return stl.data() + 84 + 50 * k; }
  static void set_count(std::string& stl) {
    const auto count = static_cast<std::uint32_t>((stl.size() - 84) / 50);
    std::memcpy(stl.data() + 80, &count, 4);
  }
  nlohmann::json expect_problem(const std::string& name, const std::string& bytes, int status,
                                const std::string& says,
                                const std::string& verdict = "will not print") {
    write_text(folder.file(name), bytes);
    const Ran run = claystack("check --json " + folder.file(name));
    EXPECT_EQ(run.status, status) << name << run.out << run.err;
    const auto json = run.json();
    EXPECT_EQ(violation(load_schema("check"), Json::parse(run.out)), "") << run.out;
    EXPECT_FALSE(json.at("sound")) << name;
    EXPECT_EQ(json.at("verdict"), status == 2 ? "unreadable" : verdict) << name;
    EXPECT_NE(json.at("problems").dump().find(says), std::string::npos)
        << json.at("problems").dump(2);
    return json;
  }
  inline static std::string good_stl, good_obj, good_drc;
  ScratchFolder folder;
};

TEST_F(CheckMesh, ReadsFromStandardInputWhatItReadsFromAFile) {
  const std::string off =
      "COFF\n4 4 6\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  const solid::TriangleMesh mesh =
      solid::decode_mesh(good_stl, solid::MeshFormat::stl_binary, "good").value();
  std::string shouted = solid::encode_stl_ascii(mesh, "bowl");
  const std::string spaced = std::string("\n").append(shouted);
  shouted.replace(0, 5, "SOLID");
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>("t.off", off),
                                    {"shouted.stl", shouted},
                                    {"spaced.stl", spaced}}) {
    const std::string file = folder.file(name);
    write_text(file, bytes);
    const Ran named = claystack("check --json " + file);
    EXPECT_EQ(named.status, 0) << named.err;
    const Ran piped = shell(CLAYSTACK_PROGRAM " check --json - < " + file);
    EXPECT_EQ(piped.status, 0) << name << piped.err;
    EXPECT_EQ(piped.json().at("triangles"), named.json().at("triangles")) << name;
  }
}

TEST_F(CheckMesh, WarnsOfAMeshThatMayBeInMetres) {
  std::string stl = good_stl;
  for (std::size_t k = 0; 84 + 50 * k < stl.size(); ++k)
    for (std::size_t i = 3; i < 12; ++i) {
      float coordinate = 0.0F;
      std::memcpy(&coordinate, facet(stl, k) + 4 * i, 4);
      coordinate *= 0x1p-10F;  // exact, so the mesh stays sound
      std::memcpy(facet(stl, k) + 4 * i, &coordinate, 4);
    }
  for (const auto& [bytes, warned] : {std::pair(good_stl, false), {stl, true}}) {
    write_text(folder.file("m.stl"), bytes);
    const Ran run = claystack("check " + folder.file("m.stl"));
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(run.out.find("this one may be in metres") != std::string::npos, warned) << run.out;
  }
}

TEST_F(CheckMesh, WarnsOfAPotAsLargeAsARoom) {
  using namespace solid::shapes;
  for (const auto& [side_mm, warned] : {std::pair(990.0, false), {1100.0, true}}) {
    write_text(folder.file("m.stl"),
               *solid::encode_mesh(cube(side_mm), solid::MeshFormat::stl_binary));
    const Ran run = claystack("check " + folder.file("m.stl"));
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(run.out.find("in a smaller unit") != std::string::npos, warned) << run.out;
    EXPECT_EQ(run.out.find("import --height MM") != std::string::npos, warned) << run.out;
  }
}

TEST_F(CheckMesh, WarnsOfPartsInMidAir) {
  using namespace solid::shapes;
  for (const auto& [gap_mm, warned] : {std::pair(0.2, true), {-0.5, false}}) {
    const auto mesh = together(cube(20), moved(cube(5), {20.0 + gap_mm, 5, 8}));
    write_text(folder.file("m.stl"), *solid::encode_mesh(mesh, solid::MeshFormat::stl_binary));
    const Ran run = claystack("check --accept prints " + folder.file("m.stl"));
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(run.out.find("geometry: warn: 1 of 2 parts does not touch the bed or a part on it: "
                           "its lowest point is 8 mm above the bed") != std::string::npos,
              warned)
        << run.out;
  }
}

TEST_F(CheckMesh, NamesTheNextStep) {
  using namespace solid::shapes;
  const auto output_of = [&](const solid::TriangleMesh& mesh) {
    write_text(folder.file("m.stl"), *solid::encode_mesh(mesh, solid::MeshFormat::stl_binary));
    return claystack("check " + folder.file("m.stl")).out;
  };
  EXPECT_NE(output_of(together(cube(20), moved(cube(5), {18, 5, 8}))).find("--accept prints"),
            std::string::npos);
  EXPECT_NE(output_of(inverted(cube(20))).find("--repair --dry-run"), std::string::npos);
  EXPECT_EQ(output_of(cube(20)).find("next:"), std::string::npos);
}

TEST_F(CheckMesh, ReportsAHoleWithItsPlace) {
  std::string stl = good_stl;
  stl.erase(84 + 50 * 100, 50);
  set_count(stl);
  const auto json = expect_problem("hole.stl", stl, 1, "open edge");
  EXPECT_FALSE(json.at("closed"));
  EXPECT_TRUE(json.at("manifold"));
  EXPECT_NE(json.at("problems").dump().find(" mm"), std::string::npos);
}

TEST_F(CheckMesh, ReportsAFlippedFaceWithItsPlace) {
  std::string stl = good_stl;
  char* corners = facet(stl, 57) + 12;
  char second[12];
  std::memcpy(second, corners + 12, 12);
  std::memmove(corners + 12, corners + 24, 12);
  std::memcpy(corners + 24, second, 12);
  const auto json = expect_problem("flipped.stl", stl, 1, "57");
  EXPECT_FALSE(json.at("oriented"));
  EXPECT_TRUE(json.at("closed"));
}

TEST_F(CheckMesh, ReportsNanWithItsPlace) {
  std::string stl = good_stl;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(facet(stl, 33) + 12, &nan, 4);
  expect_problem("nan.stl", stl, 2, "facet 34");  // counted from 1
  std::string obj = good_obj;
  obj.replace(obj.find("\nv ") + 3, 1, "nan ");
  expect_problem("nan.obj", obj, 2, "nan.obj:");
}

TEST_F(CheckMesh, RefusesATruncatedFile) {
  expect_problem("cut.stl", good_stl.substr(0, good_stl.size() - 7), 2, "cut.stl");
  expect_problem("cut.obj", good_obj.substr(0, good_obj.size() - 5), 2, "cut.obj:");
  expect_problem("cut.drc", good_drc.substr(0, good_drc.size() / 2), 2, "cut.drc");
  expect_problem("empty.stl", "", 2, "empty.stl");
}

TEST_F(CheckMesh, RefusesAChangedDracoFile) {
  std::string drc = good_drc;
  drc.back() = static_cast<char>(drc.back() ^ 1);
  expect_problem("changed.drc", drc, 2, "the file has been changed");
}

TEST_F(CheckMesh, ReportsAnIntactDracoChecksum) {
  write_text(folder.file("p.drc"), good_drc);
  const Ran run = claystack("check --json " + folder.file("p.drc"));
  EXPECT_EQ(run.status, 0) << run.err;
  const auto checks = run.json().at("checks");
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks.at(0).at("check"), "contents");
  EXPECT_EQ(checks.at(0).at("verdict"), "pass");
  EXPECT_EQ(checks.at(0).at("text"), "checksum holds");
}

TEST_F(CheckMesh, ReportsAnInsideOutMesh) {
  std::string stl = good_stl;
  for (std::size_t k = 0; k < (stl.size() - 84) / 50; ++k) {
    char second[12];
    char* corners = facet(stl, k) + 12;
    std::memcpy(second, corners + 12, 12);
    std::memmove(corners + 12, corners + 24, 12);
    std::memcpy(corners + 24, second, 12);
  }
  const auto json = expect_problem("inside-out.stl", stl, 1, "");
  EXPECT_FALSE(json.at("oriented"));
  EXPECT_LT(json.at("volume_mm3"), 0.0);
}

TEST_F(CheckMesh, ReportsADuplicateFaceAsNonManifold) {
  std::string stl = good_stl;
  stl.append(good_stl, 84 + 50 * 10, 50);
  set_count(stl);
  EXPECT_FALSE(expect_problem("double.stl", stl, 1, "10").at("manifold"));
}

TEST_F(CheckMesh, ReportsASpikeThroughTheWallAsSelfIntersection) {
  // Moves every copy of one vertex across the pot: still closed, but self-intersecting.
  std::string stl = good_stl;
  char vertex[12];
  std::memcpy(vertex, facet(stl, 200) + 12, 12);
  float moved[3];
  std::memcpy(moved, vertex, 12);
  moved[0] = -moved[0] * 1.5f;
  moved[1] = -moved[1] * 1.5f;
  for (std::size_t k = 0; k < (stl.size() - 84) / 50; ++k)
    for (int corner = 0; corner < 3; ++corner)
      if (std::memcmp(facet(stl, k) + 12 + 12 * corner, vertex, 12) == 0)
        std::memcpy(facet(stl, k) + 12 + 12 * corner, moved, 12);
  const auto json = expect_problem("spike.stl", stl, 1, "self-intersection", "prints");
  EXPECT_TRUE(json.at("closed"));
  EXPECT_GT(json.at("self_intersections"), 0);
}

TEST(CheckPot, MinimumWallIsThatOfItsThinnestPart) {
  // A leaning wall, drawn 6 mm thick, is a few micrometres thinner in the solid. Rounded up in one
  // place and down in the other, the line would contradict itself.
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json");
  ASSERT_EQ(
      claystack("import " + sample("drawings/tumbler.csv") + " -o " + pot + " --wall 6").status, 0);
  const std::string text = claystack("check " + pot).out;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      text, found, std::regex(R"(minimum wall (\S+) mm \(wall (\S+) mm .*lip (\S+) mm)")))
      << text;
  EXPECT_EQ(found.str(1), std::min(found.str(2), found.str(3))) << text;
}

TEST(CheckPot, MeasuresTheWall) {
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  // The wall of the pot is measured on its export; that of its facets is slightly thinner.
  const auto exported = claystack("export --json " + pot + " " + folder.file("p.stl")).json();
  const double wall = exported.at("min_wall_mm");
  EXPECT_EQ(claystack("check " + pot + " --min-wall " + std::to_string(wall - 0.01)).status, 0);
  const Ran thin = claystack("check --json " + pot + " --min-wall " + std::to_string(wall + 0.01));
  EXPECT_EQ(thin.status, 1);
  const auto json = thin.json();
  EXPECT_EQ(violation(load_schema("check"), Json::parse(thin.out)), "") << thin.out;
  EXPECT_EQ(json.at("verdict"), "sound");  // of the mesh
  EXPECT_FALSE(json.at("passes"));
  EXPECT_TRUE(json.at("problems").empty());
  const auto walls = json.at("checks").at(0);
  EXPECT_EQ(walls.at("check"), "walls");
  EXPECT_EQ(walls.at("verdict"), "fail");
  const std::string text = walls.at("text");
  EXPECT_EQ(text.substr(0, 10), "thin wall:") << text;
  EXPECT_NE(text.find("mm of height"), std::string::npos) << text;
  const Ran shown = claystack("check " + pot + " --min-wall " + std::to_string(wall + 0.01));
  EXPECT_NE(shown.out.find(": sound; walls: fail\n"), std::string::npos) << shown.out;
}

TEST(CheckPot, PassPrintsNoFailure) {
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  const Ran run = claystack("check --process fdm " + pot);
  EXPECT_EQ(run.status, 0) << run.out;
  for (const char* word : {"fail", "NOT", "not ", "problem", "unsound"})
    EXPECT_EQ(run.out.find(word), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("  walls: pass: "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("  process: "), std::string::npos) << run.out;
}

/// As the same pot: its size, and its undersides.
TEST(Check, ComparesAMeshWithTheLimitsOfTheProcess) {
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json"), mesh = folder.file("p.stl");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + ' ' + mesh).status, 0);
  const auto process = [&](const std::string& limits) {
    const std::string file = folder.file("kiln.process.json");
    write_text(file, R"({"schema": "claystack-process-1", "name": "kiln",
      "walls": [{"min_wall_mm": 1, "source": "s"}], )" +
                         limits + "}");
    return "check --process " + file + ' ';
  };
  const std::string small =
      process(R"("size": {"width_mm": 200, "depth_mm": 20, "height_mm": 200, "source": "s"})");
  for (const std::string& file : {pot, mesh}) {
    const Ran ran = claystack(small + file);
    EXPECT_EQ(ran.status, 1) << ran.out;
    EXPECT_NE(ran.out.find("process: fail: too large: 1"), std::string::npos) << ran.out;
  }
  const std::string steep = process(R"("overhang": {"max_deg": 30, "source": "s"})");
  for (const std::string& file : {pot, mesh}) {
    const Ran ran = claystack(steep + file);
    EXPECT_EQ(ran.status, 0) << ran.out;
    EXPECT_NE(ran.out.find("process: warn: overhang of "), std::string::npos) << ran.out;
  }
  const std::string both =
      process(R"("size": {"width_mm": 200, "depth_mm": 20, "height_mm": 200, "source": "s"},
                 "overhang": {"max_deg": 30, "source": "s"})");
  for (const std::string& file : {pot, mesh}) {
    const Ran ran = claystack(both + file);
    EXPECT_NE(ran.out.find("process: fail: too large: 1"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("process: warn: overhang of "), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("process: pass"), std::string::npos) << ran.out;
  }
  const Ran fits = claystack(process(R"("overhang": {"max_deg": 89, "source": "s"})") + mesh);
  EXPECT_NE(fits.out.find("process: pass: kiln: 1"), std::string::npos) << fits.out;
}

TEST(CheckPot, ReportsACollapsedPotAsUnsound) {
  const ScratchFolder folder;
  const std::string pot = folder.file("c.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("collapse.scene.json") + " -o " + pot).status, 0);
  const Ran run = claystack("check --json " + pot);
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.json().at("problems").at(0).at("what"), "collapsed");
}

TEST(CheckPot, WarnsOfAClosedCavity) {
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  auto json = nlohmann::ordered_json::parse(read_text(pot));
  const auto mm2 = [](std::int64_t value) { return value << 36; };
  json["rings"] = {{"outer2", {mm2(400), mm2(400), mm2(400)}}, {"inner2", {0, mm2(225), 0}}};
  json["crown"] = "0";
  json["ledger"] = {
      {"initial", std::to_string(mm2(975))}, {"added", "0"}, {"trimmed", "0"}, {"outside", "0"}};
  write_text(pot, json.dump());
  const Ran run = claystack("check --json " + pot);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  // Its floor and lid of a ring each get a warning, too.
  const auto checks = run.json().at("checks");
  EXPECT_TRUE(std::ranges::any_of(checks, [](const auto& check) {
    return check.at("check") == "geometry" && check.at("verdict") == "warn" &&
           check.at("text").template get<std::string>().find("closed cavity") != std::string::npos;
  })) << run.out;
  const Ran fired = claystack("check --process stoneware --json " + pot);
  EXPECT_EQ(fired.status, 1) << fired.out;
  const Ran exported = claystack("export " + pot + " " + folder.file("p.stl"));
  EXPECT_EQ(exported.status, 0) << exported.err;
  EXPECT_NE(exported.err.find("drain hole"), std::string::npos);
  // The pot and its mesh name the check alike, for each process.
  for (const char* process : {"", "--process sla ", "--process stoneware "})
    for (const std::string& file : {pot, folder.file("p.stl")}) {
      const auto found = claystack(std::string("check --json ") + process + file).json();
      std::string names;
      for (const auto& check : found.at("checks"))
        if (check.at("text").get<std::string>().find("drain hole") != std::string::npos)
          names += check.at("check").get<std::string>() + ';';
      EXPECT_EQ(names, "geometry;") << process << file;
    }
}

TEST(CheckPot, DetectsAnEditedQuantumByTheLedger) {
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  auto json = nlohmann::ordered_json::parse(read_text(pot));
  auto& quanta = json["rings"]["outer2"][100];
  quanta = quanta.get<std::int64_t>() + 1;
  write_text(pot, json.dump());
  const Ran run = claystack("check " + pot);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("ledger"), std::string::npos) << run.err;
}

/// A box of any three sides.
solid::TriangleMesh block(const glm::dvec3& size_mm) {
  solid::TriangleMesh mesh = solid::shapes::cube(1.0);
  for (glm::dvec3& p : mesh.points) p *= size_mm;
  return mesh;
}

TEST(Check, StatesSizeAreaAndVolume) {
  const ScratchFolder folder;
  const std::string file = folder.file("block.obj");
  solid::TriangleMesh mesh = block({10, 20, 30});
  mesh.points.emplace_back(900, 0, 0);  // of no triangle
  write_text(file, solid::encode_obj(mesh, "block"));
  const auto json = claystack("check --json " + file).json();
  EXPECT_EQ(json.at("size_mm"), (std::vector<double>{10, 20, 30}));
  EXPECT_DOUBLE_EQ(json.at("area_mm2"), 2.0 * (200 + 300 + 600));
  EXPECT_DOUBLE_EQ(json.at("volume_mm3"), 6000.0);
  const Ran text = claystack("check " + file);
  EXPECT_NE(
      text.out.find("6.000 cm3\n  10 x 20 x 30 mm (width x depth x height), surface 22 cm2\n"),
      std::string::npos)
      << text.out;
  write_text(file, solid::encode_obj(block({0.1, 0.2, 0.3}), "block"));
  const Ran tiny = claystack("check " + file);
  EXPECT_NE(tiny.out.find(", 6e-06 cm3\n"), std::string::npos) << tiny.out;
}

/// A point without a triangle is no part of the mesh: neither of its size nor of the bed.
TEST(Check, StrayPointsDoNotMoveTheBed) {
  const ScratchFolder folder;
  const std::string file = folder.file("block.obj"), limits = folder.file("kiln.process.json");
  write_text(file, solid::encode_obj(block({20, 20, 20}), "block") + "v 0 0 -100\n");
  write_text(limits, R"({"schema": "claystack-process-1", "name": "kiln",
    "walls": [{"min_wall_mm": 1, "source": "s"}], "overhang": {"max_deg": 30, "source": "s"}})");
  const Ran ran = claystack("check --process " + limits + ' ' + file);
  EXPECT_EQ(ran.status, 0) << ran.out;
  EXPECT_NE(ran.out.find("20.0 x 20.0 x 20.0 mm, largest overhang 0 degrees"), std::string::npos)
      << ran.out;
}

TEST(Check, StatesNoVolumeOfAnOpenMesh) {
  const ScratchFolder folder;
  const std::string file = folder.file("open.obj");
  solid::TriangleMesh mesh = block({10, 10, 10});
  mesh.triangles.pop_back();
  write_text(file, solid::encode_obj(mesh, "open"));
  const Ran open = claystack("check --json " + file);
  EXPECT_TRUE(open.json().at("volume_mm3").is_null()) << open.out;
  EXPECT_EQ(violation(load_schema("check"), Json::parse(open.out)), "") << open.out;
  const Ran text = claystack("check " + file);
  EXPECT_NE(text.out.find("no volume: the mesh is open"), std::string::npos) << text.out;
  const Ran repaired = claystack("check --json --repair --dry-run " + file);
  EXPECT_TRUE(repaired.json().at("volume_before_mm3").is_null()) << repaired.out;
  EXPECT_NEAR(repaired.json().at("volume_mm3"), 1000.0, 1e-3);
  EXPECT_EQ(violation(load_schema("check"), Json::parse(repaired.out)), "") << repaired.out;
  const Ran repair_text = claystack("check --repair --dry-run " + file);
  EXPECT_NE(
      repair_text.out.find("volume: none before, because the mesh encloses none, 1 cm3 after"),
      std::string::npos)
      << repair_text.out;
  const Ran coarser = claystack("check --dry-run --max-triangles 1000 " + file);
  EXPECT_NE(coarser.out.find("volume: none before, because the mesh encloses none, none after, "
                             "because the mesh encloses none"),
            std::string::npos)
      << coarser.out;
}

TEST(Check, StatesNoVolumeIfAFaceIsThereTwice) {
  const ScratchFolder folder;
  const std::string file = folder.file("twice.obj");
  solid::TriangleMesh mesh = block({10, 10, 10});
  mesh.triangles.push_back(mesh.triangles.front());
  write_text(file, solid::encode_obj(mesh, "twice"));
  const Ran json = claystack("check --json " + file), text = claystack("check " + file);
  EXPECT_TRUE(json.json().at("volume_mm3").is_null()) << json.out;
  EXPECT_NE(text.out.find("no volume: faces at a non-manifold edge have no opposite face"),
            std::string::npos)
      << text.out;
}

TEST(Check, WarnsOfAMeshOfMoreThanTenMetres) {
  const ScratchFolder folder;
  for (const auto& [side_mm, warned] : {std::pair(9'999.0, false), {10'001.0, true}}) {
    const solid::TriangleMesh mesh = block({side_mm, 10, 10});
    for (const auto& [name, bytes] :
         {std::pair("a.stl", solid::encode_stl_binary(mesh)),
          {"a.3mf", solid::encode_mesh(mesh, solid::MeshFormat::three_mf).value()}}) {
      write_text(folder.file(name), bytes);
      const Ran run = claystack("check " + folder.file(name));
      EXPECT_EQ(run.status, 0) << run.out;
      EXPECT_EQ(run.out.find("geometry: warn: 10 x 0.01 x 0.01 m: ") != std::string::npos, warned)
          << run.out;
    }
  }
}

TEST(Check, WarnsOfAMeshOfLessThanAHundredthOfAMetreInEachFormat) {
  const ScratchFolder folder;
  for (const auto& [side_mm, warned] : {std::pair(9.9, true), {10.1, false}}) {
    const solid::TriangleMesh mesh = block({side_mm, 5, 5});
    for (const auto& [name, format] : {std::pair("a.stl", solid::MeshFormat::stl_binary),
                                       {"a.3mf", solid::MeshFormat::three_mf},
                                       {"a.glb", solid::MeshFormat::glb}}) {
      write_text(folder.file(name), solid::encode_mesh(mesh, format).value());
      const Ran run = claystack("check " + folder.file(name));
      EXPECT_EQ(run.status, 0) << run.out;
      EXPECT_EQ(run.out.find("geometry: warn: only 9.9 x 5 x 5 mm: ") != std::string::npos, warned)
          << run.out;
    }
  }
}

/// PrusaSlicer refuses the file: "The file contains polygons with more than 4 vertices."
TEST(Check, NotesFacesOfAnObjThatPrusaSlicerRefuses) {
  const ScratchFolder folder;
  const std::string file = folder.file("a.obj"), out = folder.file("out.obj");
  const std::string points =
      "v 0 0 0\nv 20 0 0\nv 30 10 0\nv 20 20 0\nv 0 20 0\nv 0 0 9\nv 20 0 9\nv 30 10 9\n"
      "v 20 20 9\nv 0 20 9\n";
  const std::string sides = "f 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\n";
  write_text(file, points + sides + "f 5 4 3 2 1\nf 6 7 8 9 10\n");
  const Ran run = claystack("check --json " + file);
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_EQ(run.json().at("notes"),
            std::vector<std::string>{"line 16: 2 faces of more than 4 corners: PrusaSlicer refuses "
                                     "such a file; check --repair writes triangles"});
  ASSERT_EQ(claystack("check --repair -o " + out + " " + file).status, 0);
  EXPECT_TRUE(claystack("check --json " + out).json().at("notes").empty());
  write_text(file, points + sides + "f 5 4 3 2\nf 5 2 1\nf 6 7 8 9\nf 6 9 10\n");
  EXPECT_TRUE(claystack("check --json " + file).json().at("notes").empty());
}

TEST(Check, ReadsStandardInputAndWritesStandardOutput) {
  const ScratchFolder folder;
  solid::TriangleMesh mesh = solid::shapes::cube(20.0);
  const std::string stl = folder.file("a.stl"), obj = folder.file("a.obj");
  write_text(stl, solid::encode_stl_binary(mesh));
  write_text(obj, solid::encode_obj(mesh, "cube"));
  for (const std::string& file : {stl, obj}) {
    const Ran run = claystack("check --json - < " + file);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.json().at("triangles"), 12);
  }
  const std::string pot = folder.file("a.pot.cbor");
  ASSERT_EQ(claystack("throw -q " + sample("paper/bowl.scene.json") + " -o " + pot).status, 0);
  EXPECT_EQ(claystack("check --json - < " + pot).json().at("volume_mm3"),
            claystack("check --json " + pot).json().at("volume_mm3"));
  mesh.triangles.pop_back();
  write_text(obj, solid::encode_obj(mesh, "cube"));
  const std::string out = folder.file("out.stl");
  EXPECT_EQ(claystack("check --repair -o - - < " + obj + " > " + out).status, 0);
  EXPECT_EQ(claystack("check " + out).status, 0);
  EXPECT_EQ(claystack("check --repair --json -o - - < " + obj).status, 2);
}

TEST(Check, ListsKnownExtensionsForAnUnknownOne) {
  const ScratchFolder folder;
  write_text(folder.file("pot.blend"), "x");
  const Ran run = claystack("check " + folder.file("pot.blend"));
  EXPECT_EQ(run.status, 2);
  for (const char* ending : {".stl", ".obj", ".drc", ".ply", ".3mf", ".glb", ".off", ".pot.json"})
    EXPECT_NE(run.err.find(ending), std::string::npos) << run.err;
}

}  // namespace
}  // namespace clay::test
