// What the options of `claystack export` promise.

#include "tests/app/cli/thrown_bowl.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace clay::test {
namespace {

class ExportOptions : public ThrownBowl {
 protected:
  Ran run(const std::string& options) const {
    return claystack("export " + pot + " " + stl + " " + options);
  }
  std::string stl = folder.file("bowl.stl");
};

TEST_F(ExportOptions, ThinWallExitsOneWithTheLimitAndItsSource) {
  const Ran demand = run("--min-wall 40");
  EXPECT_EQ(demand.status, 1);
  EXPECT_NE(demand.err.find("expected at least 40.000 mm (--min-wall)"), std::string::npos)
      << demand.err;
  EXPECT_TRUE(std::filesystem::exists(stl));
  const Ran process = run("--process " + sample("workshop.process.json"));
  EXPECT_EQ(process.status, 1);
  EXPECT_NE(process.err.find("two beads"), std::string::npos) << process.err;
  EXPECT_EQ(run("--process porcelain").status, 0);
}

TEST_F(ExportOptions, ReportsUnknownProcessesBeforeWriting) {
  const Ran unknown = run("--process bronze");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("earthenware"), std::string::npos) << unknown.err;
  EXPECT_EQ(run("--process " + folder.file("none.json")).status, 3);
  EXPECT_EQ(run("--process " + pot).status, 2);
  EXPECT_FALSE(std::filesystem::exists(stl));
}

TEST_F(ExportOptions, RefusesFiguresOfFiringWithoutAShrinkage) {
  for (const std::string option : {"--water 15%", "--ignition-loss 5%", "--drying-shrinkage 4%"}) {
    const Ran alone = run(option);
    EXPECT_EQ(alone.status, 2);
    EXPECT_NE(alone.err.find(option.substr(0, option.find(' ')) + ": expected --shrinkage too"),
              std::string::npos)
        << alone.err;
    EXPECT_FALSE(std::filesystem::exists(stl));
  }
  EXPECT_EQ(run("--shrinkage 8% --water 15% --ignition-loss 5% --drying-shrinkage 4%").status, 0);
}

// The polygon of n sides with the area of the circle: its corners stand out by r (f - 1), the
// middles of its sides are r (1 - f cos(pi / n)) inside, where f^2 = (2 pi / n) / sin(2 pi / n).
TEST_F(ExportOptions, TheStatedDistanceIncludesTheFacets) {
  constexpr double kSides = 16.0, kPi = std::numbers::pi;
  const double f = std::sqrt(2.0 * kPi / kSides / std::sin(2.0 * kPi / kSides));
  const double radius_mm =
      0.5 * nlohmann::json::parse(run("--json").out).at("diameter_mm").get<double>();
  const double expected_mm = radius_mm * std::max(f - 1.0, 1.0 - f * std::cos(kPi / kSides));
  const std::string out = run("--segments 16").out;
  const std::size_t at = out.find(", within ");
  ASSERT_NE(at, std::string::npos) << out;
  EXPECT_NEAR(std::stod(out.substr(at + 9)), expected_mm, 0.05 * expected_mm) << out;
  EXPECT_NE(out.find(" mm of the round solid, read back"), std::string::npos) << out;
}

TEST_F(ExportOptions, TheReportEqualsTheJsonOutput) {
  const std::string report = folder.file("report.json");
  const Ran printed = run("--json --report " + report);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_EQ(printed.out, read_text(report));
}

TEST_F(ExportOptions, TrianglesStayWithinTheBudget) {
  const auto all = run("--json").json();
  for (const int most : {20'000, 3'000, 400}) {
    const auto few = run("--json --max-triangles " + std::to_string(most)).json();
    EXPECT_LE(few.at("triangles"), most);
    EXPECT_GT(few.at("triangles"), most / 2);
    EXPECT_GT(few.at("tolerance_mm"), all.at("tolerance_mm"));
    EXPECT_LT(few.at("volume_error_relative"), 1e-9);
    EXPECT_EQ(claystack("check " + stl).status, 0);
  }
  const Ran impossible = run("--max-triangles 8");
  EXPECT_EQ(impossible.status, 2);
  EXPECT_NE(impossible.err.find("max triangles: expected at least"), std::string::npos);
}

