// Many jobs in separate processes: results, resumption, isolation.

#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace clay::test {
namespace {

/// By id.
std::map<std::string, nlohmann::json> results_in(const std::string& text) {
  std::map<std::string, nlohmann::json> results;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    nlohmann::json one = nlohmann::json::parse(line);
    results[one.at("id")] = one;
  }
  return results;
}

nlohmann::json job(const std::string& id, std::vector<std::string> run) {
  return {{"id", id}, {"run", run}};
}

class Batch : public testing::Test {
 protected:
  void write_jobs(const std::vector<nlohmann::json>& jobs) const {
    std::string text;
    for (const nlohmann::json& one : jobs) text += one.dump() + "\n";
    write_text(folder.file("jobs.jsonl"), text);
  }
  [[nodiscard]] Ran run(const std::string& options) const {
    return claystack("batch " + folder.file("jobs.jsonl") + " " + options);
  }
  /// A throw whose pot is written to NAME.
  [[nodiscard]] nlohmann::json thrown(const std::string& name) const {
    return job(name, {"throw", sample("cylinder.scene.json"), "-o", folder.file(name)});
  }

  ScratchFolder folder;
};

TEST_F(Batch, GivesALineOfTheSchemaForEachJob) {
  write_text(folder.file("empty.stl"), "");
  write_jobs({thrown("a.pot.json"), thrown("b.pot.cbor"),
              job("bad", {"check", folder.file("empty.stl")}),
              job("absent", {"check", folder.file("absent.stl")})});
  const Ran ran = run("-j 3");
  EXPECT_EQ(ran.status, 1) << ran.err;
  const auto results = results_in(ran.out);
  ASSERT_EQ(results.size(), 4u) << ran.out;
  const auto schema = load_schema("batch");
  for (const auto& [id, result] : results) EXPECT_EQ(violation(schema, result), "") << result;
  EXPECT_EQ(results.at("a.pot.json").at("status"), 0);
  EXPECT_EQ(results.at("a.pot.json").at("output").at("model"), "conserving");
  EXPECT_EQ(results.at("bad").at("status"), 2);
  EXPECT_EQ(results.at("absent").at("status"), 3);
  // The same bytes as the command itself.
  ASSERT_EQ(claystack("throw -q " + sample("cylinder.scene.json") + " -o " +
                      folder.file("alone.pot.json"))
                .status,
            0);
  EXPECT_EQ(read_text(folder.file("a.pot.json")), read_text(folder.file("alone.pot.json")));
}

TEST_F(Batch, ResumesAfterTheJobsThatHaveAVerdict) {
  const std::string results = folder.file("results.jsonl");
  write_jobs({thrown("a.pot.json"), job("absent", {"check", folder.file("late.pot.json")})});
  const Ran first = run("-o " + results);
  ASSERT_EQ(first.status, 1);
  EXPECT_EQ(first.out, "2 jobs: 1 done, 1 failed\n");
  // An unfinished last line, as of a killed batch.
  write_text(results, read_text(results) + R"({"schema":"claystack-ba)");
  std::filesystem::remove(folder.file("a.pot.json"));
  ASSERT_EQ(
      claystack("throw -q " + sample("cylinder.scene.json") + " -o " + folder.file("late.pot.json"))
          .status,
      0);
  const Ran again = run("-o " + results);
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, "2 jobs: 2 done, 0 failed; 1 of them skipped, because " + results +
                           " has their results\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json"))) << "it was not thrown again";
  EXPECT_EQ(results_in(read_text(results)).at("absent").at("status"), 0);
  const nlohmann::json summary = nlohmann::json::parse(run("--json -o " + results).out);
  EXPECT_EQ(summary,
            (nlohmann::json{
                {"jobs", 2}, {"done", 2}, {"failed", 0}, {"skipped", 2}, {"results", results}}));
}

TEST_F(Batch, NamesJobsThatFail) {
  write_jobs({job("absent", {"check", folder.file("none.pot.json")})});
  const Ran ran = run("-o " + folder.file("results.jsonl"));
  EXPECT_NE(ran.err.find("warning: absent: status 3: " + folder.file("none.pot.json") +
                         ": could not open"),
            std::string::npos)
      << ran.err;
}

