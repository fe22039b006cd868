// Options of `claystack export` that change the size: shrinkage, goals, fill line.

#include "claystack/engine/files.hpp"
#include "tests/app/cli/thrown_bowl.hpp"

#include <gtest/gtest.h>
#include <filesystem>
#include <string>
#include <vector>

namespace clay::test {
namespace {

class ExportSize : public ExportedBowl {};

TEST_F(ExportSize, AShrinkageMakesTheFilesLarger) {
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
  // The size in the file itself, by a program of another vendor.
  const std::string info = shell("prusa-slicer --info " + stl).out;
  const auto size_z = info.find("size_z = ");
  ASSERT_NE(size_z, std::string::npos) << info;
  EXPECT_NEAR(std::stod(info.substr(size_z + 9)), larger.at("height_mm").get<double>(), 1e-3);
  EXPECT_EQ(claystack("check " + stl).status, 0);
  EXPECT_NE(claystack("export " + pot + " " + stl + " --shrinkage 12%").out.find(" fired"),
            std::string::npos);
}

TEST_F(ExportSize, AShrinkageIsAPercentage) {
  for (const char* bad : {"0.12", "12", "60%", "-1%", "x%", "%"})
    EXPECT_EQ(run(std::string("--shrinkage ") + bad).status, 2) << bad;
  EXPECT_EQ(run("--shrinkage 7.5%").status, 0);
  const Ran alone =
      claystack("export " + pot + " " + folder.file("copy.pot.json") + " --shrinkage 12%");
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.err.find("--shrinkage: expected a mesh"), std::string::npos) << alone.err;
}

TEST_F(ExportSize, RefusesFiguresOfFiringWithoutAShrinkage) {
  // The second of each pair is the default without the option.
  for (const std::string option :
       {"--water 15%", "--water 20%", "--ignition-loss 5%", "--ignition-loss 9%",
        "--drying-shrinkage 4%", "--drying-shrinkage 0%"}) {
    const Ran alone = run(option);
    EXPECT_EQ(alone.status, 2);
    EXPECT_NE(alone.err.find(option.substr(0, option.find(' ')) + ": expected --shrinkage too"),
              std::string::npos)
        << alone.err;
    EXPECT_FALSE(std::filesystem::exists(stl));
  }
  EXPECT_EQ(run("--shrinkage 8% --water 15% --ignition-loss 5% --drying-shrinkage 4%").status, 0);
}

TEST_F(ExportSize, StatesOneFiredSize) {
  for (const std::string facets : {"", " --segments 3"}) {
    const auto json = run("--json --shrinkage 10%" + facets).json();
    const auto& fired = json.at("maker").at("fired");
    EXPECT_NEAR(json.at("shrinkage").at("fired_diameter_mm").get<double>(),
                fired.at("diameter_mm").get<double>(), 1e-9);
    EXPECT_NEAR(json.at("shrinkage").at("fired_height_mm").get<double>(),
                fired.at("height_mm").get<double>(), 1e-9);
  }
}

/// The goal is met by the solid that these options would make.
TEST_F(ExportSize, GoalOfACopyDependsOnTheOptionsOfTheSolid) {
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

TEST_F(ExportSize, SaysThatAFillLineIsBelowTheFloor) {
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

// A solid cylinder: pi 0.2^2 0.3 mm3 = 3.8e-5 cm3, 1.9 g/cm3; pi 0.4 0.3 + pi 0.2^2 mm2 outside.
TEST(SmallPot, HasASizeAndAWeight) {
  const ScratchFolder folder;
  const std::string file = folder.file("bead.pot.json");
  Pot bead;
  bead.stack = ClayStack::cylinder(30, 0.01, 0.2, 0.0, 30).value();
  bead.ledger.initial = bead.stack.volume();
  bead.density_g_cm3 = 1.9;
  write_text(file, write_pot(bead, PotEncoding::json));
  const Ran run =
      claystack("export " + file + " " + folder.file("bead.stl") + " --tolerance 0.001");
  for (const char* row : {"size      0.4 mm wide, 0.3 mm high\n", "weight    7.2e-05 g\n",
                          "surface   0 cm2 inside, 0.005 cm2 outside without the foot\n"})
    EXPECT_NE(run.out.find(row), std::string::npos) << run.out << run.err;
  const std::string mesh = folder.file("bead.stl");
  const Ran checked = claystack("check --process fdm " + mesh);
  EXPECT_NE(checked.out.find(": 0.4 x 0.4 x 0.3 mm"), std::string::npos) << checked.out;
  const Ran made = claystack("import " + mesh + " -o " + folder.file("again.pot.json"));
  EXPECT_NE(made.out.find(" 0.3 mm high, 3.8e-05 cm3 of clay (3.8e-05 cm3 in the mesh)\n"),
            std::string::npos)
      << made.out << made.err;
}

TEST_F(ExportSize, NamesTheOptionsOfGoalsThatContradict) {
  const Ran run = claystack("export " + pot + " " + folder.file("b.stl") +
                            " --height 12cm --holds 300ml --diameter 10cm");
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(
      run.err.starts_with("claystack: --holds, --height, --diameter: expected one figure, "))
      << run.err;
}

}  // namespace
}  // namespace clay::test