TEST_F(ExportOptions, FullVerificationChecksTheFileLikeAForeignMesh) {
  const auto json = run("--json --verify full").json();
  EXPECT_TRUE(json.at("files").at(0).at("full_verification").at("sound"));
  EXPECT_EQ(json.at("files").at(0).at("full_verification").at("self_intersections"), 0);
}

TEST_F(ExportOptions, AShrinkageMakesTheFilesLarger) {
  const auto plain = run("--json").json();
  const std::string svg = folder.file("larger.svg");
  const auto larger = run(svg + " --shrinkage 12% --json").json();
  const double factor = 1.0 / 0.88;
  EXPECT_NEAR(larger.at("height_mm").get<double>(), factor * plain.at("height_mm").get<double>(),
              1e-9);
  EXPECT_NEAR(larger.at("volume_mm3").get<double>() / plain.at("volume_mm3").get<double>(),
              factor * factor * factor, 1e-8);
  const auto& fired = larger.at("shrinkage");
  EXPECT_NEAR(fired.at("fired_height_mm").get<double>(), plain.at("height_mm").get<double>(), 1e-9);
  EXPECT_NEAR(fired.at("fired_volume_mm3").get<double>(), plain.at("volume_mm3").get<double>(),
              1e-2);
  // The file itself, by a program of another house.
  const std::string info = shell("prusa-slicer --info " + stl).out;
  const auto size_z = info.find("size_z = ");
  ASSERT_NE(size_z, std::string::npos) << info;
  EXPECT_NEAR(std::stod(info.substr(size_z + 9)), larger.at("height_mm").get<double>(), 1e-3);
  EXPECT_EQ(claystack("check " + stl).status, 0);
  EXPECT_NE(claystack("export " + pot + " " + stl + " --shrinkage 12%").out.find(" fired"),
            std::string::npos);
}

TEST_F(ExportOptions, AShrinkageIsAPercentage) {
  for (const char* bad : {"0.12", "12", "60%", "-1%", "x%", "%"})
    EXPECT_EQ(run(std::string("--shrinkage ") + bad).status, 2) << bad;
  EXPECT_EQ(run("--shrinkage 7.5%").status, 0);
  const Ran alone =
      claystack("export " + pot + " " + folder.file("copy.pot.json") + " --shrinkage 12%");
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.err.find("--shrinkage: expected a mesh"), std::string::npos) << alone.err;
}

TEST_F(ExportOptions, NormalsAreForObj) {
  const std::string obj = folder.file("n.obj");
  ASSERT_EQ(claystack("export -q --normals " + pot + " " + obj).status, 0);
  EXPECT_NE(read_text(obj).find("\nvn "), std::string::npos);
  EXPECT_NE(shell("prusa-slicer --info " + obj).out.find("manifold = yes"), std::string::npos);
  EXPECT_EQ(claystack("check " + obj).status, 0);
}

TEST_F(ExportOptions, APlainGlbNeedsNoExtension) {
  const std::string glb = folder.file("b.glb");
  const auto packed = claystack("export --json " + pot + " " + glb).json().at("files").at(0);
  const auto plain = claystack("export --json --glb core --verify full " + pot + " " + glb)
                         .json()
                         .at("files")
                         .at(0);
  EXPECT_EQ(read_text(glb).find("extensionsRequired"), std::string::npos);
  EXPECT_GT(plain.at("bytes").get<int>(), 5 * packed.at("bytes").get<int>());
  EXPECT_LT(plain.at("max_error_mm").get<double>(), 1e-4);
  EXPECT_TRUE(plain.at("full_verification").at("sound"));
  const Ran assimp = shell("assimp info " + glb);
  EXPECT_NE(assimp.out.find("Faces:"), std::string::npos) << assimp.out << assimp.err;
  EXPECT_EQ(claystack("check " + glb).status, 0);
  EXPECT_EQ(run("--glb core").status, 2);
}

