// Throwing by hand with the simulated arm.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace clay::test {
namespace {

const std::string kBowl = "throw " + sample("paper/bowl.scene.json");

/// Starts `throw --device simulated` with additional options, runs `then` when its recording in
/// `folder` holds some blocks, and waits for its end. Returns the program's exit status, or 124 if
/// the recording did not appear.
Ran interrupted(const ScratchFolder& folder, const std::string& more, const std::string& then,
                const std::string& environment = "") {
  const std::string session = folder.file("s.session");
  return shell(environment + " " CLAYSTACK_PROGRAM " " + kBowl +
               " --device simulated --seconds 100 --record " + session + " " + more +
               " & program=$!; for i in $(seq 3000); do [ $(cat " + session +
               ".recording 2>/dev/null | wc -l) -ge 15 ] && break; kill -0 $program || exit 124; "
               "sleep 0.01; done; " +
               then + "; wait $program");
}

/// The pot replayed from the session, or from an incomplete recording.
std::string replayed(const ScratchFolder& folder, const std::string& session = "s.session") {
  const auto run =
      claystack(kBowl + " -q -s " + folder.file(session) + " -o " + folder.file("replay.pot.json"));
  EXPECT_EQ(run.status, 0) << run.err;
  return read_text(folder.file("replay.pot.json"));
}

/// The only file in this folder and its subfolders.
std::string only_file_in(const std::string& folder) {
  std::string found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) {
      EXPECT_EQ(found, "") << entry.path();
      found = entry.path().string();
    }
  return found;
}

