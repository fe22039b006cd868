// Files made from the section: STEP, drawings and the page of the report; and pots scaled to a
// goal.

#include "tests/app/cli/thrown_bowl.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <string>

namespace clay::test {
namespace {

class SectionFiles : public ThrownBowl {
 protected:
  Ran run(const std::string& rest) const { return claystack("export " + pot + " " + rest); }
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++times;
  return times;
}

/// The volume that PrusaSlicer, with Open CASCADE, finds in a STEP file; 0 if it is not closed.
double prusa_volume(const std::string& step) {
  const std::string info = shell("prusa-slicer --info " + step).out;
  const auto at = info.find("volume = ");
  if (at == info.npos || info.find("manifold = yes") == info.npos) return 0.0;
  return std::stod(info.substr(at + 9));
}

TEST_F(SectionFiles, AStepFileOpensInPrusaSlicer) {
  const std::string spline = folder.file("s.step"), lines = folder.file("l.stp");
  const auto json = run("--json " + spline).json();
  const auto& file = json.at("files").at(0);
  const double volume = json.at("counted_volume_mm3").get<double>();
  EXPECT_LE(file.at("faces").get<int>(), 20);
  EXPECT_LE(file.at("bytes").get<int>(), 100'000);
  EXPECT_LE(file.at("max_error_mm").get<double>(), 0.02);
  EXPECT_LE(file.at("volume_error_relative").get<double>(), 1e-9);
  EXPECT_EQ(file.at("walls"), "spline");
  const auto exact = run("--json --step lines " + lines).json().at("files").at(0);
  EXPECT_LE(exact.at("max_error_mm").get<double>(), 1e-8);
  EXPECT_LE(exact.at("volume_error_relative").get<double>(), 1e-9);
  EXPECT_NEAR(prusa_volume(spline) / volume, 1.0, 1e-3);
  EXPECT_NEAR(prusa_volume(lines) / volume, 1.0, 1e-3);
  // Without a wall it is another solid, or none.
  std::string text = read_text(lines);
  const auto faces = text.find("CLOSED_SHELL('',(") + 17;
  text.erase(faces, text.find(',', text.find(',', faces) + 1) + 1 - faces);
  write_text(lines, text);
  EXPECT_GT(std::abs(prusa_volume(lines) / volume - 1.0), 1e-3);
}

TEST_F(SectionFiles, StepIsForStandingPotsAndItsOption) {
  const Ran alone = run("--step lines " + folder.file("a.stl"));
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.err.find("--step: expected a .step"), std::string::npos) << alone.err;
  const Ran unknown = run(folder.file("a.png"));
  EXPECT_NE(unknown.err.find(".step or .stp for the solid for CAD, .svg, .dxf or .pdf for the"),
            std::string::npos)
      << unknown.err;
}

#ifdef CLAYSTACK_DRAWINGS
TEST_F(SectionFiles, DrawingsComeBackAsThePot) {
  const auto exported = run("--json --shrinkage 10% " + folder.file("d.dxf") + " " +
                            folder.file("d.svg") + " " + folder.file("d.stl"))
                            .json();
  const double volume = exported.at("volume_mm3").get<double>();
  for (const char* name : {"d.dxf", "d.svg"}) {
    const std::string again = folder.file("again.pot.json");
    const Ran read = claystack("import -q --layer section " + folder.file(name) + " -o " + again);
    ASSERT_EQ(read.status, 0) << read.err;
    const auto json = claystack("export --json " + again + " " + folder.file("again.stl")).json();
    EXPECT_NEAR(json.at("volume_mm3").get<double>() / volume, 1.0, 1e-5) << name;
    EXPECT_NEAR(json.at("height_mm").get<double>(), exported.at("height_mm").get<double>(), 1e-3);
    EXPECT_NEAR(json.at("diameter_mm").get<double>(), exported.at("diameter_mm").get<double>(),
                0.05);
    std::filesystem::remove(again);
  }
}
#endif

TEST_F(SectionFiles, TheDrawingIsASoundSvgAndPdf) {
  const std::string svg = folder.file("d.svg"), pdf = folder.file("d.pdf");
  ASSERT_EQ(run(svg + " " + pdf).status, 0);
  EXPECT_EQ(shell("rsvg-convert " + svg + " -o " + folder.file("d.png")).status, 0);
  EXPECT_EQ(shell("xmllint --noout " + svg).status, 0);
  EXPECT_EQ(read_text(pdf).substr(0, 5), "%PDF-");
}

TEST_F(SectionFiles, TheReportIsOnePage) {
  const std::string page = folder.file("r.html");
  const Ran made =
      run(folder.file("a.stl") + " --shrinkage 12% --process stoneware --report " + page);
  ASSERT_LE(made.status, 1) << made.err;
  const std::string html = read_text(page);
  for (const char* part :
       {"<!DOCTYPE html>", ">wet<", "fired", "centre of gravity", "tips at",
        "wall of the round section", "steepest overhang", "distance from the round solid",
        "Left out", "Time", "closed and embedded", "</html>"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  // The report and the text agree on the distance of the facets from the pot.
  const std::string within = "within ", of = " of the round solid";
  const std::size_t from = made.out.find(within) + within.size(), to = made.out.find(of);
  ASSERT_NE(to, std::string::npos) << made.out;
  EXPECT_NE(html.find(">" + made.out.substr(from, to - from) + "<"), std::string::npos) << made.out;
  // Nothing is fetched from elsewhere.
  for (const char* part : {"src=\"http", "href=", "@import", "url("})
    EXPECT_EQ(html.find(part), std::string::npos) << part;
  for (const char* element : {"table", "figure", "svg", "div"})
    EXPECT_EQ(count(html, "<" + std::string(element)), count(html, "</" + std::string(element)))
        << element;
}

TEST_F(SectionFiles, ReportLabelsItsFigures) {
  const std::string page = folder.file("r.html");
  const auto html = [&](const std::string& options) {
    EXPECT_LE(run(folder.file("a.stl") + " " + options + " --report " + page).status, 1);
    return read_text(page);
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != text.npos;
  };
  const std::string plain = html("");
  EXPECT_TRUE(has(plain, "o limits were set.") && !has(plain, "all limits met"));
  EXPECT_TRUE(has(plain, "capacity to the fill line, 10 mm below the brim<"));
  EXPECT_TRUE(has(plain, ">Balance of the wet pot<"));
  EXPECT_FALSE(has(plain, "no bed size"));
  EXPECT_TRUE(has(html("--min-wall 0.1"), "; all limits met."));
  const std::string fired = html("--shrinkage 12% --fill-line 7 --process stoneware");
  EXPECT_TRUE(has(fired, "capacity to the fill line, 7 mm below the brim of the fired pot<"));
  EXPECT_TRUE(has(fired, ">Balance of the fired pot<"));
  for (const char* shrinkage : {"", " --shrinkage 12%"})
    EXPECT_TRUE(has(html("--glaze-allowance 0.5" + std::string(shrinkage)),
                    "capacity to the fill line, 10 mm below the brim of the glazed pot<"))
        << shrinkage;
  EXPECT_TRUE(has(fired, "not checked: no bed size is known for Stoneware"));
  EXPECT_FALSE(has(fired, ">fits Stoneware<"));
}

TEST_F(SectionFiles, TheReportHasTheBytesOfEachFile) {
  const auto files = run("--json " + folder.file("a.svg") + " " + folder.file("a.dxf") + " " +
                         folder.file("a.pdf") + " " + folder.file("a.csv"))
                         .json()
                         .at("files");
  ASSERT_EQ(files.size(), 4u);
  for (const auto& file : files)
    EXPECT_EQ(file.at("bytes"), std::filesystem::file_size(file.at("path").get<std::string>()));
}

TEST_F(SectionFiles, TheReportConformsToItsSchema) {
  const Json schema = load_schema("report");
  const auto check = [&](const std::string& rest) {
    const Ran made = run("--json " + rest);
    EXPECT_LE(made.status, 1) << made.err;
    EXPECT_EQ(violation(schema, Json::parse(made.out)), "") << rest;
  };
  const std::string stl = folder.file("a.stl");
  check(stl);
  check(folder.file("a.svg"));
  check(folder.file("copy.pot.json") + " --precision 0.01");
  check(stl + " " + folder.file("a.step") + " " + folder.file("a.pdf") + " " +
        folder.file("a.csv") + " " + folder.file("a.ply") +
        " --process porcelain --shrinkage 12% --lip-fillet 0.5 --verify full --min-wall 40");
  check(stl + " --smooth exact --measure-left-out");
  check(stl + " --process " + sample("workshop.process.json"));
  pot = folder.file("fallen.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("collapse.scene.json") + " -o " + pot).status, 0);
  check(stl + " " + folder.file("a.svg"));
}

TEST_F(SectionFiles, ScalesAPotToACapacityUnderItsGlaze) {
  const std::string page = folder.file("r.html"), drawing = folder.file("a.svg");
  const std::string goal = " --holds 12OZ --fired --shrinkage '12 %' --glaze-allowance 1 ";
  const Ran made =
      run("--json" + goal + folder.file("a.stl") + " " + drawing + " --report " + page);
  ASSERT_EQ(made.status, 0) << made.err;
  const auto json = made.json();
  EXPECT_EQ(violation(load_schema("report"), Json::parse(made.out)), "");
  constexpr double kHoldsMl = 12.0 * 29.5735295625;  // of the US
  EXPECT_NEAR(json.at("maker").at("glazed").at("capacity_ml").get<double>(), kHoldsMl, 1e-3);
  EXPECT_GT(json.at("maker").at("fired").at("capacity_ml").get<double>(), kHoldsMl + 5.0);
  EXPECT_EQ(json.at("goal").at("state"), "glazed");
  EXPECT_NEAR(json.at("goal").at("holds_ml").get<double>(), kHoldsMl, 1e-9);
  for (const std::string& text : {read_text(page), read_text(drawing)})
    for (const char* part : {"fired and glazed", "12 % of each length", "6 %",
                             "20 % of the wet weight", "9 % of the dry weight", "g/cm3"})
      EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST_F(SectionFiles, StatesNoCapacityOfATube) {
  const std::string drawing = folder.file("tube.svg"), tube = folder.file("tube.pot.json");
  write_text(drawing, R"(<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="80mm" )"
                      R"(viewBox="0 0 80 80"><rect x="30" y="10" width="10" height="60"/></svg>)");
  ASSERT_EQ(claystack("import -q --axis 0 " + drawing + " -o " + tube).status, 0);
  const std::string page = folder.file("tube.html");
  const Ran made =
      claystack("export --json --report " + page + " " + tube + " " + folder.file("tube.stl"));
  const auto json = made.json();
  EXPECT_EQ(violation(load_schema("report"), Json::parse(made.out)), "");
  EXPECT_EQ(json.at("maker").at("no_capacity"), "no floor under an open bore");
  for (const char* none : {"capacity_ml", "to_line_ml"})
    EXPECT_TRUE(json.at("maker").at("thrown").at(none).is_null()) << none;
  EXPECT_EQ(read_text(page).find("capacity to the brim"), std::string::npos);
  const Ran table = claystack("export " + tube + " " + folder.file("again.stl"));
  EXPECT_NE(table.out.find("none: no floor under an open bore"), std::string::npos) << table.out;
}

TEST_F(SectionFiles, StatesOneMinimumWall) {
  // The files have different walls, because they are rounded differently.
  const std::string files = folder.file("a.stl") + " " + folder.file("a.drc");
  const auto walls = run("--json " + files).json();
  double thinnest = 1e9;
  for (const auto& file : walls.at("files"))
    thinnest = std::min(thinnest, file.at("wall_mm").at(0).get<double>());
  EXPECT_EQ(walls.at("min_wall_mm").get<double>(), thinnest);
}

TEST_F(SectionFiles, ScalesAPotToACapacity) {
  const std::string stl = folder.file("a.stl"), copy = folder.file("copy.pot.json");
  const auto json = run("--json --holds 35cl --fired --shrinkage 12% " + stl + " " + copy).json();
  EXPECT_NEAR(json.at("maker").at("fired").at("capacity_ml").get<double>(), 350.0, 1e-3);
  // The copy of the pot among the files is the scaled one.
  const auto again = claystack("export --json --shrinkage 12% " + copy + " " + stl).json();
  EXPECT_EQ(again.at("maker"), json.at("maker"));
  const Ran thin = run("--height 20 --min-wall 3 " + folder.file("thin.stl"));
  EXPECT_EQ(thin.status, 1);
  EXPECT_NE(thin.err.find("thin wall"), std::string::npos) << thin.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("thin.stl")));
  const auto pound = run("--json --weighs 1lb " + stl).json();
  const auto ounces = run("--json --weighs 16oz " + stl).json();
  EXPECT_NEAR(pound.at("maker").at("thrown").at("weight_g").get<double>(), 453.59237, 1e-3);
  EXPECT_EQ(pound.at("maker"), ounces.at("maker"));
  for (const char* bad : {"--holds 5x", "--holds 0", "--fired", "--holds 350 --weighs 400"})
    EXPECT_EQ(run(stl + " " + bad).status, 2) << bad;
}

}  // namespace
}  // namespace clay::test
