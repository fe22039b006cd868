// Throwing by hand, as the program does it, with the simulated arm.

#include "run_program.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::test {
namespace {

/// Runs `throw --device simulated` until its session holds some blocks, then sends a signal. The
/// exit status is the program's.
Ran interrupted(const ScratchFolder& folder, const std::string& signal) {
  const std::string session = folder.file("s.session");
  return shell(std::string(CLAYSTACK_PROGRAM) + " throw " + sample("bowl.scene.json") +
               " --device simulated --json --record " + session + " -o " +
               folder.file("a.pot.json") + " & program=$!; while [ $(cat " + session +
               " 2>/dev/null | wc -l) -lt 15 ]; do sleep 0.01; done; kill -s " + signal +
               " $program; wait $program");
}

std::string replayed(const ScratchFolder& folder) {
  const auto run = claystack("throw -q " + sample("bowl.scene.json") + " -s " +
                             folder.file("s.session") + " -o " + folder.file("b.pot.json"));
  EXPECT_EQ(run.status, 0) << run.err;
  return read_text(folder.file("b.pot.json"));
}

TEST(LiveThrow, RunsWithoutHardwareAndReplaysToTheSameBytes) {
  const ScratchFolder folder;
  const auto run = claystack("throw " + sample("bowl.scene.json") +
                             " --device simulated --seconds 1.5 --json --record " +
                             folder.file("s.session") + " -o " + folder.file("a.pot.json"));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("ended"), "time_up");
  EXPECT_GE(json.at("seconds"), 1.5);
  EXPECT_EQ(json.at("volume_error_quanta"), 0);
  EXPECT_EQ(json.at("recording").at("lost"), 0);
  EXPECT_EQ(json.at("recording").at("poses"), json.at("poses"));
  EXPECT_GE(json.at("servo").at("ticks"), json.at("poses"));
  for (const char* times :
       {"lateness_us", "oversleep_us", "period_us", "work_us", "sample_age_us"}) {
    const auto& spread = json.at("servo").at(times);
    EXPECT_LE(spread.at("p50"), spread.at("p99"));
    EXPECT_LE(spread.at("p99"), spread.at("max"));
  }
  EXPECT_EQ(replayed(folder), read_text(folder.file("a.pot.json")));
}

TEST(LiveThrow, ASignalKeepsPotAndSession) {
  for (const char* signal : {"INT", "TERM"}) {
    const ScratchFolder folder;
    const auto run = interrupted(folder, signal);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.json().at("ended"), "stopped");
    EXPECT_EQ(replayed(folder), read_text(folder.file("a.pot.json"))) << signal;
  }
}

TEST(LiveThrow, KilledItLeavesASessionThatReplays) {
  const ScratchFolder folder;
  EXPECT_EQ(interrupted(folder, "KILL").status, 128 + 9);
  EXPECT_FALSE(replayed(folder).empty());
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
}

TEST(LiveThrow, RefusesASceneThatIsTooStiffAndSoftensItWhenAsked) {
  const ScratchFolder folder;
  auto scene = nlohmann::json::parse(read_text(sample("bowl.scene.json")));
  scene["force"]["stiffness_n_per_mm2"] = 0.2;
  const std::string path = folder.file("stiff.scene.json");
  write_text(path, scene.dump());
  const std::string live = "throw " + path + " --device simulated --seconds 0.2 --json";
  const auto refused = claystack(live);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("force.stiffness_n_per_mm2: expected at most 0.033"),
            std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("--soften"), std::string::npos);
  // Twice the travel of the hand at the same force: half as stiff... and at unit gain twice.
  EXPECT_EQ(claystack(live + " --soften").status, 0);
  scene["force"]["stiffness_n_per_mm2"] = 0.03;
  write_text(path, scene.dump());
  EXPECT_EQ(claystack(live).status, 0);
  EXPECT_EQ(claystack(live + " --scale 2 --force-gain 1").status, 2);
}

TEST(LiveThrow, NamesWhatItCannotDo) {
  const std::string live = "throw " + sample("bowl.scene.json") + " --device ";
  EXPECT_EQ(claystack(live + "hand").status, 2);
  EXPECT_EQ(claystack(live + "simulated --rate 50").status, 2);
  EXPECT_EQ(claystack(live + "simulated --flip w").status, 2);
  EXPECT_EQ(claystack(live + "simulated --trace t.csv").status, 2);
  EXPECT_EQ(claystack(live + "simulated -o pot.stl").status, 2);
  EXPECT_EQ(claystack(live + "simulated --seconds 0.1 --record /no/such/folder/s").status, 3);
  // No such device here, and none is made up.
  const auto none = claystack(live + "/dev/hidraw99");
  EXPECT_EQ(none.status, 4);
}

}  // namespace
}  // namespace clay::test