TEST_F(ExportOptions, AGlbByMeshoptIsCertifiedAsDecoded) {
  const std::string glb = folder.file("m.glb");
  const auto file =
      claystack("export --json --glb meshopt --verify full --tolerance 0.05 " + pot + " " + glb)
          .json()
          .at("files")
          .at(0);
  EXPECT_NE(read_text(glb).find("EXT_meshopt_compression"), std::string::npos);
  EXPECT_TRUE(file.at("full_verification").at("sound"));
  EXPECT_LE(file.at("max_error_mm").get<double>(), 0.05);
  EXPECT_GT(file.at("max_error_mm").get<double>(), 1e-3);
  EXPECT_EQ(claystack("check " + glb).status, 0);
}

TEST_F(ExportOptions, TheWallMapColoursGlbAnd3mfAlone) {
  const std::string glb = folder.file("w.glb"), package = folder.file("w.3mf");
  ASSERT_EQ(claystack("export -q --wall-map " + pot + " " + glb + " " + package).status, 0);
  EXPECT_NE(read_text(glb).find("COLOR_0"), std::string::npos);
  EXPECT_NE(read_text(glb).find("\"wall_map\""), std::string::npos);
  EXPECT_NE(shell("unzip -p " + package + " 3D/3dmodel.model").out.find("<m:colorgroup"),
            std::string::npos);
  EXPECT_EQ(claystack("check " + package).status, 0);
  EXPECT_EQ(run("--wall-map " + folder.file("w.obj")).status, 2);
}

TEST_F(ExportOptions, WallTableContainsTheMinimum) {
  const std::string csv = folder.file("walls.csv");
  const auto json = run(csv + " --json").json();
  std::istringstream rows(read_text(csv));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "piece,face,arc_mm,rho_mm,y_mm,thickness_mm,opposite_rho_mm,opposite_y_mm");
  double least = 1e9, arc = -1.0;
  int bore = 0;
  while (std::getline(rows, row)) {
    std::vector<std::string> cells;
    std::istringstream line(row);
    for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
    ASSERT_GE(cells.size(), 5u) << row;
    EXPECT_GT(std::stod(cells[2]), arc);
    EXPECT_LE(std::stod(cells[2]), arc < 0.0 ? 0.5 : arc + 0.51);
    arc = std::stod(cells[2]);
    bore += cells[1] == "bore" ? 1 : 0;
    if (cells.size() > 5 && !cells[5].empty()) least = std::min(least, std::stod(cells[5]));
  }
  EXPECT_GT(bore, 50);
  // The mesh's wall is that of the profile, but for the facets' part in a thousand.
  EXPECT_NEAR(least, json.at("min_wall_mm").get<double>(), 0.05);
  EXPECT_EQ(claystack("export -q " + pot + " " + csv).status, 0);  // needs no mesh
}

TEST_F(ExportOptions, ReportsALipFilletAndExactWalls) {
  // A lip that no finger has rounded.
  ASSERT_EQ(claystack("throw -q " + sample("paper/bowl.scene.json") + " -o " + pot).status, 0);
  const auto filleted = run("--json --lip-fillet 1.5").json();
  EXPECT_NEAR(filleted.at("lip_fillet_mm"), 1.5, 1e-12);
  EXPECT_LT(filleted.at("volume_error_relative"), 1e-12);
  const auto exact = run("--json --smooth exact").json();
  EXPECT_EQ(exact.at("smoothing"), "exact");
  EXPECT_LT(exact.at("max_ring_error_relative"), 1e-12);
  const Ran both = run("--smooth exact --lip-fillet 1");
  EXPECT_EQ(both.status, 2);
  EXPECT_NE(both.err.find("fillet"), std::string::npos) << both.err;
}

