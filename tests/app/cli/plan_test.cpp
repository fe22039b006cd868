#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace clay::test {
namespace {

std::set<std::string> stages(const nlohmann::json& plan, const char* part) {
  std::set<std::string> names;
  for (const auto& line : plan.at(part)) names.insert(line.at("stage").get<std::string>());
  return names;
}

constexpr const char* kSolidFrictionless = R"({
  "schema": "claystack-scene-1",
  "lump": {"rings": 200, "ring_height_mm": 0.5, "outer_radius_mm": 40},
  "tool": {"shape": {"sphere": {"radius_mm": 10}}},
  "force": {"stiffness_n_per_mm2": 0.02}
})";

TEST(Plan, LeavesOutUnneededStages) {
  const ScratchFolder folder;
  write_text(folder.file("s.scene.json"), kSolidFrictionless);
  const auto run = claystack("plan --json " + folder.file("s.scene.json"));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto plan = run.json();
  EXPECT_EQ(stages(plan, "left_out"),
            (std::set<std::string>{"inner surface", "friction", "stability", "pinch", "lift",
                                   "shift", "rim", "hoop", "heave", "smear", "finger", "thin wall",
                                   "pressed rim", "narrow rim", "lifted wall", "pushed wall",
                                   "pressed lump", "thin rim"}));
  EXPECT_EQ(stages(plan, "in"), (std::set<std::string>{"tool state", "contact", "removal",
                                                       "outer surface", "growth", "force"}));
  for (const auto& line : plan.at("left_out")) {
    EXPECT_FALSE(line.at("why").get<std::string>().empty());
    EXPECT_TRUE(line.at("saved_ns").is_number());
  }
}

TEST(Plan, KeepsAllNeededStages) {
  const ScratchFolder folder;
  auto scene = nlohmann::json::parse(kSolidFrictionless);
  scene["lump"]["inner_radius_mm"] = 20;
  scene["force"]["friction"] = 0.2;
  scene["stability"]["max_stress_kpa"] = 10;
  scene["tool"]["gap_mm"] = 5;
  scene["clay"] = {{"finger_mm", 90},
                   {"finger_behind", 0.5},
                   {"heave_slope", 0.2},
                   {"thin_wall", "yields"},
                   {"pressed_rim", "sinks"},
                   {"narrow_rim", "closes"},
                   {"lifted_wall", "stretches"},
                   {"pushed_wall", "bends"},
                   {"pressed_lump", "stretches"},
                   {"thin_rim", "rises"}};
  write_text(folder.file("s.scene.json"), scene.dump());
  EXPECT_TRUE(
      claystack("plan --json " + folder.file("s.scene.json")).json().at("left_out").empty());
  scene.erase("force");
  write_text(folder.file("s.scene.json"), scene.dump());
  EXPECT_EQ(stages(claystack("plan --json " + folder.file("s.scene.json")).json(), "left_out"),
            (std::set<std::string>{"force", "friction"}));
}

TEST(Plan, StatesTheReasonOfTheMode) {
  const ScratchFolder folder;
  auto scene = nlohmann::json::parse(kSolidFrictionless);
  scene["stability"]["max_stress_kpa"] = 10;
  scene["tool"]["gap_mm"] = 5;
  scene["clay"] = nlohmann::json::object();
  const auto reasons = [&](const char* mode) {
    scene["tool"]["mode"] = mode;
    write_text(folder.file("s.scene.json"), scene.dump());
    std::map<std::string, std::string> found;
    const auto plan = claystack("plan --json " + folder.file("s.scene.json")).json();
    for (const auto& line : plan.at("left_out"))
      found[line.at("stage").get<std::string>()] = line.at("why").get<std::string>();
    return found;
  };
  auto foot = reasons("trim_foot");
  EXPECT_EQ(foot["stability"], "a pot upside down rests on its rim");
  EXPECT_EQ(foot["pinch"], "this mode has one tool");
  EXPECT_EQ(foot["shift"], "a trimming tool moves no clay");
  auto sponge = reasons("smooth");
  EXPECT_EQ(sponge["pinch"], "this mode has one tool");
  EXPECT_EQ(sponge["removal"], "a sponge removes no clay");
  EXPECT_FALSE(sponge.contains("smear"));
  EXPECT_FALSE(sponge.contains("stability"));
}

TEST(Plan, ReportsWhetherAnArmCanRenderTheContact) {
  const ScratchFolder folder;
  write_text(folder.file("s.scene.json"), kSolidFrictionless);
  // 41 rings of 0.5 mm under the sphere, 0.02 N/mm2: 0.41 N/mm. Accepted: b / 3T.
  const auto calm =
      claystack("plan --json --rate 1000 --damping 0.002 " + folder.file("s.scene.json"));
  ASSERT_EQ(calm.status, 0) << calm.err;
  const auto servo = calm.json().at("servo");
  EXPECT_NEAR(servo.at("stiffness_n_per_mm").get<double>(), 0.41, 1e-12);
  EXPECT_NEAR(servo.at("contact_height_mm").get<double>(), 20.5, 1e-12);
  EXPECT_NEAR(servo.at("accepted_n_per_mm").get<double>(), 0.002 * 1000 / 3, 1e-12);

  const auto stiff = claystack("plan --rate 500 " + folder.file("s.scene.json"));
  EXPECT_EQ(stiff.status, 2);
  // 333.3 / 410 of 0.02, and 410 / 333.3 of 500 Hz.
  EXPECT_NE(stiff.err.find("force.stiffness_n_per_mm2: expected at most 0.0162"), std::string::npos)
      << stiff.err;
  EXPECT_NE(stiff.err.find("found 0.02; or a rate of at least 615 Hz"), std::string::npos)
      << stiff.err;
  EXPECT_EQ(claystack("plan -q --rate 615 " + folder.file("s.scene.json")).status, 0);
  const auto no_rate = claystack("plan --damping 0.01 " + folder.file("s.scene.json"));
  EXPECT_EQ(no_rate.status, 2);
  EXPECT_NE(no_rate.err.find("--damping: expected --rate too"), std::string::npos) << no_rate.err;
  EXPECT_EQ(claystack("plan -q --rate 5 " + folder.file("s.scene.json")).status, 2);
}

}  // namespace
}  // namespace clay::test
