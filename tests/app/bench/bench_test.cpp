// The command `bench` as users run it.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace clay::test {
namespace {

TEST(Bench, ListsTheSectionsForAnUnknownName) {
  const auto run = claystack("bench --only tick,pots");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("found pots"), std::string::npos);
  EXPECT_NE(run.err.find("left_out"), std::string::npos);
}

TEST(Bench, RefusesAnUnwritableOutputBeforeMeasuring) {
  const ScratchFolder folder;
  write_text(folder.file("taken"), "");
  // A measurement would take seconds; the exit status alone cannot show that none was made, so no
  // output about it may appear.
  for (const std::string& option :
       {"--report " + folder.file("none/r.html"), "--csv " + folder.file("taken/csv")}) {
    const auto run = claystack("bench --quick --only tick " + option);
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_EQ(claystack("bench --quick --only tick --json --report -").status, 2);
  EXPECT_EQ(claystack("bench --extremes --only tick").status, 2);
}

TEST(Bench, FollowsTheRuleForExistingFilesBeforeMeasuring) {
  const ScratchFolder folder;
  write_text(folder.file("r.html"), "old");
  const std::string bench = "bench --quick --only tick ";
  for (const std::string& options :
       {"--no-overwrite --report " + folder.file("r.html"),
        "--no-overwrite --csv " + folder.path().string(), "--report " + folder.file("r.csv")}) {
    const auto run = claystack(bench + options);
    EXPECT_EQ(run.status, 2) << options << ": " << run.err;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_EQ(read_text(folder.file("r.html")), "old");
}

TEST(Bench, WritesTheTickSectionInEveryFormat) {
  const ScratchFolder folder;
  const auto run = claystack("bench --quick --only tick --json --report " + folder.file("r.html") +
                             " --csv " + folder.file("csv"));
  // 1 is allowed: a loaded machine may miss the required time.
  ASSERT_TRUE(run.status == 0 || run.status == 1) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("sound"), run.status == 0);
  for (const char* figure : {"n200_ns", "literal_n200_ns", "n1000000_ns"})
    EXPECT_GT(json.at("tick").at(figure).get<double>(), 0.0) << figure;
  for (const char* where : {"machine", "compiler", "command"}) EXPECT_TRUE(json.contains(where));
  EXPECT_EQ(shell("xmllint --noout --nonet " + folder.file("r.html")).status, 0);
  EXPECT_NE(read_text(folder.file("r.html")).find("bench --quick --only tick"), std::string::npos);
  for (const char* file : {"csv/tick_values.csv", "csv/tick_rings.csv", "csv/tick_rings_plot.csv"})
    EXPECT_TRUE(std::filesystem::exists(folder.file(file))) << file;
}

}  // namespace
}  // namespace clay::test