TEST_F(ExportOptions, WarnsOfALipFilletThatIsSmallerThanAskedFor) {
  // A lip that no finger has rounded, less than 4 mm wide.
  ASSERT_EQ(claystack("throw -q " + sample("paper/bowl.scene.json") + " -o " + pot).status, 0);
  const double made = run("--json --lip-fillet 2").json().at("lip_fillet_mm");
  std::ostringstream begin;
  begin << "claystack: warning: lip fillet of " << std::fixed << std::setprecision(2) << made
        << " mm instead of 2 mm";
  const Ran small = run("--lip-fillet 2");
  EXPECT_EQ(small.status, 0);
  EXPECT_NE(small.err.find(begin.str() + ": "), std::string::npos) << small.err;
  EXPECT_NE(small.err.find("; sharper edges chip\n"), std::string::npos) << small.err;
  const Ran process = run("--process stoneware");
  EXPECT_NE(process.err.find(begin.str() + " (stoneware): "), std::string::npos) << process.err;
  const auto problems = run("--json --lip-fillet 2").json().at("problems");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].at("text").get<std::string>().find("lip fillet of "), 0u);
  EXPECT_EQ(problems[0].at("fails"), false);
  for (const char* fits : {"", "--lip-fillet 1", "--process stoneware --lip-fillet 1mm"})
    EXPECT_EQ(run(fits).err.find("lip fillet"), std::string::npos) << fits;
}

TEST_F(ExportOptions, SaysThatAFillLineIsBelowTheFloor) {
  const Ran low = run("--fill-line 300");
  EXPECT_EQ(low.status, 0);
  EXPECT_NE(low.out.find(" to the brim; the fill line, 300 mm below it, is below the floor\n"),
            std::string::npos)
      << low.out;
  EXPECT_NE(run("--fill-line 5").out.find(" ml to 5 mm below it\n"), std::string::npos);
  const Ran goal = run("--holds 350ml --fill-line 300");
  EXPECT_EQ(goal.status, 2);
  EXPECT_NE(goal.err.find("capacity to the fill line [ml]: expected a fill line above the floor of "
                          "the pot, found one 300 mm below the brim\n"),
            std::string::npos)
      << goal.err;
}

TEST_F(ExportOptions, ReportsTheFairing) {
  EXPECT_EQ(run("--json").json().at("fairing").at("length_mm"), 10.0);  // the tool of the bowl
  EXPECT_FALSE(run("--json --tolerance 0.11").json().contains("fairing"));
  EXPECT_FALSE(run("--json --smooth-length 0").json().contains("fairing"));
  const std::string page = folder.file("r.html");
  const auto json = run("--json --smooth-length 0.9cm --report " + page).json();
  EXPECT_EQ(json.at("fairing").at("length_mm"), 9.0);
  EXPECT_GT(json.at("fairing").at("moved_mm"), 0.01);
  EXPECT_LT(json.at("volume_error_relative"), 1e-12);
  EXPECT_NE(read_text(page).find("over 9 mm; moved the walls by at most "), std::string::npos);
  EXPECT_NE(run("--verbose --smooth-length 9").out.find("faired over 9 mm"), std::string::npos);
  // The fired pot has the same form: all lengths grow alike.
  const auto fired = run("--json --smooth-length 9 --shrinkage 10%").json();
  EXPECT_EQ(fired.at("fairing").at("length_mm"), 10.0);
  EXPECT_EQ(run("--smooth-length 9 --smooth exact").status, 2);
  EXPECT_EQ(run("--smooth-length tool --smooth none").status, 2);
  EXPECT_EQ(run("--smooth-length -1").status, 2);
  EXPECT_EQ(run("--smooth-length 9 --smooth none").status, 2);
}

TEST_F(ExportOptions, TheReportShowsSolidClay) {
  const std::string page = folder.file("r.html"), table = folder.file("t.csv");
  write_text(table, "height_mm,radius_mm\n0,30\n40,30\n");
  ASSERT_EQ(claystack("import -q " + table + " -o " + pot).status, 0);
  ASSERT_EQ(run("-q --report " + page).status, 0);
  const std::string html = read_text(page);
  EXPECT_EQ(html.find("inf mm"), std::string::npos);
  EXPECT_EQ(html.find("nan mm"), std::string::npos);
  EXPECT_NE(html.find("10.0 mm or more"), std::string::npos) << "the top of the scale";
}