TEST(LiveThrow, RunsWithoutHardwareAndReplaysToTheSameBytes) {
  const ScratchFolder folder;
  const auto run = claystack("throw " + sample("paper/bowl.scene.json") +
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

/// Each arm gets its own limit; the clay keeps its stiffness.
TEST(LiveThrow, ASoftenedThrowLeavesTheStiffnessOfThePot) {
  const ScratchFolder folder;
  const auto stiffness = [](const std::string& path) {
    return nlohmann::json::parse(read_text(path))
        .at("thrown_with")
        .at("force")
        .at("stiffness_n_per_mm2");
  };
  const std::string first = folder.file("a.pot.json"), second = folder.file("b.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + first).status, 0);
  const Ran soft = claystack("throw --from " + first +
                             " --device simulated --seconds 1 --scale 2 --force-gain 1 --record " +
                             folder.file("s.session") + " -o " + second);
  ASSERT_EQ(soft.status, 0) << soft.err;
  EXPECT_NE(soft.err.find("is lowered to"), std::string::npos) << soft.err;
  EXPECT_EQ(stiffness(second), stiffness(first));
}

TEST(LiveThrow, KeepsPotAndSessionOnASignal) {
  for (const std::string signal : {"INT", "TERM", "HUP", "PIPE"}) {
    const ScratchFolder folder;
    const auto run = interrupted(folder, "--json -o " + folder.file("a.pot.json"),
                                 "kill -s " + signal + " $program");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.json().at("ended"), "stopped");
    EXPECT_EQ(replayed(folder), read_text(folder.file("a.pot.json"))) << signal;
    EXPECT_FALSE(std::filesystem::exists(folder.file("s.session.recording")));
  }
}

TEST(LiveThrow, KilledLeavesAReplayableRecordingAndTheOldSession) {
  const ScratchFolder folder;
  write_text(folder.file("s.session"), "the old one");
  const auto run = interrupted(folder, "-o " + folder.file("a.pot.json"), "kill -s KILL $program");
  EXPECT_EQ(run.status, 128 + 9);
  EXPECT_EQ(read_text(folder.file("s.session")), "the old one");
  EXPECT_FALSE(replayed(folder, "s.session.recording").empty());
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
}

// A USB stick has no unnamed files, so the pot's temporary file is in its folder from the start.
TEST(LiveThrow, LeavesNoTemporaryPotWhenASignalEndsIt) {
  for (const std::string signal : {"QUIT", "USR1"}) {
    const ScratchFolder folder;
    const std::string pot = folder.file("a.pot.json");
    const auto run = interrupted(
        folder, "-o " + pot,
        "ls -A " + folder.path().string() + "; kill -s " + signal + " $program",
        "ulimit -c 0; env ASAN_OPTIONS=verify_asan_link_order=0 CLAYSTACK_FAULT_WITHOUT=tmpfile "
        "CLAYSTACK_FAULT_FOLDER=" +
            folder.path().string() + " LD_PRELOAD=" CLAYSTACK_FAULT_SHIM);
    EXPECT_GT(run.status, 128) << run.err;
    EXPECT_NE(run.out.find(".a.pot.json."), std::string::npos) << "it was there: " << run.out;
    EXPECT_EQ(only_file_in(folder.path().string()), folder.file("s.session.recording"));
  }
}

TEST(LiveThrow, RefusesASecondRecorderOfTheSameSession) {
  const ScratchFolder folder;
  const auto run = interrupted(folder, "-o " + folder.file("a.pot.json"),
                               CLAYSTACK_PROGRAM " " + kBowl + " --device simulated --record " +
                                   folder.file("s.session") + " -o " + folder.file("b.pot.json") +
                                   "; echo second $?; kill -s INT $program");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("second 3"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("s.session: another program is recording to it"), std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.pot.json")));
  EXPECT_EQ(replayed(folder), read_text(folder.file("a.pot.json")));
}

TEST(LiveThrow, RefusesUnwritableOutputsBeforeThrowing) {
  const ScratchFolder folder;
  write_text(folder.file("folder"), "");
  const std::string live = kBowl + " --device simulated --seconds 100 ";
  for (const std::string& output :
       {"-o " + folder.file("none/a.pot.json"), "-o " + folder.file("folder/a.pot.json"),
        "--record " + folder.file("none/s.session") + " -o " + folder.file("a.pot.json")}) {
    const auto run = claystack(live + output);
    EXPECT_EQ(run.status, 3) << output;
    EXPECT_EQ(run.out, "") << output;
    EXPECT_NE(run.err.find(folder.path().string()), std::string::npos) << run.err;
  }
  // A limit on file size simulates a full disk.
  const auto full = shell("(ulimit -f 0; " CLAYSTACK_PROGRAM " " + live + " -o " +
                          folder.file("a.pot.json") + "; echo status $?) 2>&1 | cat");
  EXPECT_NE(full.out.find("a.pot.json: could not write: File too large\nstatus 3"),
            std::string::npos)
      << full.out;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
}

TEST(LiveThrow, KeepsAPotInTheStateFolderIfItsFolderIsGone) {
  const ScratchFolder folder;
  const std::string pots = folder.file("pots"), state = folder.file("state");
  std::filesystem::create_directory(pots);
  const auto run =
      interrupted(folder, "-o " + pots + "/a.pot.json", "rm -r " + pots + "; kill -s INT $program",
                  "XDG_STATE_HOME=" + state);
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.out.find("pot: "), std::string::npos) << run.out;
  const std::string kept = only_file_in(state);
  EXPECT_NE(run.err.find("; the pot is in " + kept), std::string::npos) << run.err;
  EXPECT_TRUE(kept.ends_with(".pot.json")) << kept;
  EXPECT_EQ(read_text(kept), replayed(folder));
}

TEST(LiveThrow, KeepsAPotInTheTemporaryFolderAsALastResort) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json"), temporary = folder.file("tmp");
  std::filesystem::create_directory(temporary);
  std::filesystem::create_symlink("/dev/full", pot);
  const auto run = interrupted(folder, "-o " + pot, "kill -s INT $program",
                               "XDG_STATE_HOME=/dev/null TMPDIR=" + temporary);
  EXPECT_EQ(run.status, 3);
  const std::string kept = only_file_in(temporary);
  EXPECT_NE(run.err.find(pot + ": could not write: No space left on device; the pot is in " + kept),
            std::string::npos)
      << run.err;
  EXPECT_EQ(read_text(kept), replayed(folder));
}

TEST(LiveThrow, KeepsThePotWhenStdoutCloses) {
  const ScratchFolder folder;
  const auto run =
      shell(CLAYSTACK_PROGRAM " " + kBowl + " --device simulated --seconds 0.5 --record " +
            folder.file("s.session") + " -o " + folder.file("a.pot.json") + " | true");
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(replayed(folder), read_text(folder.file("a.pot.json")));
}

TEST(LiveThrow, SoftensAStiffSceneOrRefusesIt) {
  const ScratchFolder folder;
  auto scene = nlohmann::json::parse(read_text(sample("paper/bowl.scene.json")));
  scene["force"]["stiffness_n_per_mm2"] = 0.2;
  const std::string path = folder.file("stiff.scene.json");
  write_text(path, scene.dump());
  const std::string live = "throw " + path + " --device simulated --seconds 0.2 --json";
  const auto softened = claystack(live);
  EXPECT_EQ(softened.status, 0);
  EXPECT_NE(softened.err.find("stiffness_n_per_mm2 is lowered to 0.033"), std::string::npos)
      << softened.err;
  const auto refused = claystack(live + " --no-soften");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("force.stiffness_n_per_mm2: expected at most 0.033"),
            std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("--no-soften"), std::string::npos);
  // Twice the travel of the hand at the same force is half as stiff; at unit gain it is twice as
  // stiff.
  scene["force"]["stiffness_n_per_mm2"] = 0.03;
  write_text(path, scene.dump());
  EXPECT_EQ(claystack(live + " --no-soften").status, 0);
  EXPECT_EQ(claystack(live + " --no-soften --scale 2 --force-gain 1").status, 2);
}