/// No wall is 500 mm thick.
TEST_F(Batch, NamesTheCheckThatFails) {
  const std::string pot = folder.file("a.pot.json"), stl = folder.file("a.stl");
  ASSERT_EQ(claystack("throw -q " + sample("cylinder.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + stl).status, 0);
  write_text(folder.file("open.off"), "OFF\n3 1 0\n0 0 0\n40 0 0\n0 40 0\n3 0 1 2\n");
  const std::string results = folder.file("results.jsonl");
  write_jobs({job("thin", {"check", stl, "--min-wall", "500"}),
              job("pot", {"check", pot, "--min-wall", "500"}),
              job("open", {"check", folder.file("open.off"), "--min-wall", "3"}),
              job("written", {"export", pot, folder.file("b.stl"), "--min-wall", "500"})});
  const Ran ran = run("-o " + results);
  auto found = results_in(read_text(results));
  const auto error = [&](const char* id) { return found.at(id).value("error", ""); };
  EXPECT_EQ(error("thin").find("walls: thin wall (sampled): "), 0u) << error("thin");
  EXPECT_NE(error("thin").find(" mm, expected at least 500.000 mm"), std::string::npos);
  EXPECT_EQ(error("pot").find("walls: thin wall: "), 0u) << error("pot");
  EXPECT_EQ(error("open").find("open edge (3): "), 0u) << error("open");
  EXPECT_EQ(error("written").find("claystack: thin wall: "), 0u) << error("written");
  EXPECT_NE(ran.err.find("warning: thin: status 1: " + error("thin") + "\n"), std::string::npos)
      << ran.err;
  for (const auto& [id, result] : found)
    EXPECT_EQ(violation(load_schema("batch"), result), "") << result;
}

TEST_F(Batch, RunsAJobAfterTheOneThatItNames) {
  const std::string pot = folder.file("a.pot.json"), stl = folder.file("a.stl");
  auto made = thrown("a.pot.json");
  auto exported = job("stl", {"export", pot, stl});
  auto checked = job("check", {"check", stl});
  exported["after"] = "a.pot.json";
  checked["after"] = "stl";
  const std::string results = folder.file("results.jsonl");
  write_jobs({made, exported, checked});
  const Ran ran = run("-j 4 -o " + results);
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(results_in(read_text(results)).at("check").at("output").at("verdict"), "sound");
  // A job that an earlier batch finished need not run again.
  checked["run"].push_back("--min-wall");
  checked["run"].push_back("0.1");
  write_jobs({made, exported, checked});
  EXPECT_EQ(run("-j 4 -o " + results).out, "3 jobs: 3 done, 0 failed; 2 of them skipped, because " +
                                               results + " has their results\n");
}

TEST_F(Batch, DoesNotRunAJobAfterOneThatFails) {
  auto second = thrown("b.pot.json"), third = thrown("c.pot.json");
  second["after"] = "absent";
  third["after"] = "b.pot.json";
  const std::string results = folder.file("results.jsonl"), late = folder.file("late.pot.json");
  write_jobs({job("absent", {"check", late}), second, third, thrown("free.pot.json")});
  const Ran ran = run("-j 2 -o " + results);
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(ran.out, "4 jobs: 1 done, 3 failed\n");
  EXPECT_NE(ran.err.find("warning: b.pot.json: not run, because absent failed\n"),
            std::string::npos)
      << ran.err;
  const auto found = results_in(read_text(results));
  for (const auto& [id, result] : found)
    EXPECT_EQ(violation(load_schema("batch"), result), "") << result;
  EXPECT_TRUE(found.at("b.pot.json").at("status").is_null());
  EXPECT_EQ(found.at("c.pot.json").at("error"), "not run, because b.pot.json failed");
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.pot.json")));
  // They run when the first job succeeds.
  ASSERT_EQ(claystack("throw -q " + sample("cylinder.scene.json") + " -o " + late).status, 0);
  EXPECT_EQ(run("-j 2 -o " + results).out, "4 jobs: 4 done, 0 failed; 1 of them skipped, because " +
                                               results + " has their results\n");
  // The verdict of an earlier batch counts, too.
  write_jobs({job("absent", {"check", late, "--min-wall", "500"}), thrown("free.pot.json")});
  EXPECT_EQ(run("-o " + results).status, 1);
  second["run"].push_back("--quiet");
  write_jobs({job("absent", {"check", late, "--min-wall", "500"}), second});
  EXPECT_EQ(run("-o " + results).out, "2 jobs: 0 done, 2 failed; 1 of them skipped, because " +
                                          results + " has their results\n");
}

TEST_F(Batch, KeepsJobsThatWaitInOnePart) {
  auto second = thrown("2.pot.json"), third = thrown("3.pot.json");
  second["after"] = "1.pot.json";
  third["after"] = "2.pot.json";
  write_jobs({thrown("1.pot.json"), second, third, thrown("4.pot.json")});
  EXPECT_EQ(results_in(run("--part 1/2").out).size(), 3u);
  const auto rest = results_in(run("--part 2/2").out);
  EXPECT_EQ(rest.size(), 1u);
  EXPECT_TRUE(rest.contains("4.pot.json"));
}

/// Two exports fail a check: one has written its file, one has written nothing.
TEST_F(Batch, RedoesRefusedJobsAlone) {
  const std::string pot = folder.file("a.pot.json"), results = folder.file("results.jsonl");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  write_jobs(
      {job("thin", {"export", pot, folder.file("thin.stl"), "--min-wall", "50"}),
       job("refused", {"export", pot, folder.file("refused.stl"), "--glaze-allowance", "9"})});
  EXPECT_EQ(run("-o " + results).status, 1);
  const auto found = results_in(read_text(results));
  EXPECT_EQ(found.at("thin").at("status"), 1);
  EXPECT_EQ(found.at("refused").at("status"), 1);
  EXPECT_TRUE(std::filesystem::exists(folder.file("thin.stl")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("refused.stl")));
  EXPECT_EQ(found.at("refused").at("output").at("written"), nlohmann::json::array());
  EXPECT_EQ(found.at("thin").at("output").at("passes"), false);
  const auto skipped = [&](const std::string& redo) {
    return nlohmann::json::parse(run("--json -o " + results + redo).out).at("skipped");
  };
  EXPECT_EQ(skipped(" --redo refused"), 1);
  EXPECT_EQ(skipped(" --redo failed"), 0);
  std::filesystem::remove(folder.file("thin.stl"));
  EXPECT_EQ(skipped(" --redo refused"), 1);
  EXPECT_FALSE(std::filesystem::exists(folder.file("thin.stl"))) << "it was not written again";
}

TEST_F(Batch, RedoesJobsWhenAsked) {
  const std::string results = folder.file("results.jsonl"), pot = folder.file("a.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("cylinder.scene.json") + " -o " + pot).status, 0);
  // The wall is thinner than 50 mm.
  write_jobs({thrown("b.pot.json"), job("thin", {"check", pot, "--min-wall", "50"})});
  EXPECT_EQ(run("-o " + results).out, "2 jobs: 1 done, 1 failed\n");
  const auto skipped = [&](const std::string& redo) {
    return nlohmann::json::parse(run("--json -o " + results + redo).out).at("skipped");
  };
  EXPECT_EQ(skipped(""), 2);
  EXPECT_EQ(skipped(" --redo failed"), 1);
  EXPECT_EQ(skipped(" --redo all"), 0);
  EXPECT_EQ(skipped(""), 2);
  EXPECT_EQ(run("--redo some -o " + results).status, 2);
}

TEST_F(Batch, IsolatesAJobThatTakesTooLong) {
  // It reads a pipe into which nothing is written.
  ASSERT_EQ(shell("mkfifo " + folder.file("pipe.pot.json")).status, 0);
  write_jobs({job("stuck", {"check", folder.file("pipe.pot.json")}), thrown("a.pot.json")});
  const Ran ran = run("-j 1 --time-limit 5");
  EXPECT_EQ(ran.status, 1);
  const auto results = results_in(ran.out);
  EXPECT_EQ(results.at("stuck").at("error"), "ended by the time limit");
  EXPECT_EQ(results.at("stuck").at("status"), 137);
  EXPECT_EQ(results.at("a.pot.json").at("status"), 0);
}

TEST_F(Batch, IsolatesAJobThatCrashes) {
  const std::string crashing = folder.file("crashing");
  std::filesystem::create_directory(crashing);
  write_jobs(
      {job("crash", {"throw", sample("cylinder.scene.json"), "-o", crashing + "/a.pot.json"}),
       thrown("b.pot.json")});
  const Ran ran = shell(
      "ulimit -c 0; env ASAN_OPTIONS=verify_asan_link_order=0:handle_segv=0 CLAYSTACK_FAULT_AT=1 "
      "CLAYSTACK_FAULT_SIGNAL=11 CLAYSTACK_FAULT_FOLDER=" +
      crashing + " LD_PRELOAD=" CLAYSTACK_FAULT_SHIM " " CLAYSTACK_PROGRAM " batch -j 1 " +
      folder.file("jobs.jsonl"));
  EXPECT_EQ(ran.status, 1) << ran.err;
  const auto results = results_in(ran.out);
  EXPECT_EQ(results.at("crash").at("status"), 139);
  EXPECT_EQ(results.at("crash").at("error"), "ended by signal 11");
  EXPECT_EQ(results.at("b.pot.json").at("status"), 0);
}

TEST_F(Batch, LimitsTheMemoryOfItsJobs) {
  write_text(folder.file("tall.scene.json"),
             R"({"schema":"claystack-scene-1","name":"tall","lump":{"rings":10,)"
             R"("ring_height_mm":0.001,"max_rings":1000000},"tool":{"shape":)"
             R"({"sphere":{"radius_mm":9}},"gap_mm":5}})");
  const std::vector<std::string> plan{"plan", folder.file("tall.scene.json")};
  std::vector<std::string> roomy = plan;
  roomy.insert(roomy.end(), {"--memory", "1GiB"});
  write_jobs({job("small", plan), job("roomy", roomy)});
  const auto results = results_in(run("--memory 40MiB").out);
  EXPECT_EQ(results.at("small").at("status"), 3);
  EXPECT_NE(results.at("small").at("error").get<std::string>().find(
                "tall.scene.json: a wheel for up to 1000000 rings needs about 0.05 GB"),
            std::string::npos)
      << results.at("small");
  EXPECT_EQ(results.at("roomy").at("status"), 0) << results.at("roomy");
  EXPECT_EQ(results.at("small").at("run"), plan) << "as in the file of jobs";
}

TEST_F(Batch, RunsAJobWhoseFilesFollowTwoDashes) {
  ASSERT_EQ(
      claystack("import -q " + sample("drawings/jug.svg") + " -o " + folder.file("a.pot.json"))
          .status,
      0);
  write_jobs({job("a", {"check", "--", folder.file("a.pot.json")})});
  const auto results = results_in(run("").out);
  EXPECT_EQ(results.at("a").at("status"), 0) << results.at("a");
  EXPECT_TRUE(results.at("a").contains("output"));
}

TEST_F(Batch, SplitsIntoPartsThatTogetherAreAll) {
  write_jobs({thrown("1.pot.json"), thrown("2.pot.json"), thrown("3.pot.json")});
  const auto first = results_in(run("--part 1/2").out), second = results_in(run("--part 2/2").out);
  EXPECT_TRUE(first.contains("1.pot.json") && first.contains("3.pot.json"));
  EXPECT_EQ(first.size(), 2u);
  EXPECT_EQ(second.size(), 1u);
  EXPECT_TRUE(second.contains("2.pot.json"));
  EXPECT_EQ(run("--part 3/2").status, 2);
}

TEST_F(Batch, RefusesInvalidParts) {
  write_jobs({thrown("a.pot.json")});
  for (const char* part : {"2/1", "0/1", "1/0", "2/-1", "+1/1", "1/ 1", "1/1x", "1", "/"})
    EXPECT_EQ(run("--part '" + std::string(part) + "'").status, 2) << part;
}

TEST_F(Batch, ResumesFromResultsThatDoNotFitInMemory) {
  write_jobs({thrown("a.pot.json")});
  const std::string results = folder.file("results.jsonl");
  ASSERT_EQ(run("-o " + results).status, 0);
  std::string one = read_text(results);
  const std::string output(1'000'000, 'x');
  std::string many;
  for (int i = 0; i < 100; ++i)
    many += R"({"schema":"claystack-batch-1","id":"old","run":["check"],"status":0,"output":")" +
            output + "\"}\n";
  write_text(results, many + one);
  const Ran resumed = run("--memory 64MiB -o " + results);
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(resumed.out, "1 job: 1 done, 0 failed; 1 of them skipped, because " + results +
                             " has their results\n");
}

TEST_F(Batch, LeavesWholeLinesWhenAResultCannotBeWritten) {
  std::vector<nlohmann::json> jobs;
  for (int i = 0; i < 6; ++i)
    jobs.push_back(job(std::to_string(i), {"plan", sample("cylinder.scene.json")}));
  write_jobs(jobs);
  const std::string results = folder.file("results.jsonl");
  ASSERT_EQ(run("-q -o " + results).status, 0);
  const std::string all = read_text(results);
  std::filesystem::remove(results);
  // Blocks of 512 bytes; one and a half results fit.
  const std::size_t blocks = all.size() / 6 * 3 / 2 / 512;
  const Ran full =
      shell("ulimit -f " + std::to_string(blocks) + "; " CLAYSTACK_PROGRAM " batch -j 2 -o " +
            results + " " + folder.file("jobs.jsonl"));
  EXPECT_EQ(full.status, 3) << full.out << full.err;
  EXPECT_EQ(full.out, "");
  const std::string kept = read_text(results);
  EXPECT_EQ(results_in(kept).size(), 1u) << kept;
  EXPECT_TRUE(kept.ends_with('\n')) << kept;
  const Ran again = run("-o " + results);
  EXPECT_EQ(again.out, "6 jobs: 6 done, 0 failed; 1 of them skipped, because " + results +
                           " has their results\n");
}

/// The report on a repair lists every hole: here that of each of many bodies.
TEST_F(Batch, NamesAnOutputThatIsTooLongForAResult) {
  const auto vertex = [](int x, int y, int z) {
    return "vertex " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  };
  std::string mesh = "solid many\n";
  for (int x = 0; x < 2 * 28'000; x += 2) {
    const std::string a = vertex(x, 0, 0), b = vertex(x + 1, 0, 0), c = vertex(x, 1, 0),
                      d = vertex(x, 0, 1);
    for (const std::string& facet : {a + c + b, a + b + d, b + c + d})
      mesh += "facet normal 0 0 1\nouter loop\n" + facet + "endloop\nendfacet\n";
  }
  write_text(folder.file("many.stl"), mesh + "endsolid many\n");
  write_jobs({job("long", {"check", folder.file("many.stl"), "--repair", "--dry-run"})});
  const auto result = results_in(run("").out).at("long");
  EXPECT_EQ(result.at("status"), 0);
  EXPECT_EQ(result.at("error"), "the output exceeds 4 MiB and is omitted");
  EXPECT_FALSE(result.contains("output"));
}

TEST_F(Batch, RefusesAWrongLineBeforeTheFirstJob) {
  const std::string good = thrown("a.pot.json").dump() + "\n";
  for (const auto& [line, message] :
       {std::pair<std::string, std::string>{R"({"id": "x", "run": ["studio"]})",
                                            ":2: run: expected one of"},
        {R"({"id": "a.pot.json", "run": ["plan"]})", ":2: id: expected a different id"},
        {R"({"id": "x"})", ":2: expected a field \"run\""},
        {R"({"id": "x", "run": "plan"})", ":2: run: expected an array"},
        {R"({"id": "x", "run": ["plan"], "after": "y"})",
         ":2: after: expected the id of a job on an earlier line, found y"},
        {R"({"id": "x", "run": ["plan"], "after": "x"})",
         ":2: after: expected the id of a job on an earlier line, found x"},
        {"{", ":2: "}}) {
    write_text(folder.file("jobs.jsonl"), good + line + "\n");
    const Ran ran = run("");
    EXPECT_EQ(ran.status, 2) << line;
    EXPECT_NE(ran.err.find("jobs.jsonl" + message), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
  }
}

TEST_F(Batch, ReportsAllWrongLines) {
  auto waits = job("waits", {"plan", "x"});
  waits["after"] = "bad";
  std::string text = thrown("a.pot.json").dump() + "\n{\n" + R"({"id": "bad", "run": ["studio"]})" +
                     "\n" + waits.dump() + "\n";
  write_text(folder.file("jobs.jsonl"), text);
  const Ran two = run("");
  EXPECT_EQ(two.status, 2);
  EXPECT_NE(two.err.find("jobs.jsonl:2: "), std::string::npos) << two.err;
  EXPECT_NE(two.err.find("jobs.jsonl:3: run: expected one of"), std::string::npos) << two.err;
  EXPECT_EQ(two.err.find("jobs.jsonl:4: "), std::string::npos) << "only line 3 is wrong" << two.err;
  const auto json = nlohmann::json::parse(run("--json").out);
  EXPECT_EQ(violation(load_schema("error"), json), "");
  EXPECT_EQ(json.at("errors").size(), 2u);
  EXPECT_EQ(json.at("errors").at(0), json.at("error"));
  for (int i = 0; i < 12; ++i) text += "{}\n";
  write_text(folder.file("jobs.jsonl"), text);
  const Ran many = run("");
  EXPECT_NE(many.err.find("jobs.jsonl:12: "), std::string::npos) << many.err;
  EXPECT_EQ(many.err.find("jobs.jsonl:13: "), std::string::npos) << "10 lines" << many.err;
  EXPECT_NE(many.err.find("jobs.jsonl: 4 more wrong lines\n"), std::string::npos) << many.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
  // Another kind of file has no lines of jobs.
  write_text(folder.file("jobs.jsonl"), "solid pot\nfacet normal 0 0 1\nouter loop\n");
  const Ran other = run("");
  EXPECT_EQ(std::ranges::count(other.err, '\n'), 1) << other.err;
}

TEST_F(Batch, RefusesJobsThatWriteTheSameFile) {
  auto second = thrown("a.pot.json");
  second["id"] = "again";
  second["run"][3] = folder.file("./a.pot.json");
  write_jobs({thrown("a.pot.json"), second});
  const Ran ran = run("-j 2");
  EXPECT_EQ(ran.status, 2) << ran.out;
  EXPECT_NE(ran.err.find("written by a.pot.json and again"), std::string::npos) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
  second["run"][2] = "-o" + folder.file("a.pot.json");
  second["run"].erase(3);
  write_jobs({thrown("a.pot.json"), second});
  EXPECT_EQ(run("-j 2").status, 2) << "an attached name";
  // The input of several exports is no output.
  const std::string pot = folder.file("b.pot.json"), stl = folder.file("b.stl");
  ASSERT_EQ(claystack("throw -q " + sample("cylinder.scene.json") + " -o " + pot).status, 0);
  write_jobs({job("1", {"export", pot, stl}), job("2", {"export", pot, folder.file("b.obj")})});
  EXPECT_EQ(run("-j 2").status, 0);
  write_jobs({job("1", {"export", pot, stl}), job("2", {"export", "--min-wall", "1", pot, stl})});
  EXPECT_EQ(run("-j 2").status, 2);
  EXPECT_EQ(run("-j 1").status, 0) << "one after the other";
  write_jobs({job("1", {"export", "--certificate", pot, stl}),
              job("2", {"export", pot, folder.file("c.stl"), "--report",
                        folder.file("b.stl.certificate.json")})});
  EXPECT_EQ(run("-j 2").status, 2) << "a certificate";
}

TEST_F(Batch, RefusesOneOutputUnderTwoNames) {
  const std::string scene = sample("cylinder.scene.json");
  const auto jobs = [&](const std::string& first, const std::string& second) {
    write_jobs({job("1", {"throw", scene, "-o", first}), job("2", {"throw", scene, "-o", second})});
    return shell("cd " + folder.path().string() +
                 " && " CLAYSTACK_PROGRAM " batch -j 2 jobs.jsonl");
  };
  const Ran absolute = jobs("same.pot.json", folder.file("same.pot.json"));
  EXPECT_EQ(absolute.status, 2) << absolute.out;
  EXPECT_NE(absolute.err.find("written by 1 and 2"), std::string::npos) << absolute.err;
  std::filesystem::create_directory(folder.file("real"));
  std::filesystem::create_symlink("real", folder.file("link"));
  EXPECT_EQ(jobs("real/same.pot.json", "link/same.pot.json").status, 2);
  EXPECT_EQ(jobs("real/1.pot.json", "link/2.pot.json").status, 0);
}

TEST_F(Batch, WritesItsResultsToPipes) {
  write_jobs({thrown("a.pot.json")});
  const std::string batch = CLAYSTACK_PROGRAM " batch -q " + folder.file("jobs.jsonl") + " -o ";
  const Ran out = shell("timeout 60 " CLAYSTACK_PROGRAM " batch " + folder.file("jobs.jsonl") +
                        " -o /dev/stdout | cat");
  ASSERT_EQ(results_in(out.out).size(), 1u) << out.err;
  EXPECT_EQ(results_in(out.out).at("a.pot.json").at("status"), 0);
  const std::string pipe = folder.file("pipe");
  const Ran named = shell("mkfifo " + pipe + " && (timeout 60 cat " + pipe + " & timeout 60 " +
                          batch + pipe + "; wait)");
  EXPECT_EQ(results_in(named.out).size(), 1u) << named.err;
  EXPECT_EQ(shell(batch + "/dev/null").status, 0);
}

// Each job holds two pipes: with 40 descriptors far fewer than 40 jobs run at a time.
TEST_F(Batch, RunsFewerJobsAtATimeWhereTheSystemAllowsNoMore) {
  std::vector<nlohmann::json> jobs;
  for (int i = 0; i < 40; ++i)
    jobs.push_back(job(std::to_string(i), {"plan", sample("bowl.scene.json")}));
  write_jobs(jobs);
  const std::string batch =
      CLAYSTACK_PROGRAM " batch -q " + folder.file("jobs.jsonl") + " -j 40 -o ";
  const std::string results = folder.file("results.jsonl");
  const Ran ran = shell("ulimit -n 40; " + batch + results);
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(results_in(read_text(results)).size(), 40u);
  // With too few for one job it ends, with the reason.
  const Ran none = shell("ulimit -n 7; " + batch + folder.file("none.jsonl"));
  EXPECT_EQ(none.status, 3);
  EXPECT_NE(none.err.find("batch: could not make a pipe"), std::string::npos) << none.err;
}

// The batch is killed when the process of the job exists, but is not yet bound to it. `cat` ends
// with that process, which has inherited descriptor 9.
TEST_F(Batch, NoJobBeginsAfterItsEnd) {
  write_jobs({thrown("a.pot.json")});
  const std::string batch =
      "env ASAN_OPTIONS=verify_asan_link_order=0 CLAYSTACK_FAULT_ORPHAN=1 "
      "LD_PRELOAD=" CLAYSTACK_FAULT_SHIM " " CLAYSTACK_PROGRAM " batch -q " +
      folder.file("jobs.jsonl");
  const Ran ran = shell("(" + batch + "; echo status $? >&9) 9>&1 | cat");
  EXPECT_NE(ran.out.find("status 137"), std::string::npos) << ran.out << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pot.json")));
}

TEST_F(Batch, TheErrorOfAJobIsNoWarning) {
  // It warns of the clip path, and then cannot write the pot.
  write_text(folder.file("clipped.svg"),
             "<svg xmlns='http://www.w3.org/2000/svg'>"
             "<path clip-path='url(#c)' d='M 0 0 H 90 V 60 H 0 Z'/></svg>");
  std::filesystem::create_symlink("/dev/full", folder.file("full.pot.json"));
  write_jobs(
      {job("clipped", {"import", folder.file("clipped.svg"), "-o", folder.file("full.pot.json")})});
  const auto results = results_in(run("").out);
  const std::string error = results.at("clipped").value("error", "");
  EXPECT_EQ(error.find("warning:"), std::string::npos) << error;
  EXPECT_NE(error.find("full.pot.json: "), std::string::npos) << error;
}

TEST_F(Batch, RefusesAResultFileOfAnotherKind) {
  write_jobs({thrown("a.pot.json")});
  // With and without a line feed at the end, as JSON on one line and meshes have none.
  for (const std::string other : {"{\"other\": 1}\n", "{\"other\": 1}", "solid of bytes",
                                  "{\"schema\":\"claystack-scene-1\",\"lump\":{}}", "# Pots\n"}) {
    write_text(folder.file("results.jsonl"), other);
    const Ran ran = run("-o " + folder.file("results.jsonl"));
    EXPECT_EQ(ran.status, 2) << other;
    EXPECT_NE(ran.err.find("expected a result"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find("syntax"), std::string::npos) << ran.err;
    EXPECT_EQ(read_text(folder.file("results.jsonl")), other);
  }
}

}  // namespace
}  // namespace clay::test