TEST_F(ExportOptions, AClayProcessRoundsTheLip) {
  // A lip that no finger has rounded.
  ASSERT_EQ(claystack("throw -q " + sample("paper/bowl.scene.json") + " -o " + pot).status, 0);
  // Half the lip allows less than the 2 mm of the process.
  const double most = run("--json --lip-fillet 2").json().at("lip_fillet_mm");
  EXPECT_GT(most, 1.4);
  EXPECT_EQ(run("--json --process stoneware").json().at("lip_fillet_mm"), most);
  EXPECT_EQ(run("--json --process stoneware --lip-fillet 1").json().at("lip_fillet_mm"), 1.0);
  for (const char* without : {"--process stoneware --lip-fillet 0", "--process fdm",
                              "--process stoneware --smooth exact"})
    EXPECT_FALSE(run(std::string("--json ") + without).json().contains("lip_fillet_mm")) << without;
}

TEST_F(ExportOptions, ReportsTheClayThatFinishingTrims) {
  const std::string page = folder.file("r.html"), step = folder.file("bowl.step");
  const auto plain = run("--json").json();
  const std::string options = "--foot 44x5x3 --floor-fillet 5 --glaze-allowance 0.5";
  const auto json = run(step + " --json " + options).json();
  const auto& finish = json.at("finish");
  EXPECT_NEAR(json.at("volume_mm3").get<double>(),
              plain.at("volume_mm3").get<double>() - finish.at("trimmed_mm3").get<double>() +
                  finish.at("added_mm3").get<double>(),
              1e-6 * plain.at("volume_mm3").get<double>());
  EXPECT_NEAR(finish.at("trimmed_g").get<double>(), 1.9e-3 * finish.at("trimmed_mm3").get<double>(),
              1e-9);
  EXPECT_NEAR(json.at("maker").at("thrown").at("foot_diameter_mm"), 44.0, 1e-9);
  EXPECT_FALSE(plain.contains("finish"));
  const Ran shown = run("--report " + page + " " + options);
  EXPECT_NE(shown.out.find("foot ring: trimmed "), std::string::npos) << shown.out;
  EXPECT_NE(read_text(page).find("foot ring"), std::string::npos);
  // Fired, the glaze is as thick as asked.
  const auto fired = run("--json --shrinkage 50% --glaze-allowance 0.5").json();
  EXPECT_NEAR(fired.at("height_mm").get<double>(), 2.0 * plain.at("height_mm").get<double>() - 1.0,
              1e-6);
  const Ran deep = run("--foot 44x5x3 --min-wall 6.5");
  EXPECT_EQ(deep.status, 1) << deep.err;
  // The walls are too thin without the ring too: the message states where its limit comes from.
  EXPECT_NE(deep.err.find("is below the limit of 6.50 mm already: expected walls of at least 4.12"),
            std::string::npos)
      << deep.err;
  const auto shouted = run("--json --foot 44MMx5MMx3MM").json();
  EXPECT_NEAR(shouted.at("maker").at("thrown").at("foot_diameter_mm"), 44.0, 1e-9);
  for (const char* odd : {"44", "44x5x3x2", "44x5x", "x5x3", "44x-5x3", "44 x 5 x 3"})
    EXPECT_EQ(run(std::string("--foot '") + odd + "'").status, 2) << odd;
}

TEST_F(ExportOptions, MeasuresSkippedStagesOnRequest) {
  const auto plain = run("--json").json(), measured = run("--json --measure-left-out").json();
  for (const auto& item : plain.at("left_out")) EXPECT_FALSE(item.contains("saved_s"));
  bool checked = false;
  for (const auto& item : measured.at("left_out")) {
    if (item.at("what") != "full verification") continue;
    EXPECT_GT(item.at("saved_s"), 0.0);
    checked = true;
  }
  EXPECT_TRUE(checked);
}

TEST_F(ExportOptions, RefusesOptionsWithoutEffect) {
  for (const char* option : {"--ascii", "--normals", "--certificate", "--precision 0.001",
                             "--min-wall 3", "--process sla"}) {
    const Ran nothing =
        claystack("export " + pot + " " + folder.file("section.svg") + " " + option);
    EXPECT_EQ(nothing.status, 2) << option;
    EXPECT_NE(nothing.err.find("among the files to write"), std::string::npos) << nothing.err;
  }
}

