#include "tests/support/run_program.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace clay::test {
namespace {

#ifdef CLAYSTACK_FALCON
TEST(Throw, RefusesOptionsOfADeviceWithoutOne) {
  const ScratchFolder folder;
  const std::string begin =
      "throw " + sample("bowl.scene.json") + " -o " + folder.file("a.pot.json");
  for (const std::string& option :
       {"--record " + folder.file("a.session"), std::string("--seconds 3"),
        std::string("--rate 500"), std::string("--force-limit 1"), std::string("--wait")}) {
    const auto run = claystack(begin + " " + option);
    EXPECT_EQ(run.status, 2) << option;
    EXPECT_NE(run.err.find(option.substr(0, option.find(' ')) + ": expected --device"),
              std::string::npos)
        << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
}
#endif

TEST(Throw, NamesTheSessionThatIsMissingBesideItsScene) {
  const ScratchFolder folder;
  const std::string scene = folder.file("one.scene.json");
  write_text(scene, read_text(sample("bowl.scene.json")));
  const Ran run = claystack("throw " + scene);
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "claystack: " + folder.file("one.session") + ": expected the session of " +
                         scene + " beside it, found none; -s NAME.session plays another one\n");
  EXPECT_NE(claystack("throw none.scene.json").err.find("none.scene.json: could not open"),
            std::string::npos);
}

TEST(Throw, FindsTheSessionBesideASceneInCapitals) {
  const ScratchFolder folder;
  write_text(folder.file("One.Scene.JSON"), read_text(sample("bowl.scene.json")));
  write_text(folder.file("One.session"), read_text(sample("bowl.session")));
  const Ran run = claystack("throw " + folder.file("One.Scene.JSON"));
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(Throw, RefusesAListOfAPot) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  const auto run = claystack("throw --from " + pot + " --list");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("found no file, only --from"), std::string::npos) << run.err;
#ifdef CLAYSTACK_FALCON
  // The simulated hand would have no stroke, and no end.
  const auto live = claystack("throw --from " + pot + " --device simulated");
  EXPECT_EQ(live.status, 2);
  EXPECT_NE(live.err.find("expected a session for its hand"), std::string::npos) << live.err;
#endif
}

/// The strokes of a bowl on the clay of a vase push the wall far outward at its foot.
TEST(Throw, AThinWallThatYieldsStaysInOnePiece) {
  const auto json =
      claystack("throw --json " + sample("vase.scene.json") + " -s " + sample("bowl.session"))
          .json();
  EXPECT_EQ(json.at("pieces"), 1u);
  EXPECT_EQ(json.at("volume_error_quanta"), 0);
}

/// The same, where a press moves no wall, and the tool goes through a wall at its minimum.
std::string torn_throw(const ScratchFolder& folder, bool falls) {
  auto scene = nlohmann::json::parse(read_text(sample("vase.scene.json")));
  scene["clay"].erase("thin_wall");
  for (const char* rule : {"shift", "heave", "smear"}) scene["clay"][rule] = "off";
  scene.erase("stability");
  if (falls) scene["stability"] = {{"max_stress_kpa", 1000.0}};
  write_text(folder.file("vase.scene.json"), scene.dump());
  return "throw " + folder.file("vase.scene.json") + " -s " + sample("bowl.session");
}

TEST(Throw, APotCutInTwoFalls) {
  const ScratchFolder folder;
  const std::string cut = torn_throw(folder, true), pot = folder.file("cut.pot.json");
  const auto run = claystack(cut + " -o " + pot);
  EXPECT_EQ(run.status, 0) << run.err;
  const auto json = claystack(cut + " --json").json();
  ASSERT_EQ(json.at("collapsed"), true);
  const auto& fall = json.at("collapse");
  EXPECT_EQ(fall.at("parted"), true);
  EXPECT_LT(fall.at("stress_kpa"), 1000.0);
  const std::string words =
      fmt::format("the clay at a height of {:.1f} mm (ring {}) no longer touches the clay above it",
                  fall.at("height_mm").get<double>(), fall.at("ring").get<int>());
  EXPECT_NE(run.out.find("collapsed: " + words + "; the part above came to rest, tilted by "),
            std::string::npos)
      << run.out;
  const auto check = claystack("check " + pot);
  EXPECT_EQ(check.status, 1);
  EXPECT_NE(check.out.find(words), std::string::npos) << check.out;
}

