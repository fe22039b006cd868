#include "tests/app/cli/thrown_bowl.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <regex>

namespace clay::test {
namespace {

/// Volume [mm^3] of a binary STL by the divergence theorem in double: independent of the reader of
/// Claystack.
double stl_volume(const std::string& bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    float v[9];
    std::memcpy(v, bytes.data() + 84 + 50 * k + 12, 36);
    sum += double(v[0]) * (double(v[4]) * v[8] - double(v[5]) * v[7]) -
           double(v[1]) * (double(v[3]) * v[8] - double(v[5]) * v[6]) +
           double(v[2]) * (double(v[3]) * v[7] - double(v[4]) * v[6]);
  }
  return sum / 6.0;
}

double number_after(const std::string& text, const std::string& label) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(label + R"(\s*[:=]\s*([-+0-9.eE]+))")))
    return std::nan("");
  return std::stod(match[1]);
}

/// File names on Linux are bytes; formats are UTF-8.
TEST(Export, ANameThatIsNotUtf8FitsIntoEveryFormat) {
  const ScratchFolder folder;
  const std::string pot = folder.file(
      "Sch\xFC"
      "ssel.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  std::string files;
  for (const char* name : {"a.3mf", "a.glb", "a.pdf", "a.svg", "a.stl", "a.step"})
    files += ' ' + folder.file(name);
  const Ran ran = claystack("export " + pot + files);
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(claystack("check " + folder.file("a.3mf")).status, 0);
}

class ExportedSample : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string scene = sample(std::string(GetParam()) + ".scene.json");
    thrown = claystack("throw " + scene + " --json -o " + folder.file("p.pot.json"));
    ASSERT_EQ(thrown.status, 0) << thrown.err;
    exported = claystack("export --json " + folder.file("p.pot.json") + " " + stl + " " + obj +
                         " " + drc + " " + ply + " " + three_mf + " " + glb);
    ASSERT_EQ(exported.status, 0) << exported.err;
    counted = thrown.json().at("volume_mm3");
  }
  ScratchFolder folder;
  std::string stl = folder.file("p.stl"), obj = folder.file("p.obj"), drc = folder.file("p.drc"),
              ply = folder.file("p.ply"), three_mf = folder.file("p.3mf"),
              glb = folder.file("p.glb");
  Ran thrown, exported;
  double counted = 0.0;
};

TEST_P(ExportedSample, ReportsWhatItDid) {
  const auto json = exported.json();
  EXPECT_LT(json.at("volume_error_relative"), 1e-9);
  EXPECT_GT(json.at("min_wall_mm"), 0.0);
  EXPECT_GT(json.at("certificate").at("vertices"), 50);
  ASSERT_EQ(json.at("files").size(), 6u);
  for (const auto& file : json.at("files")) {
    EXPECT_EQ(std::filesystem::file_size(file.at("path").get<std::string>()), file.at("bytes"));
    EXPECT_LE(file.at("max_error_mm"), 0.02);
    EXPECT_EQ(file.at("proof"), "margins");
    EXPECT_TRUE(file.at("read_back"));
  }
  EXPECT_FALSE(json.at("left_out").empty());
  EXPECT_FALSE(json.at("stages").empty());
}

TEST_P(ExportedSample, StlHoldsTheCountedClay) {
  const std::string bytes = read_text(stl);
  ASSERT_EQ(bytes.size(), 84 + 50 * exported.json().at("triangles").get<std::size_t>());
  EXPECT_NEAR(stl_volume(bytes) / counted, 1.0, 1e-6);
}

TEST_P(ExportedSample, AdmeshFindsNothingToRepair) {
  const Ran run = shell("admesh --exact " + stl);
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* fault : {"Total disconnected facets", "Degenerate facets", "Edges fixed",
                            "Facets removed", "Facets added", "Facets reversed", "Backwards edges"})
    EXPECT_EQ(number_after(run.out, fault), 0.0) << fault << "\n" << run.out;
  EXPECT_NEAR(number_after(run.out, "Volume") / counted, 1.0, 1e-5) << run.out;
}