TEST_F(ExportOptions, RefusesOptionsOfTheSolidForCopiesOfThePot) {
  const std::string copy = folder.file("copy.pot.cbor"), report = folder.file("r.html");
  for (const char* option :
       {"--segments 5", "--drain 3", "--lip-fillet 2", "--verify full", "--verify margins",
        "--max-triangles 10", "--smooth none", "--smooth fair", "--tolerance 9mm",
        "--smooth-length 9", "--smooth-length tool", "--pieces", "--measure-left-out"}) {
    for (const std::string& more : {std::string(), " --report " + report}) {
      const Ran nothing = claystack("export " + pot + " " + copy + " " + option + more);
      EXPECT_EQ(nothing.status, 2) << option;
      EXPECT_NE(nothing.err.find(": expected a mesh or its section among the files to write"),
                std::string::npos)
          << nothing.err;
      EXPECT_FALSE(std::filesystem::exists(copy)) << option;
    }
  }
  EXPECT_EQ(claystack("export " + pot + " " + copy).status, 0);
}

/// The goal is met by the solid that these options would make.
TEST_F(ExportOptions, GoalOfACopyDependsOnTheOptionsOfTheSolid) {
  const std::string copy = folder.file("copy.pot.cbor");
  std::vector<std::string> copies;
  for (const char* option : {"", " --smooth none", " --shrinkage 12% --fired"}) {
    const Ran ran = claystack("export " + pot + " " + copy + " --holds 350ml" + option);
    ASSERT_EQ(ran.status, 0) << ran.err;
    copies.push_back(read_text(copy));
  }
  EXPECT_FALSE(copies[0] == copies[1]);
  EXPECT_FALSE(copies[0] == copies[2]);
}

TEST_F(ExportOptions, ReportsThatPipesCannotBeReadBack) {
  const std::string pipe = folder.file("pipe.stl");
  const Ran run = shell("mkfifo " + pipe + " && cat " + pipe + " > " + stl + " & sleep 0.2; " +
                        CLAYSTACK_PROGRAM " export --json " + pot + " " + pipe + "; wait");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(run.json().at("files").at(0).at("read_back"));
  EXPECT_EQ(std::filesystem::file_size(stl), run.json().at("files").at(0).at("bytes"));
}

/// A closed box: solid foot of 10 mm, cavity of 10 mm, lid of 10 mm; R = 30 mm, r = 20 mm.
constexpr const char* kBox = R"({"schema": "claystack-pot-1", "written_by": "test",
 "model": "conserving", "density_g_cm3": 1.9, "ring_height_mm": 10, "max_rings": 100,
 "quantum_mm2": "2^-36",
 "rings": {"outer2": [61847529062400, 61847529062400, 61847529062400],
           "inner2": [0, 27487790694400, 0],
           "outer_mm": [30, 30, 30], "inner_mm": [0, 20, 0]},
 "crown": "0",
 "ledger": {"initial": "158054796492800", "added": "0", "trimmed": "0", "outside": "0"},
 "collapse": null})";

TEST(ExportDrain, OpensACavityAndReportsTheRemovedClay) {
  const ScratchFolder folder;
  const std::string pot = folder.file("box.pot.json"), stl = folder.file("box.stl");
  write_text(pot, kBox);
  const Ran closed = claystack("export --json " + pot + " " + stl);
  ASSERT_EQ(closed.status, 0) << closed.err;
  EXPECT_EQ(closed.json().at("cavities").size(), 1u);
  EXPECT_EQ(closed.json().at("shells"), 2);
  EXPECT_NE(closed.err.find("drain hole"), std::string::npos);
  const Ran drained = claystack("export --json --drain 6 " + pot + " " + stl);
  ASSERT_EQ(drained.status, 0) << drained.err;
  EXPECT_TRUE(drained.json().at("cavities").empty());
  EXPECT_EQ(drained.json().at("shells"), 1);
  EXPECT_NEAR(drained.json().at("drilled_mm3"), std::numbers::pi * 9.0 * 10.0, 1e-6);
  EXPECT_EQ(drained.json().at("drain_mm"), 6.0);
  EXPECT_EQ(claystack("check " + stl).status, 0);
  const Ran shown = claystack("export --drain 6 " + pot + " " + stl);
  EXPECT_NE(shown.out.find("drain hole: 6 mm wide, 0.283 cm3 of clay removed"), std::string::npos)
      << shown.out;
}

