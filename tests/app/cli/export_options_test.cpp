// Requirements, reports and refusals of `claystack export`.

#include "tests/app/cli/thrown_bowl.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

namespace clay::test {
namespace {

class ExportOptions : public ExportedBowl {};

TEST_F(ExportOptions, ThinWallExitsOneWithTheLimitAndItsSource) {
  const Ran demand = run("--min-wall 40");
  EXPECT_EQ(demand.status, 1);
  EXPECT_NE(demand.err.find("expected at least 40.000 mm (--min-wall)"), std::string::npos)
      << demand.err;
  EXPECT_TRUE(std::filesystem::exists(stl));
  const Ran process = run("--process " + sample("workshop.process.json"));
  EXPECT_EQ(process.status, 1);
  EXPECT_NE(process.err.find("two beads"), std::string::npos) << process.err;
  EXPECT_EQ(run("--process porcelain").status, 0);
}

TEST_F(ExportOptions, ReportsUnknownProcessesBeforeWriting) {
  const Ran unknown = run("--process bronze");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("earthenware"), std::string::npos) << unknown.err;
  EXPECT_EQ(run("--process " + folder.file("none.json")).status, 3);
  EXPECT_EQ(run("--process " + pot).status, 2);
  EXPECT_FALSE(std::filesystem::exists(stl));
}

TEST_F(ExportOptions, TheReportEqualsTheJsonOutput) {
  const std::string report = folder.file("report.json");
  const Ran printed = run("--json --report " + report);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_EQ(printed.out, read_text(report));
}

TEST_F(ExportOptions, TheReportShowsSolidClay) {
  const std::string page = folder.file("r.html"), table = folder.file("t.csv");
  write_text(table, "height_mm,radius_mm\n0,30\n40,30\n");
  ASSERT_EQ(claystack("import -q " + table + " -o " + pot).status, 0);
  ASSERT_EQ(run("-q --report " + page).status, 0);
  const std::string html = read_text(page);
  EXPECT_EQ(html.find("inf mm"), std::string::npos);
  EXPECT_EQ(html.find("nan mm"), std::string::npos);
  EXPECT_NE(html.find("10.0 mm or more"), std::string::npos) << "the top of the scale";
}

TEST_F(ExportOptions, MeasuresSkippedStagesOnRequest) {
  const auto plain = run("--json").json(), measured = run("--json --measure-left-out").json();
  for (const auto& item : plain.at("left_out")) EXPECT_FALSE(item.contains("saved_s"));
  bool checked = false;
  for (const auto& item : measured.at("left_out")) {
    if (item.at("what") != "full verification") continue;
    EXPECT_GT(item.at("saved_s"), 0.0);
    checked = true;
  }
  EXPECT_TRUE(checked);
}

TEST_F(ExportOptions, RefusesOptionsWithoutEffect) {
  for (const char* option : {"--ascii", "--normals", "--certificate", "--precision 0.001",
                             "--min-wall 3", "--process sla"}) {
    const Ran nothing =
        claystack("export " + pot + " " + folder.file("section.svg") + " " + option);
    EXPECT_EQ(nothing.status, 2) << option;
    EXPECT_NE(nothing.err.find("among the files to write"), std::string::npos) << nothing.err;
  }
}

TEST_F(ExportOptions, RefusesOptionsOfTheSolidForCopiesOfThePot) {
  const std::string copy = folder.file("copy.pot.cbor"), report = folder.file("r.html");
  for (const char* option :
       {"--segments 5", "--drain 3", "--lip-fillet 2", "--verify full", "--verify margins",
        "--max-triangles 10", "--smooth none", "--smooth fair", "--tolerance 9mm",
        "--smooth-length 9", "--smooth-length tool", "--pieces", "--measure-left-out"}) {
    for (const std::string& more : {std::string(), " --report " + report}) {
      const Ran nothing = claystack("export " + pot + " " + copy + " " + option + more);
      EXPECT_EQ(nothing.status, 2) << option;
      EXPECT_NE(nothing.err.find(": expected a mesh"), std::string::npos) << nothing.err;
      EXPECT_NE(nothing.err.find(" among the files to write"), std::string::npos) << nothing.err;
      EXPECT_FALSE(std::filesystem::exists(copy)) << option;
    }
  }
  EXPECT_EQ(claystack("export " + pot + " " + copy).status, 0);
}

TEST_F(ExportOptions, RefusesOptionsOfFacetsForFilesWithoutFacets) {
  for (const char* name : {"section.svg", "solid.step", "walls.csv"}) {
    const std::string file = folder.file(name);
    for (const char* option : {"--segments 12", "--max-triangles 1000", "--verify full"}) {
      const Ran refused = claystack("export " + pot + " " + file + " " + option);
      EXPECT_EQ(refused.status, 2) << option;
      EXPECT_NE(refused.err.find(": expected a mesh among the files to write, found none"),
                std::string::npos)
          << refused.err;
      EXPECT_FALSE(std::filesystem::exists(file));
    }
  }
  EXPECT_EQ(run("--segments 12 " + folder.file("solid.step")).status, 0);
}

TEST_F(ExportOptions, AGlazeAloneFinishesAPot) {
  // The glazed pot has the requested capacity, without a shrinkage and with one of almost 0.
  for (const char* shrinkage : {"", " --shrinkage 0.0001%"}) {
    const Ran scaled =
        run("--json --holds 100ml --fired --glaze-allowance 0.5" + std::string(shrinkage));
    ASSERT_EQ(scaled.status, 0) << scaled.err;
    const auto maker = scaled.json().at("maker");
    EXPECT_NEAR(maker.at("glazed").at("capacity_ml"), 100.0, 1e-3) << shrinkage;
    EXPECT_GT(maker.at("thrown").at("capacity_ml"), 100.5) << shrinkage;
  }
}

TEST_F(ExportOptions, WritesNothingIfOneFileCannotBeWritten) {
  const Ran report = run("--report " + folder.file("none/report.json"));
  EXPECT_EQ(report.status, 3) << report.err;
  std::filesystem::create_directory(stl + ".certificate.json");
  const Ran certificate = run("--certificate");
  EXPECT_EQ(certificate.status, 3) << certificate.err;
  EXPECT_FALSE(std::filesystem::exists(stl));
}

TEST_F(ExportOptions, ErrorsOfTheRequestNameTheOptionAndNotThePot) {
  for (const auto& [options, says] :
       {std::pair("--shrinkage 12% --drying-shrinkage 13%",
                  "claystack: --drying-shrinkage: expected at most --shrinkage, 12%, found 13%"),
        {"--smooth none --smooth-length 9",
         "claystack: --smooth-length: expected --smooth fair, found none"},
        {"--fired --height 100",
         "claystack: --fired: expected --shrinkage above 0% or --glaze-allowance too"},
        {"--height 120 --diameter 60 --holds 350ml",
         "claystack: --holds, --height, --diameter: expected one figure"}}) {
    const Ran refused = run(options);
    EXPECT_EQ(refused.status, 2) << options;
    EXPECT_NE(refused.err.find(says), std::string::npos) << refused.err;
  }
}

TEST_F(ExportOptions, VerboseNamesTheThinnestPlaceOfWallAndLip) {
  const auto parts = claystack("check --json " + pot).json().at("wall_parts");
  ASSERT_EQ(parts.size(), 2u);
  std::ostringstream text;
  text << "thinnest places: wall " << std::fixed << std::setprecision(3)
       << parts[0].at("min_wall_mm").get<double>() << " mm at a height of " << std::setprecision(1)
       << parts[0].at("at_mm").at(1).get<double>() << " mm, lip ";
  const Ran verbose = run("-v");
  EXPECT_NE(verbose.out.find(text.str()), std::string::npos) << text.str() << verbose.out;
  EXPECT_EQ(run("").out.find("thinnest places"), std::string::npos);
}

TEST_F(ExportOptions, TakesFilesWithoutAndWithTheirOption) {
  const std::string obj = folder.file("bowl.obj"), ply = folder.file("bowl.ply");
  ASSERT_EQ(run("").status, 0);
  const std::string expected = read_text(stl);
  std::filesystem::remove(stl);
  EXPECT_EQ(claystack("export -o " + stl + ' ' + pot + ' ' + obj + " --output " + ply).status, 0);
  EXPECT_EQ(read_text(stl), expected);
  EXPECT_TRUE(std::filesystem::exists(obj));
  EXPECT_TRUE(std::filesystem::exists(ply));
  const Ran none = claystack("export " + pot);
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("expected a file to write, such as pot.3mf, found none"),
            std::string::npos)
      << none.err;
}

TEST_F(ExportOptions, WarnsOfLargeFilesBeforeTheyAreWritten) {
  EXPECT_EQ(run("").err, "");
  const Ran large = run("--smooth none --segments 600");
  EXPECT_EQ(large.status, 0);
  const auto size = static_cast<double>(std::filesystem::file_size(stl));
  ASSERT_GT(size, 50e6);
  const std::string megabytes = std::to_string(std::lround(1e-6 * size));
  EXPECT_NE(large.err.find(stl + ": about " + megabytes + " MB, "), std::string::npos) << large.err;
  EXPECT_NE(large.err.find("--smooth fair or --max-triangles makes it smaller"), std::string::npos);
}

}  // namespace
}  // namespace clay::test