TEST(LiveThrow, WarnsBeforeAThrowThatIsNotKept) {
  const ScratchFolder folder;
  const std::string live = kBowl + " --device simulated --seconds 0.1 ";
  const Ran lost = claystack(live);
  EXPECT_NE(lost.err.find("neither the pot nor the session is kept"), std::string::npos);
  EXPECT_NE(lost.out.find("pot: not written"), std::string::npos) << lost.out;
  for (const char* kept : {"-o p.pot.json", "--record s.session"})
    EXPECT_EQ(
        shell("cd " + folder.path().string() + " && " CLAYSTACK_PROGRAM " " + live + kept).err, "")
        << kept;
}

/// In the settings 0 stands for the default: --force-gain 0 must not mean the full force.
TEST(LiveThrow, RefusesAZeroThatWouldMeanTheDefault) {
  const std::string live = kBowl + " --device simulated ";
  for (const std::string option : {"--seconds", "--clay-rate", "--force-gain"}) {
    const std::string others = option == "--seconds" ? "" : " --seconds 0.1";
    for (const char* zero : {"0", "0.0", "-0"}) {
      const Ran run = claystack(live + option + " " + zero + others);
      EXPECT_EQ(run.status, 2) << option;
      EXPECT_NE(run.err.find(option + ": expected a number above 0, found " + zero),
                std::string::npos)
          << run.err;
    }
  }
  const Ran negative = claystack(live + "--seconds 0.1 --force-gain -1");
  EXPECT_EQ(negative.status, 2);
  EXPECT_NE(negative.err.find("--force-gain: expected"), std::string::npos) << negative.err;
}

/// As the session that a replay of the scene plays by default.
TEST(LiveThrow, MayRecordBesideItsScene) {
  const ScratchFolder folder;
  const std::string scene = folder.file("mug.scene.json"), session = folder.file("mug.session");
  write_text(scene, read_text(sample("paper/bowl.scene.json")));
  const std::string live = "throw " + scene + " --device simulated --seconds 0.2 --record ";
  const Ran first = claystack(live + session + " -o " + folder.file("a.pot.json"));
  EXPECT_EQ(first.status, 0) << first.err;
  const Ran again = claystack("throw " + scene + " -o " + folder.file("b.pot.json"));
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(read_text(folder.file("a.pot.json")), read_text(folder.file("b.pot.json")));
  const Ran reads_it = claystack(live + session);
  EXPECT_EQ(reads_it.status, 2) << "the simulated arm plays the session beside the scene";
  EXPECT_NE(reads_it.err.find("the same file as the input"), std::string::npos) << reads_it.err;
}

TEST(LiveThrow, RefusesASessionThatNoArmPlays) {
  const Ran run = claystack(kBowl + " --device falcon -s " + sample("paper/bowl.session"));
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--session: expected --device simulated too"), std::string::npos)
      << run.err;
}

TEST(LiveThrow, ErrorsOfDampingNameTheOption) {
  const std::string live =
      "throw " + sample("paper/bowl.scene.json") + " --device simulated --seconds 0.1 --damping ";
  const Ran run = claystack(live + "5");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err, "claystack: --damping: expected a value from 0 to 1, found 5\n");
  const Ran none = claystack(live + "0 --no-soften");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("an arm without damping renders no contact"), std::string::npos)
      << none.err;
}

TEST(LiveThrow, ReportsAThreadThatDoesNotStart) {
  const std::string live = CLAYSTACK_PROGRAM " " + kBowl + " --device simulated --seconds 0.2";
  for (int thread = 1; thread <= 2; ++thread) {
    const Ran run = shell("env ASAN_OPTIONS=verify_asan_link_order=0 CLAYSTACK_FAULT_THREAD=" +
                          std::to_string(thread) + " LD_PRELOAD=" CLAYSTACK_FAULT_SHIM " " + live);
    EXPECT_EQ(run.status, 3) << thread << run.err;
    EXPECT_NE(run.err.find("could not start the servo's threads: Resource temporarily unavailable"),
              std::string::npos)
        << run.err;
  }
}

TEST(LiveThrow, ReportsUnsupportedRequests) {
  const std::string live = "throw " + sample("paper/bowl.scene.json") + " --device ";
  EXPECT_EQ(claystack(live + "hand").status, 2);
  EXPECT_EQ(claystack(live + "simulated --rate 50").status, 2);
  EXPECT_EQ(claystack(live + "simulated --flip w").status, 2);
  EXPECT_EQ(claystack(live + "simulated --trace t.csv").status, 2);
  EXPECT_EQ(claystack(live + "simulated -o pot.stl").status, 2);
  EXPECT_EQ(claystack(live + "simulated --seconds 0.1 --record /no/such/folder/s.session").status,
            3);
  // A missing device is not simulated.
  const auto none = claystack(live + "/dev/hidraw99");
  EXPECT_EQ(none.status, 4);
}

}  // namespace
}  // namespace clay::test