TEST_P(ExportedSample, PrusaSlicerFindsAManifold) {
  for (const std::string& file : {stl, obj, three_mf}) {
    const Ran run = shell("prusa-slicer --info " + file);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("manifold = yes"), std::string::npos) << run.out;
    for (const char* fault :
         {"open_edges", "edges_fixed", "facets_removed", "facets_reversed", "backwards_edges"})
      EXPECT_EQ(run.out.find(fault), std::string::npos) << run.out;
    EXPECT_NEAR(number_after(run.out, "volume") / counted, 1.0, 1e-5) << run.out;
  }
}

TEST_P(ExportedSample, DracoDecoderReturnsAClosedMesh) {
  const std::string decoded = folder.file("decoded.obj");
  ASSERT_EQ(shell("draco_decoder -i " + drc + " -o " + decoded).status, 0);
  const auto json = claystack("check --json " + decoded).json();
  EXPECT_TRUE(json.at("closed"));
  EXPECT_TRUE(json.at("manifold"));
  EXPECT_EQ(json.at("triangles"), exported.json().at("triangles"));
  EXPECT_NEAR(json.at("volume_mm3").get<double>() / counted, 1.0, 1e-3);
}

TEST_P(ExportedSample, PassesItsOwnCheckInEveryFormat) {
  for (const std::string& file : {stl, obj, drc, ply, three_mf, glb, folder.file("p.pot.json")}) {
    const Ran run = claystack("check --json " + file);
    EXPECT_EQ(run.status, 0) << file << run.out;
    const auto json = run.json();
    for (const char* key : {"sound", "closed", "manifold", "oriented", "bounds_volume"})
      EXPECT_TRUE(json.at(key)) << file << key;
    EXPECT_EQ(json.at("self_intersections"), 0) << file;
    EXPECT_EQ(json.at("components"), 1) << file;
  }
}