TEST(ExportDrain, OfLessThanTwoMillimetresMayClose) {
  const ScratchFolder folder;
  const std::string pot = folder.file("box.pot.json");
  write_text(pot, kBox);
  const auto drained = [&](const std::string& options) {
    return claystack("export " + pot + " " + folder.file("box.stl") + " --drain " + options);
  };
  const std::string narrow = "drain hole of 0.001 mm: expected at least 2 mm";
  const Ran fired = drained("0.001 --process stoneware");
  EXPECT_EQ(fired.status, 1) << fired.err;
  EXPECT_NE(fired.err.find(narrow), std::string::npos) << fired.err;
  const Ran printed = drained("0.001 --process fdm");
  EXPECT_EQ(printed.status, 0) << printed.err;
  EXPECT_NE(printed.err.find("warning: " + narrow), std::string::npos) << printed.err;
  const Ran wide = drained("2 --process stoneware");
  EXPECT_EQ(wide.status, 0) << wide.err;
  EXPECT_EQ(wide.err.find("drain hole of"), std::string::npos) << wide.err;
}

/// Smaller parts than float32 separates, and set-backs within the tolerance.
TEST_F(ExportOptions, RefusesPartsThatAreTooSmall) {
  for (const char* option : {"--floor-fillet", "--lip-fillet", "--glaze-allowance"}) {
    for (const char* small : {"1e-9", "0.0009", "-1"}) {
      const Ran refused = run(std::string(option) + ' ' + small);
      EXPECT_EQ(refused.status, 2) << option << ' ' << small << refused.err;
      EXPECT_NE(refused.err.find(std::string(option) + ": expected 0 or a length from 0.001 to "),
                std::string::npos)
          << refused.err;
    }
    EXPECT_EQ(run(std::string(option) + " 0").status, 0) << option;
    EXPECT_EQ(run(std::string(option) + " 0.005").status, 0) << option;
  }
  const Ran coarse = run("--glaze-allowance 0.01 --tolerance 0.2");
  EXPECT_EQ(coarse.status, 2);
  EXPECT_NE(coarse.err.find("glaze allowance: expected 0, or at least 0.02 mm, found 0.01 mm"),
            std::string::npos)
      << coarse.err;
}

TEST_F(ExportOptions, StatesOneFiredSize) {
  for (const std::string facets : {"", " --segments 3"}) {
    const auto json = run("--json --shrinkage 10%" + facets).json();
    const auto& fired = json.at("maker").at("fired");
    EXPECT_NEAR(json.at("shrinkage").at("fired_diameter_mm").get<double>(),
                fired.at("diameter_mm").get<double>(), 1e-9);
    EXPECT_NEAR(json.at("shrinkage").at("fired_height_mm").get<double>(),
                fired.at("height_mm").get<double>(), 1e-9);
  }
}

TEST_F(ExportOptions, WritesNothingIfOneFileCannotBeWritten) {
  const Ran report = run("--report " + folder.file("none/report.json"));
  EXPECT_EQ(report.status, 3) << report.err;
  std::filesystem::create_directory(stl + ".certificate.json");
  const Ran certificate = run("--certificate");
  EXPECT_EQ(certificate.status, 3) << certificate.err;
  EXPECT_FALSE(std::filesystem::exists(stl));
}

TEST_F(ExportOptions, DrawingAloneProvesNothing) {
  const auto json = claystack("export --json " + pot + " " + folder.file("b.svg")).json();
  EXPECT_EQ(json.at("files").size(), 1u);
  for (const char* claim : {"certificate", "volume_mm3", "min_wall_mm", "wall_demand"})
    EXPECT_FALSE(json.contains(claim)) << claim;
  const Ran none = claystack("export --certificate " + pot + " " + folder.file("b.svg"));
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("--certificate: expected a mesh"), std::string::npos) << none.err;
}

TEST_F(ExportOptions, AFilletWithoutSmoothingIsRefused) {
  const Ran run_none = run("--lip-fillet 1 --smooth none");
  EXPECT_EQ(run_none.status, 2);
  EXPECT_NE(run_none.err.find("--lip-fillet: expected --smooth fair, found none"),
            std::string::npos)
      << run_none.err;
}

