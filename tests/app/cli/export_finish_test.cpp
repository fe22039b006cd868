// Options of `claystack export` that change the surface: fairing, fillets, foot, glaze, drain.

#include "tests/app/cli/thrown_bowl.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>

namespace clay::test {
namespace {

class ExportFinish : public ExportedBowl {};

TEST_F(ExportFinish, ReportsTheFairing) {
  EXPECT_EQ(run("--json").json().at("fairing").at("length_mm"), 10.0);  // from the tool of the bowl
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

TEST_F(ExportFinish, ReportsALipFilletAndExactWalls) {
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

TEST_F(ExportFinish, WarnsOfALipFilletThatIsSmallerThanAskedFor) {
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
  EXPECT_NE(process.err.find(begin.str() + " for Stoneware: "), std::string::npos) << process.err;
  const auto problems = run("--json --lip-fillet 2").json().at("problems");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].at("text").get<std::string>().find("lip fillet of "), 0u);
  EXPECT_EQ(problems[0].at("fails"), false);
  for (const char* fits : {"", "--lip-fillet 1", "--process stoneware --lip-fillet 1mm"})
    EXPECT_EQ(run(fits).err.find("lip fillet"), std::string::npos) << fits;
}

TEST_F(ExportFinish, TheJsonStatesWhetherAllLimitsPass) {
  EXPECT_EQ(run("--json --min-wall 0.5").json().at("passes"), true);
  EXPECT_EQ(run("--json --lip-fillet 2").json().at("passes"), true) << "a warning";
  const Ran thin = run("--json --min-wall 50");
  EXPECT_EQ(thin.status, 1);
  EXPECT_EQ(thin.json().at("passes"), false);
}

TEST_F(ExportFinish, TheJsonOfARefusalStatesThatNothingIsWritten) {
  const Ran refused = run("--json --glaze-allowance 9");
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(violation(load_schema("error"), refused.json()), "");
  EXPECT_EQ(refused.json().at("kind"), "unsound");
  EXPECT_EQ(refused.json().at("written"), nlohmann::json::array());
}

TEST_F(ExportFinish, AFilletWithoutSmoothingIsRefused) {
  const Ran run_none = run("--lip-fillet 1 --smooth none");
  EXPECT_EQ(run_none.status, 2);
  EXPECT_NE(run_none.err.find("--lip-fillet: expected --smooth fair, found none"),
            std::string::npos)
      << run_none.err;
}

TEST_F(ExportFinish, AClayProcessRoundsTheLip) {
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

TEST_F(ExportFinish, ReportsTheClayThatFinishingTrims) {
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
  // The limit and what was found are printed apart, also where they differ by little.
  const std::string begin = "expected a depth below ", found = "thickness of the floor, found ";
  const auto number_after = [](const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == text.npos
               ? std::string()
               : text.substr(at + words.size(), text.find(" mm", at) - at - words.size());
  };
  const double floor_mm = std::stod(number_after(run("--foot 44x5x30").err, begin));
  int refused = 0;
  for (const int i : {-4, -3, -2, -1, 1, 2, 3, 4}) {
    const Ran near = run("--foot 44x5x" + std::to_string(floor_mm + 0.001 * i));
    if (near.err.find(begin) == std::string::npos) continue;
    ++refused;
    EXPECT_NE(number_after(near.err, begin), number_after(near.err, found)) << near.err;
  }
  EXPECT_GT(refused, 0);
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

/// Smaller parts than float32 separates, and set-backs within the tolerance.
TEST_F(ExportFinish, RefusesPartsThatAreTooSmall) {
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
  EXPECT_NE(coarse.err.find("glaze allowance: expected 0, or 0.02 to 10 mm, found 0.01 mm"),
            std::string::npos)
      << coarse.err;
}

/// The coarsest section of this bowl has thin walls, so that the glaze would break its limit.
TEST_F(ExportFinish, ALimitOfTrianglesLeavesOutDesignsThatAreTooCoarse) {
  const Ran both = run("--json --glaze-allowance 0.5 --min-wall 3 --max-triangles 30000");
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_LE(both.json().at("triangles"), 30000u);
  EXPECT_GE(both.json().at("min_wall_mm"), 3.0);
}

/// Also for a drawing alone.
TEST(ExportFallenPot, RefusesWhatNeedsAStandingPot) {
  const ScratchFolder folder;
  const std::string pot = folder.file("fallen.pot.json"), svg = folder.file("fallen.svg");
  ASSERT_EQ(claystack("throw -q " + sample("collapse.scene.json") + " -o " + pot).status, 0);
  for (const auto& [option, name] :
       {std::pair("--foot 60x6x4", "foot ring"), std::pair("--floor-fillet 5", "floor fillet"),
        std::pair("--glaze-allowance 0.5", "glaze allowance"),
        std::pair("--lip-fillet 2", "lip fillet"),
        std::pair("--smooth-length 5mm", "smooth length")}) {
    const Ran refused = claystack("export " + pot + " " + svg + " " + option);
    EXPECT_EQ(refused.status, 2) << option << refused.err;
    EXPECT_NE(refused.err.find(std::string(name) + ": expected a standing pot, found a collapsed"),
              std::string::npos)
        << refused.err;
  }
  EXPECT_EQ(claystack("export -q " + pot + " " + svg).status, 0);
  for (const std::string option :
       {"--tolerance 0.1", "--smooth exact", "--pieces", "--measure-left-out"}) {
    const Ran refused = claystack("export " + pot + " " + svg + " " + option);
    EXPECT_EQ(refused.status, 2) << option << refused.err;
    EXPECT_NE(refused.err.find(option.substr(0, option.find(' ')) +
                               ": expected a mesh among the files to write"),
              std::string::npos)
        << refused.err;
  }
  // On a mesh they have an effect.
  const Ran both = claystack("export -q " + pot + " " + folder.file("fallen.stl") +
                             " --tolerance 1 --smooth none --measure-left-out");
  EXPECT_EQ(both.status, 0) << both.err;
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

}  // namespace
}  // namespace clay::test
