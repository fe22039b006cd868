// Options of `claystack export` for files: facets, proof, formats, standard output.

#include "claystack/engine/files.hpp"
#include "tests/app/cli/thrown_bowl.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace clay::test {
namespace {

class ExportFormats : public ExportedBowl {};

// The polygon of n sides with the area of the circle: its corners stand out by r (f - 1), the
// middles of its sides are r (1 - f cos(pi / n)) inside, where f^2 = (2 pi / n) / sin(2 pi / n).
TEST_F(ExportFormats, TheStatedDistanceIncludesTheFacets) {
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

TEST_F(ExportFormats, TrianglesStayWithinTheBudget) {
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

TEST_F(ExportFormats, FullVerificationChecksTheFileLikeAForeignMesh) {
  const auto json = run("--json --verify full").json();
  EXPECT_TRUE(json.at("files").at(0).at("full_verification").at("sound"));
  EXPECT_EQ(json.at("files").at(0).at("full_verification").at("self_intersections"), 0);
}

TEST_F(ExportFormats, NormalsAreForObj) {
  const std::string obj = folder.file("n.obj");
  ASSERT_EQ(claystack("export -q --normals " + pot + " " + obj).status, 0);
  EXPECT_NE(read_text(obj).find("\nvn "), std::string::npos);
  EXPECT_NE(shell("prusa-slicer --info " + obj).out.find("manifold = yes"), std::string::npos);
  EXPECT_EQ(claystack("check " + obj).status, 0);
}

TEST_F(ExportFormats, APlainGlbNeedsNoExtension) {
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

TEST_F(ExportFormats, AGlbByMeshoptIsCertifiedAsDecoded) {
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

/// The bore of this pot is rough and 1e-6 mm from the outside, so curves cross at any tolerance.
TEST(ExportStep, NamesTheOptionForLinesWhereCurvesCross) {
  std::vector<Ring> rings(4, {quanta_from_radius(20.0), 0});
  for (int i = 0; i < 40; ++i) {
    const double outside = 20.0 + 2.0 * std::sin(0.25 * i);
    const double bore = outside - 1e-6 - 2.0 * std::fmod(0.37 * i * i, 1.0);
    rings.push_back({quanta_from_radius(outside), quanta_from_radius(bore)});
  }
  Pot pot;
  pot.stack = ClayStack::from_rings(0.5, rings, 0, 100).value();
  pot.ledger.initial = pot.stack.volume();
  pot.density_g_cm3 = 1.9;
  const ScratchFolder folder;
  const std::string file = folder.file("rough.pot.json"), step = folder.file("rough.step");
  write_text(file, write_pot(pot, PotEncoding::json));
  const Ran crossing = claystack("export --pieces " + file + " " + step);
  EXPECT_EQ(crossing.status, 1);
  EXPECT_NE(crossing.err.find("mm; --step lines is exact, and a smaller tolerance brings"),
            std::string::npos)
      << crossing.err;
  EXPECT_FALSE(std::filesystem::exists(step));
  EXPECT_EQ(claystack("export -q --pieces --step lines " + file + " " + step).status, 0);
}

TEST_F(ExportFormats, TheWallMapColoursGlbAnd3mfAlone) {
  const std::string glb = folder.file("w.glb"), package = folder.file("w.3mf");
  ASSERT_EQ(claystack("export -q --wall-map " + pot + " " + glb + " " + package).status, 0);
  EXPECT_NE(read_text(glb).find("COLOR_0"), std::string::npos);
  EXPECT_NE(read_text(glb).find("\"wall_map\""), std::string::npos);
  EXPECT_NE(shell("unzip -p " + package + " 3D/3dmodel.model").out.find("<m:colorgroup"),
            std::string::npos);
  EXPECT_EQ(claystack("check " + package).status, 0);
  EXPECT_EQ(run("--wall-map " + folder.file("w.obj")).status, 2);
}

TEST_F(ExportFormats, WallTableContainsTheMinimum) {
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

TEST_F(ExportFormats, DrawingAloneProvesNothing) {
  const auto json = claystack("export --json " + pot + " " + folder.file("b.svg")).json();
  EXPECT_EQ(json.at("files").size(), 1u);
  for (const char* claim : {"certificate", "volume_mm3", "min_wall_mm", "wall_demand"})
    EXPECT_FALSE(json.contains(claim)) << claim;
  const Ran none = claystack("export --certificate " + pot + " " + folder.file("b.svg"));
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("--certificate: expected a mesh"), std::string::npos) << none.err;
}

TEST_F(ExportFormats, ReportsThatPipesCannotBeReadBack) {
  const std::string pipe = folder.file("pipe.stl");
  const Ran run = shell("mkfifo " + pipe + " && cat " + pipe + " > " + stl + " & sleep 0.2; " +
                        CLAYSTACK_PROGRAM " export --json " + pot + " " + pipe + "; wait");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(run.json().at("files").at(0).at("read_back"));
  EXPECT_EQ(std::filesystem::file_size(stl), run.json().at("files").at(0).at("bytes"));
}

TEST_F(ExportFormats, WritesABinaryStlToStandardOutput) {
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

TEST_F(ExportFormats, JsonReplacesInvalidUtf8InNames) {
  const std::string odd = folder.file("\xff.stl");
  ASSERT_EQ(claystack("export -q " + pot + " " + odd).status, 0);
  const Ran check = claystack("check --json " + odd);
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_TRUE(check.json().at("sound"));
}

}  // namespace
}  // namespace clay::test