TEST(Throw, ReportsThePiecesOfATornPot) {
  const ScratchFolder folder;
  const std::string torn = torn_throw(folder, false);
  const auto run = claystack(torn);
  EXPECT_EQ(run.status, 0) << run.err;
  const auto json = claystack(torn + " --json").json();
  const std::size_t pieces = json.at("pieces");
  ASSERT_GT(pieces, 1u);
  EXPECT_EQ(json.at("parted_at_mm").size(), pieces - 1);
  EXPECT_NE(run.out.find("verdict   in " + std::to_string(pieces) +
                         " pieces that do not touch, parted at "),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("claystack export --pieces writes them"), std::string::npos);
  const std::string pot = folder.file("torn.pot.json");
  ASSERT_EQ(claystack(torn + " -q -o " + pot).status, 0);
  const auto refused = claystack("export " + pot + " " + folder.file("torn.stl"));
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("; use --pieces to export them"), std::string::npos) << refused.err;
  EXPECT_TRUE(run.out.starts_with("size ")) << run.out;  // the table of the pot
}

class Samples : public testing::TestWithParam<const char*> {
 protected:
  std::string scene = sample(std::string(GetParam()) + ".scene.json");
};

TEST_P(Samples, ConservingKeepsEveryQuantum) {
  const auto json = claystack("throw " + scene + " --model conserving --json").json();
  EXPECT_EQ(json.at("volume_error_quanta"), 0);
  EXPECT_EQ(json.at("max_volume_error_percent"), 0.0);
  EXPECT_GE(json.at("ticks"), 10'000);
  EXPECT_LE(json.at("ticks"), 40'000);
  // The lump of the scene, by the formula for a cylinder.
  const auto lump = nlohmann::json::parse(read_text(scene)).at("lump");
  EXPECT_EQ(lump.at("rings"), 200);
  EXPECT_EQ(lump.at("inner_radius_mm"), 0);
  const double radius = lump.at("outer_radius_mm"), h = lump.at("ring_height_mm");
  const double volume = std::numbers::pi * radius * radius * 200.0 * h;
  EXPECT_NEAR((json.at("volume_mm3").get<double>() + json.at("trimmed_mm3").get<double>()) / volume,
              1.0, 1e-12);
  EXPECT_EQ(json.at("collapsed"), GetParam() == std::string("collapse"));
}

TEST_P(Samples, PaperErrorIsBelowItsTopRingAtEveryTick) {
  const ScratchFolder folder;
  const auto run = claystack("throw " + sample(std::string("paper/") + GetParam() + ".scene.json") +
                             " --model paper --json --trace " + folder.file("t.csv"));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  EXPECT_LE(json.at("volume_error_quanta"), 0);
  EXPECT_LT(json.at("max_missing_over_top_ring"), 1.0);
  EXPECT_GT(json.at("max_volume_error_percent"), 0.0);
  const std::string plot = folder.file("e.svg");
  const auto named =
      claystack("throw " + sample(std::string("paper/") + GetParam() + ".scene.json") +
                " --error-plot " + plot);
  EXPECT_NE(named.out.find("error plot: " + plot), std::string::npos) << named.out;
  // The same from the trace, tick by tick.
  std::istringstream lines(read_text(folder.file("t.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time_s,volume_error_percent,top_ring_percent,height_mm,force_n");
  std::size_t ticks = 0;
  for (; std::getline(lines, line); ++ticks) {
    double time = 0, error = 0, top = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &error, &top), 3);
    EXPECT_LE(error, 0.0);
    EXPECT_LT(-error, top);
  }
  EXPECT_EQ(ticks, json.at("ticks"));
}

TEST_P(Samples, ReplaysToTheSameBytes) {
  const ScratchFolder folder;
  for (const char* pot : {"a.pot.json", "b.pot.json"})
    ASSERT_EQ(claystack("throw -q " + scene + " -o " + folder.file(pot)).status, 0);
  EXPECT_EQ(read_text(folder.file("a.pot.json")), read_text(folder.file("b.pot.json")));
  EXPECT_FALSE(read_text(folder.file("a.pot.json")).empty());
}

INSTANTIATE_TEST_SUITE_P(Throw, Samples,
                         testing::Values("bowl", "vase", "bottle", "cylinder", "collapse"));

TEST(Throw, ReportsACollapse) {
  const auto run = claystack("throw " + sample("collapse.scene.json"));
  EXPECT_EQ(run.status, 0);
  const auto json = claystack("throw --json " + sample("collapse.scene.json")).json();
  const auto& fall = json.at("collapse");
  const std::string words =
      fmt::format("collapsed: the clay at a height of {:.1f} mm (ring {}) carried ",
                  fall.at("height_mm").get<double>(), fall.at("ring").get<int>());
  EXPECT_NE(run.out.find(words), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(", more than the limit of 3.300 kPa;"), std::string::npos) << run.out;
  EXPECT_EQ(fall.at("threshold_kpa"),
            nlohmann::json::parse(read_text(sample("collapse.scene.json")))
                .at("stability")
                .at("max_stress_kpa"));
  EXPECT_GT(fall.at("stress_kpa"), fall.at("threshold_kpa"));
  EXPECT_EQ(fall.at("parted"), false);
  EXPECT_GT(fall.at("angle_deg"), 30.0);
  EXPECT_GT(fall.at("plastic_work_mj"), 0.0);
  EXPECT_GT(fall.at("energy_lost_mj"), fall.at("plastic_work_mj"));
}

/// The stress grows from tick to tick, so a limit just below that of the fall gives the same fall.
TEST(Throw, AStressBarelyAboveItsLimitPrintsDifferently) {
  const ScratchFolder folder;
  auto scene = nlohmann::json::parse(read_text(sample("collapse.scene.json")));
  const auto fall =
      claystack("throw --json " + sample("collapse.scene.json")).json().at("collapse");
  scene["stability"]["max_stress_kpa"] = fall.at("stress_kpa").get<double>() - 1e-6;
  write_text(folder.file("near.scene.json"), scene.dump());
  const std::string near =
      claystack("throw " + folder.file("near.scene.json") + " -s " + sample("collapse.session"))
          .out;
  const auto after = [&](const std::string& mark) {
    const auto at = near.find(mark);
    return at == std::string::npos ? 0.0 : std::stod(near.substr(at + mark.size()));
  };
  EXPECT_GT(after("carried "), after("more than the limit of ")) << near;
  EXPECT_GT(after("more than the limit of "), 0.0) << near;
}

TEST(Throw, APotGoesOnWithoutItsScene) {
  const ScratchFolder folder;
  const std::string scene = sample("bowl.scene.json"), once = folder.file("once.pot.json");
  const std::string session = " -s " + sample("bowl.session");
  ASSERT_EQ(claystack("throw -q " + scene + " -o " + once).status, 0);
  const auto twice = [&](const std::string& given, const char* name) {
    const auto run =
        claystack("throw -q " + given + session + " --from " + once + " -o " + folder.file(name));
    EXPECT_EQ(run.status, 0) << run.err;
    return run.err;
  };
  EXPECT_EQ(twice(scene, "scene.pot.json").find("was thrown with another"), std::string::npos);
  twice("", "alone.pot.json");
  EXPECT_EQ(read_text(folder.file("alone.pot.json")), read_text(folder.file("scene.pot.json")));
  EXPECT_EQ(nlohmann::json::parse(read_text(once)).at("thrown_with").at("flow"),
            nlohmann::json::parse(read_text(scene)).at("flow"));
  // A scene on the command line takes precedence.
  auto other = nlohmann::json::parse(read_text(scene));
  other["flow"]["reach_mm"] = 11;
  write_text(folder.file("other.scene.json"), other.dump());
  EXPECT_NE(twice(folder.file("other.scene.json"), "other.pot.json")
                .find("once.pot.json: was thrown with another tool or clay; the tool and clay of "),
            std::string::npos);
  EXPECT_NE(read_text(folder.file("other.pot.json")), read_text(folder.file("scene.pot.json")));
  const auto none = claystack("throw --from " + once);
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("a pot without a scene: expected --session"), std::string::npos)
      << none.err;
  EXPECT_EQ(claystack("throw").status, 2);
}

TEST(Throw, ReportsThatItWritesNoPotWithoutAName) {
  const auto run = claystack("throw " + sample("cylinder.scene.json"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("\npot: not written; -o NAME.pot.json writes it\n"), std::string::npos)
      << run.out;
}

TEST(Throw, WarnsAboutASessionOfAnotherScene) {
  const auto run =
      claystack("throw " + sample("vase.scene.json") + " --session " + sample("bowl.session"));
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("recorded on another scene (bowl)"), std::string::npos) << run.err;
}

/// The name of a scene does not change the pot, and --model is a choice.
TEST(Throw, KnowsTheSceneOfASessionWhateverItsNameAndTheChosenModel) {
  const ScratchFolder folder;
  auto scene = nlohmann::json::parse(read_text(sample("cylinder.scene.json")));
  const auto warning_of = [&](const std::string& options) {
    write_text(folder.file("a.scene.json"), scene.dump());
    const Ran run = claystack("throw -q " + folder.file("a.scene.json") + " --session " +
                              sample("cylinder.session") + options);
    EXPECT_EQ(run.status, 0);
    return run.err;
  };
  scene["name"] = "mug";
  EXPECT_EQ(warning_of(""), "");
  scene["model"] = "paper";
  const std::string warning = "recorded on another scene (cylinder)";
  EXPECT_NE(warning_of("").find(warning), std::string::npos);
  EXPECT_EQ(warning_of(" --model conserving"), "");
  scene["removal"]["min_wall_mm"] = 2.5;
  EXPECT_NE(warning_of(" --model conserving").find(warning), std::string::npos);
}

TEST(Throw, RefusesAPinchSessionWithoutAGapInTheScene) {
  const ScratchFolder folder;
  const std::string pot = folder.file("p.pot.json"), session = sample("paper/cylinder.session");
  const auto run = claystack("throw " + sample("paper/vase.scene.json") + " --session " + session +
                             " -o " + pot);
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find(session + ": expected one tool throughout, because the scene sets "
                                   "no tool.gap_mm, found a gap of 36 mm at "),
            std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(pot));
}