TEST_F(ExportOptions, ErrorsOfTheRequestNameTheOptionAndNotThePot) {
  for (const auto& [options, says] :
       {std::pair("--shrinkage 12% --drying-shrinkage 13%",
                  "claystack: --drying-shrinkage: expected at most --shrinkage, 12%, found 13%"),
        {"--smooth none --smooth-length 9",
         "claystack: --smooth-length: expected --smooth fair, found none"},
        {"--fired --height 100", "claystack: --fired: expected --shrinkage too"},
        {"--height 120 --diameter 60 --holds 350ml", "claystack: goal: expected one figure"}}) {
    const Ran refused = run(options);
    EXPECT_EQ(refused.status, 2) << options;
    EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
  }
}

TEST_F(ExportOptions, JsonReplacesInvalidUtf8InNames) {
  const std::string odd = folder.file("\xff.stl");
  ASSERT_EQ(claystack("export -q " + pot + " " + odd).status, 0);
  const Ran check = claystack("check --json " + odd);
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_TRUE(check.json().at("sound"));
}

TEST_F(ExportOptions, VerboseNamesTheThinnestPlaceOfWallAndLip) {
  const auto parts = claystack("check --json " + pot).json().at("wall_parts");
  ASSERT_EQ(parts.size(), 2u);
  std::ostringstream text;
  text << "thinnest places: wall " << std::fixed << std::setprecision(3)
       << parts[0].at("min_wall_mm").get<double>() << " mm at a height of " << std::setprecision(1)
       << parts[0].at("at_mm").at(1).get<double>() << " mm, lip ";
  const Ran verbose = run("-v");
  EXPECT_NE(verbose.out.find(text.str()), std::string::npos) << text.str() << verbose.out;
  EXPECT_EQ(run("").out.find("thinnest places"), std::string::npos);
}

TEST_F(ExportOptions, WritesABinaryStlToStandardOutput) {
  ASSERT_EQ(run("").status, 0);
  const Ran streamed = claystack("export " + pot + " -");
  EXPECT_EQ(streamed.status, 0) << streamed.err;
  EXPECT_EQ(streamed.out, read_text(stl));
  const Ran text = claystack("export --ascii " + pot + " -");
  EXPECT_TRUE(text.out.starts_with("solid ")) << text.out.substr(0, 100);
  for (const char* with : {" - --json", " - --certificate", " - -"}) {
    const Ran refused = claystack("export " + pot + with);
    EXPECT_EQ(refused.status, 2) << with;
    EXPECT_NE(refused.err.find("claystack: -: expected "), std::string::npos) << refused.err;
  }
}

TEST_F(ExportOptions, TakesFilesWithoutAndWithTheirOption) {
  const std::string obj = folder.file("bowl.obj"), ply = folder.file("bowl.ply");
  ASSERT_EQ(run("").status, 0);
  const std::string expected = read_text(stl);
  std::filesystem::remove(stl);
  EXPECT_EQ(claystack("export -o " + stl + ' ' + pot + ' ' + obj + " --output " + ply).status, 0);
  EXPECT_EQ(read_text(stl), expected);
  EXPECT_TRUE(std::filesystem::exists(obj));
  EXPECT_TRUE(std::filesystem::exists(ply));
  const Ran none = claystack("export " + pot);
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("expected a file to write, such as pot.3mf, found none"),
            std::string::npos)
      << none.err;
}

TEST_F(ExportOptions, WarnsOfLargeFilesBeforeTheyAreWritten) {
  EXPECT_EQ(run("").err, "");
  const Ran large = run("--smooth none --segments 600");
  EXPECT_EQ(large.status, 0);
  const auto size = static_cast<double>(std::filesystem::file_size(stl));
  ASSERT_GT(size, 50e6);
  const std::string megabytes = std::to_string(std::lround(1e-6 * size));
  EXPECT_NE(large.err.find(stl + ": about " + megabytes + " MB, "), std::string::npos) << large.err;
  EXPECT_NE(large.err.find("--smooth fair or --max-triangles makes it smaller"), std::string::npos);
}

}  // namespace
}  // namespace clay::test