TEST(ExportCylinder, CertifiesWallOfAboutTheGap) {
  const ScratchFolder folder;
  const std::string pot = folder.file("c.pot.json"), stl = folder.file("c.stl");
  const std::string thinnest = " --min-wall 3.6 ";  // the gap of 4 mm less 10 %
  ASSERT_EQ(claystack("throw -q " + sample("paper/cylinder.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q" + thinnest + "--certificate " + pot + " " + stl).status, 0);
  EXPECT_EQ(claystack("check -q" + thinnest + pot).status, 0);
  EXPECT_EQ(claystack("check -q" + thinnest + stl).status, 0);
  EXPECT_EQ(claystack("check -q --certificate " + stl + ".certificate.json " + stl).status, 0);
  EXPECT_EQ(claystack("check -q --min-wall 4.4 " + pot).status, 1);
}

INSTANTIATE_TEST_SUITE_P(Export, ExportedSample,
                         testing::Values("bowl", "vase", "bottle", "cylinder"));

class ExportBowl : public ThrownBowl {};

TEST_F(ExportBowl, AsciiStlHoldsTheSameTriangles) {
  ASSERT_EQ(claystack("export -q " + pot + " " + folder.file("b.stl")).status, 0);
  ASSERT_EQ(claystack("export -q --ascii " + pot + " " + folder.file("a.stl")).status, 0);
  EXPECT_EQ(read_text(folder.file("a.stl")).rfind("solid ", 0), 0u);
  const auto binary = claystack("check --json " + folder.file("b.stl")).json();
  const auto ascii = claystack("check --json " + folder.file("a.stl")).json();
  EXPECT_EQ(binary.at("volume_mm3"), ascii.at("volume_mm3"));
  EXPECT_EQ(binary.at("triangles"), ascii.at("triangles"));
}

TEST_F(ExportBowl, TheSamePotGivesTheSameBytes) {
  for (const char* name : {"a", "b"})
    ASSERT_EQ(claystack("export -q " + pot + " " + folder.file(std::string(name) + ".stl") + " " +
                        folder.file(std::string(name) + ".drc"))
                  .status,
              0);
  EXPECT_EQ(read_text(folder.file("a.stl")), read_text(folder.file("b.stl")));
  EXPECT_EQ(read_text(folder.file("a.drc")), read_text(folder.file("b.drc")));
}

TEST_F(ExportBowl, CompactPotGivesTheSameStl) {
  ASSERT_EQ(
      claystack("throw -q " + sample("bowl.scene.json") + " -o " + folder.file("bowl.pot.cbor"))
          .status,
      0);
  ASSERT_EQ(claystack("export -q " + pot + " " + folder.file("json.stl")).status, 0);
  ASSERT_EQ(
      claystack("export -q " + folder.file("bowl.pot.cbor") + " " + folder.file("cbor.stl")).status,
      0);
  EXPECT_EQ(read_text(folder.file("json.stl")), read_text(folder.file("cbor.stl")));
}

TEST_F(ExportBowl, SegmentsCanBeForced) {
  const auto few =
      claystack("export --json --segments 16 " + pot + " " + folder.file("f.stl")).json();
  EXPECT_EQ(few.at("segments"), 16);
  EXPECT_LT(few.at("volume_error_relative"), 1e-9);
}

TEST_F(ExportBowl, RefusesAndWritesNothing) {
  const auto expect = [&](const std::string& arguments, int status, const std::string& says) {
    const Ran run = claystack("export " + arguments);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  };
  expect(pot + " " + folder.file("x.stl") + " " + folder.file("x.off"), 2, "x.off");
  expect(pot + " " + folder.file("x.stl") + " " + folder.file("./x.stl"), 2,
         "./x.stl: expected a separate output file");
  expect(pot + " " + folder.file("x.stl") + " " + pot, 2,
         "bowl.pot.json: expected a separate output file");
  expect(folder.file("none.pot.json") + " " + folder.file("x.stl"), 3, "none.pot.json");
  expect(sample("bowl.scene.json") + " " + folder.file("x.stl"), 2, "bowl.scene.json");
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.stl")));
}

TEST_F(ExportBowl, AFullDiskLeavesTheOldFile) {
  const std::string stl = folder.file("old.stl");
  write_text(stl, "the old file");
  // 100 blocks of 512 bytes: the file cannot grow to its size.
  const Ran run =
      shell("trap \"\" XFSZ; ulimit -f 100; " CLAYSTACK_PROGRAM " export -q " + pot + " " + stl);
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_EQ(read_text(stl), "the old file");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

class ExportCollapsed : public testing::Test {
 protected:
  void SetUp() override {
    const Ran thrown =
        claystack("throw --json " + sample("paper/collapse.scene.json") + " -o " + pot);
    ASSERT_EQ(thrown.status, 0) << thrown.err;
    counted = thrown.json().at("volume_mm3");
    collapse = thrown.json().at("collapse");
  }
  ScratchFolder folder;
  std::string pot = folder.file("c.pot.json"), stl = folder.file("c.stl");
  double counted = 0.0;
  nlohmann::json collapse;
};

TEST_F(ExportCollapsed, StatesTheCollapseAndTheThinnestWallBeforeTheFall) {
  const Ran run = claystack("export " + pot + " " + stl);
  EXPECT_NE(run.out.find("mm before the fall"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("verdict   collapsed; closed and without self-intersections\n"),
            std::string::npos)
      << run.out;
}

TEST_F(ExportCollapsed, IsOneSoundFileThatHoldsTheUnion) {
  const std::string drc = folder.file("c.drc");
  const Ran run = claystack("export --json " + pot + " " + stl + " " + drc);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  const auto& fall = json.at("collapsed");
  const double both = fall.at("lower_mm3").get<double>() + fall.at("upper_mm3").get<double>();
  const double whole = fall.at("union_mm3"), overlap = fall.at("overlap_mm3");
  EXPECT_EQ(json.at("counted_volume_mm3"), counted);
  EXPECT_NEAR(both / counted, 1.0, 1e-9);
  EXPECT_NEAR((both - overlap) / whole, 1.0, 1e-9);
  // Clay pressed into clay: 1 kPa mm3 is a thousandth of a mJ, and the fall paid for all of it.
  const double pressed_mj = 1e-3 * collapse.at("threshold_kpa").get<double>() * overlap;
  EXPECT_GT(overlap, 0.01 * counted);
  EXPECT_LE(pressed_mj, collapse.at("plastic_work_mj"));
  EXPECT_LE(collapse.at("plastic_work_mj"), collapse.at("energy_lost_mj"));
  EXPECT_EQ(fall.at("pieces"), 1);
  EXPECT_LE(fall.at("max_move_mm"), 0.02);
  for (const auto& file : json.at("files")) EXPECT_EQ(file.at("proof"), "exact_test");

  EXPECT_NEAR(stl_volume(read_text(stl)) / whole, 1.0, 1e-6);
  for (const std::string& file : {stl, drc}) {
    const auto check = claystack("check --json " + file).json();
    for (const char* key : {"sound", "closed", "manifold", "oriented", "bounds_volume"})
      EXPECT_TRUE(check.at(key)) << file << key;
    EXPECT_EQ(check.at("self_intersections"), 0) << file;
  }
  const Ran admesh = shell("admesh --exact " + stl);
  for (const char* fault : {"Total disconnected facets", "Degenerate facets", "Edges fixed",
                            "Facets removed", "Facets added", "Facets reversed", "Backwards edges"})
    EXPECT_EQ(number_after(admesh.out, fault), 0.0) << fault << "\n" << admesh.out;
  EXPECT_NEAR(number_after(admesh.out, "Volume") / whole, 1.0, 1e-4) << admesh.out;
  const Ran prusa = shell("prusa-slicer --info " + stl);
  EXPECT_NE(prusa.out.find("manifold = yes"), std::string::npos) << prusa.out;
  for (const char* fault :
       {"open_edges", "edges_fixed", "facets_removed", "facets_reversed", "backwards_edges"})
    EXPECT_EQ(prusa.out.find(fault), std::string::npos) << prusa.out;
}

TEST_F(ExportCollapsed, ReportsTheVolumesAndIsDeterministic) {
  const Ran run = claystack("export " + pot + " " + stl);
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* words : {"overlap by", "cm3 fallen"})
    EXPECT_NE((run.out + run.err).find(words), std::string::npos) << words << run.out << run.err;
  ASSERT_EQ(claystack("export -q " + pot + " " + folder.file("again.stl")).status, 0);
  EXPECT_EQ(read_text(stl), read_text(folder.file("again.stl")));
}

TEST_F(ExportCollapsed, HasSizeAndWeightButNoCapacity) {
  const std::string page = folder.file("c.html");
  const Ran made = claystack("export --json --report " + page + " " + pot + " " + stl);
  const auto json = made.json();
  const auto &maker = json.at("maker"), &thrown = maker.at("thrown");
  // The weight is that of all clay, also where both parts overlap.
  EXPECT_NEAR(thrown.at("weight_g"),
              1e-3 * counted * maker.at("clay").at("density_g_cm3").get<double>(), 1e-6);
  EXPECT_EQ(thrown.at("diameter_mm"), json.at("diameter_mm"));
  EXPECT_EQ(thrown.at("height_mm"), json.at("height_mm"));
  for (const char* none : {"foot_diameter_mm", "capacity_ml", "to_line_ml"})
    EXPECT_TRUE(thrown.at(none).is_null()) << none;
  EXPECT_TRUE(maker.at("empty").is_null() && maker.at("full").is_null());
  EXPECT_NE(read_text(page).find("weight"), std::string::npos);
  EXPECT_NE(read_text(page).find("The pot collapsed."), std::string::npos);
  EXPECT_EQ(read_text(page).find("capacity to the brim"), std::string::npos);
  // The tables of both commands.
  for (const Ran& run : {claystack("export " + pot + " " + stl),
                         claystack("throw " + sample("paper/collapse.scene.json"))})
    for (const char* words : {"\nsize      ", " mm high\nweight    ",
                              " g\ncapacity  none: the pot "
                              "collapsed\n"})
      EXPECT_NE(run.out.find(words), std::string::npos) << words << run.out;
}

TEST_F(ExportCollapsed, WarnsAboutTrappedAir) {
  // Turned all the way down through the standing part, as a file from before falls were settled has
  // it.
  auto file = nlohmann::json::parse(read_text(pot));
  for (const char* name : {"shift_mm", "threshold_kpa", "energy_lost_mj", "plastic_work_mj"})
    file["collapse"].erase(name);
  file["collapse"]["angle_rad"] = 1.3757945555628626;
  write_text(pot, file.dump());
  const Ran run = claystack("export " + pot + " " + stl);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("drain holes"), std::string::npos) << run.out << run.err;
}

TEST_F(ExportCollapsed, IsDrawn) {
  EXPECT_EQ(claystack("export -q " + pot + " " + folder.file("c.svg")).status, 0);
  EXPECT_EQ(shell("rsvg-convert " + folder.file("c.svg") + " -o " + folder.file("c.png")).status,
            0);
}

}  // namespace
}  // namespace clay::test