TEST(Throw, NamesThePotWhereThereIsNoScene) {
  const ScratchFolder folder;
  const std::string drawing = folder.file("a.csv"), pot = folder.file("a.pot.json");
  write_text(drawing, "30,0\n30,60\n");
  ASSERT_EQ(claystack("import -q --ring-height 0.05 " + drawing + " -o " + pot).status, 0);
  const Ran two_tools =
      claystack("throw --from " + pot + " --session " + sample("paper/cylinder.session"));
  EXPECT_EQ(two_tools.status, 2);
  EXPECT_NE(two_tools.err.find("expected one tool throughout, because the pot " + pot +
                               " holds no tool.gap_mm, found a gap of 36 mm"),
            std::string::npos)
      << two_tools.err;
  EXPECT_NE(two_tools.err.find("; name the scene of the session before --from"), std::string::npos);

  // 1200 rings on a wheel for 800. An import of 60 mm in rings of at most 0.15 mm makes 400 to 800.
  const Ran many = claystack("throw " + sample("paper/vase.scene.json") + " --from " + pot);
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("expected 0 or at least the pot's rings, 1200, found "),
            std::string::npos)
      << many.err;
  EXPECT_NE(many.err.find("if the pot was imported, import --ring-height 0.15 makes"),
            std::string::npos)
      << many.err;
}

TEST(Throw, DrawsTheErrorOfBothModels) {
  const ScratchFolder folder;
  const auto run =
      claystack("throw -q " + sample("bowl.scene.json") + " --error-plot " + folder.file("e.svg"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(shell("rsvg-convert " + folder.file("e.svg") + " -o " + folder.file("e.png")).status,
            0);
  const std::string svg = read_text(folder.file("e.svg"));
  EXPECT_NE(svg.find("model paper"), std::string::npos);
  EXPECT_NE(svg.find("model conserving"), std::string::npos);
}

TEST(Throw, RefusesToOverwriteInputsOrRepeatOutputs) {
  const ScratchFolder folder;
  for (const char* end : {".scene.json", ".session"})
    write_text(folder.file("b") + end, read_text(sample(std::string("bowl") + end)));
  const std::string scene = folder.file("b.scene.json"), session = folder.file("b.session");
  const std::string pot = folder.file("b.pot.json");
  for (const std::string& outputs :
       {"--trace " + scene, "--error-plot " + session, "-o " + pot + " --trace " + pot,
        "-o " + pot + " --error-plot " + folder.file("./b.pot.json"), "-o " + folder.file("b.stl"),
        "-o " + scene, std::string("-o - --json"), std::string("-o - --trace -")}) {
    EXPECT_EQ(claystack("throw " + scene + " " + outputs).status, 2) << outputs;
    EXPECT_FALSE(std::filesystem::exists(pot));
  }
  EXPECT_EQ(read_text(scene), read_text(sample("bowl.scene.json")));
  EXPECT_EQ(read_text(session), read_text(sample("bowl.session")));
}

TEST(Throw, PipesIntoExport) {
  const ScratchFolder folder;
  const std::string program = CLAYSTACK_PROGRAM;
  const Ran run = shell(program + " throw " + sample("bowl.scene.json") + " -o - | " + program +
                        " export -q - " + folder.file("piped.stl"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(claystack("check -q " + folder.file("piped.stl")).status, 0);
}

TEST(Throw, RefusesBadInputAndLeavesNoFile) {
  const ScratchFolder folder;
  const std::string pot = folder.file("x.pot.json");
  const auto expect = [&](const std::string& arguments, int status, const std::string& says) {
    const Ran run = claystack("throw " + arguments + " -o " + pot);
    EXPECT_EQ(run.status, status) << arguments;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(pot));
  };
  expect(folder.file("none.scene.json"), 3, "none.scene.json");
  std::string scene = read_text(sample("bowl.scene.json"));
  scene.insert(scene.find("\"rings\""), "\"colour\": 1,\n    ");
  const auto line =
      1 + std::count(scene.begin(),
                     scene.begin() + static_cast<std::ptrdiff_t>(scene.find("colour")), '\n');
  write_text(folder.file("bad.scene.json"), scene);
  write_text(folder.file("bad.session"), "");
  expect(folder.file("bad.scene.json"), 2, "bad.scene.json:" + std::to_string(line) + ":");
  expect(sample("bowl.scene.json") + " -s " + folder.file("bad.session"), 2, "bad.session");
  expect(sample("bowl.scene.json") + " --model clay", 2, "--model");

  std::string session = read_text(sample("bowl.session"));
  const std::size_t line5 = [&] {
    std::size_t at = 0;
    for (int k = 1; k < 5; ++k) at = session.find('\n', at) + 1;
    return at;
  }();
  const std::size_t digit = session.find_first_of("123456789", line5 + 60);
  session[digit] = session[digit] == '9' ? '8' : '9';
  write_text(folder.file("flipped.session"), session);
  expect(sample("bowl.scene.json") + " -s " + folder.file("flipped.session"), 2,
         "flipped.session:5:");
}

}  // namespace
}  // namespace clay::test
