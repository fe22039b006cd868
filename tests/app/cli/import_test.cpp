#include "claystack/export/formats.hpp"
#include "tests/export/solid/shapes.hpp"
#include "tests/support/run_program.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace clay::test {
namespace {

using testing::HasSubstr;

TEST(Import, MakesAPrintablePot) {
  const ScratchFolder folder;
  const std::string pot = folder.file("jug.pot.cbor"), stl = folder.file("jug.stl");
  const auto run = claystack("import --json " + sample("drawings/jug.svg") + " -o " + pot);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  EXPECT_EQ(json.at("axis"), "left");
  EXPECT_NEAR(json.at("axis_mm").get<double>(), 10.0, 1e-9);
  EXPECT_NEAR(json.at("height_mm").get<double>(), 172.0, 1e-9);
  const double drawn = json.at("drawn_mm3"), held = json.at("volume_mm3");
  EXPECT_NEAR(held / drawn, 1.0, 1e-9);

  ASSERT_EQ(claystack("export -q " + pot + " " + stl).status, 0);
  const auto check = claystack("check --json " + stl);
  ASSERT_EQ(check.status, 0) << check.out;

  // OpenSCAD revolves the same drawing, with its own chords for curves and circles: with 400
  // around, its volume is smaller by 1 - sin(2 pi/n) n/(2 pi) = 4e-5, and slightly more along the
  // curves.
  const std::string script = folder.file("jug.scad"), peer = folder.file("peer.stl");
  write_text(script, "rotate_extrude($fn = 400) translate([-10, 0]) import(\"" +
                         sample("drawings/jug.svg") + "\", $fn = 400);");
  ASSERT_EQ(shell("openscad -q -o " + peer + " " + script).status, 0);
  const double revolved = claystack("check --json " + peer).json().at("volume_mm3");
  EXPECT_NEAR(revolved / drawn, 1.0, 1e-3);
}

// 4000 lines over the full height: the hint of the error must not need memory for the square of
// their number, 128 MB.
TEST(Import, RefusesAZigzagInLittleMemory) {
  const ScratchFolder folder;
  std::string points;
  for (int i = 0; i < 4000; ++i)
    points += fmt::format("{},{} ", 10.0 + 1e-5 * i * i, i % 2 == 0 ? 0 : 60);
  write_text(folder.file("zigzag.svg"),
             R"(<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" )"
             R"(viewBox="0 0 200 200"><polyline fill="none" stroke="black" points=")" +
                 points + "\"/></svg>");
  const Ran run = claystack("import --memory 64MiB " + folder.file("zigzag.svg") + " -o " +
                            folder.file("a.pot.json"));
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the drawing is nearly symmetric"));
  EXPECT_LT(run.err.size(), 1000u);
}

/// A pot may have every density that a scene may have.
TEST(Import, TakesTheDensitiesOfScenes) {
  const ScratchFolder folder;
  const auto run_with = [&](const std::string& density) {
    return claystack("import " + sample("drawings/tumbler.csv") + " --density " + density + " -o " +
                     folder.file("a.pot.json"));
  };
  for (const char* density : {"0.1", "25"}) {
    const Ran run = run_with(density);
    EXPECT_EQ(run.status, 0) << run.err;
  }
  for (const char* density : {"0.0999", "25.001"}) {
    const Ran run = run_with(density);
    EXPECT_EQ(run.status, 2) << density;
    EXPECT_THAT(run.err, HasSubstr("0.1 to 25"));
  }
}

TEST(Import, BoundsTheTextThatItQuotes) {
  const ScratchFolder folder;
  write_text(folder.file("wide.csv"), std::string(1'000'000, 'x') + ",y\n1,2\n");
  const Ran run =
      claystack("import " + folder.file("wide.csv") + " -o " + folder.file("a.pot.json"));
  EXPECT_EQ(run.status, 2);
  EXPECT_LT(run.err.size(), 1000u);
}

TEST(Import, WarnsOfADrawingInAnotherUnit) {
  const ScratchFolder folder;
  const std::string drawing = folder.file("cup.csv"), pot = folder.file("cup.pot.json");
  write_text(drawing, "radius,height\n0.03,0\n0.04,0.1\n");  // metres
  const Ran run = claystack("import " + drawing + " -o " + pot);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("the pot is 0.1 mm high"), std::string::npos) << run.err;
  const Ran asked = claystack("import " + drawing + " --height 100 --wall 5 -o " + pot);
  EXPECT_EQ(asked.err.find("mm high;"), std::string::npos) << asked.err;
}

/// The wall leans by 79 degrees: 5.1 mm wide where it is cut level, and 5 mm farther out per mm of
/// height.
TEST(Import, WarnsOfRingsThatAreTooHighForAFlatWall) {
  const ScratchFolder folder;
  const std::string drawing = folder.file("dish.csv"), pot = folder.file("dish.pot.json");
  write_text(drawing, "radius,height\n10,0\n60,10\n");
  const std::string dish = "import " + drawing + " --wall 1 -o " + pot;
  const Ran high = claystack(dish + " --ring-height 2");
  EXPECT_EQ(high.status, 0) << high.err;
  EXPECT_THAT(high.err, HasSubstr("dish.csv: expected a pot in one piece, found rings "));
  EXPECT_THAT(high.err, HasSubstr("a flat wall needs lower rings (--ring-height)"));
  EXPECT_THAT(claystack(dish + " --ring-height 2 --json").json().at("warnings").dump(),
              HasSubstr("that do not touch"));
  const Ran low = claystack(dish + " --ring-height 0.5");
  EXPECT_EQ(low.status, 0) << low.err;
  EXPECT_EQ(low.err.find("do not touch"), std::string::npos) << low.err;
}

TEST(Import, AcceptsNamesInUpperCase) {
  const ScratchFolder folder;
  const std::string json = folder.file("JUG.POT.JSON"), cbor = folder.file("JUG.POT.CBOR");
  const std::string drawing = sample("drawings/jug.svg");
  for (const std::string& pot : {json, cbor}) {
    const Ran made = claystack("import " + drawing + " -o " + pot);
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(claystack("check " + pot).status, 0);
  }
  EXPECT_EQ(read_text(json).front(), '{');
  EXPECT_NE(read_text(cbor).front(), '{');
  EXPECT_EQ(claystack("export -q " + json + " " + folder.file("again.Pot.Cbor")).status, 0);
}

TEST(Import, ShowsWhatTheReaderPassedOver) {
  const ScratchFolder folder;
  const std::string pot = folder.file("b.pot.json"), obj = folder.file("b.obj");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + obj).status, 0);
  write_text(obj, read_text(obj) + "end of file\n");
  const Ran made = claystack("import " + obj + " -o " + folder.file("again.pot.json"));
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("1 line after the mesh was not read"));
  const auto notes = claystack("check --json " + obj).json().at("notes");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].get<std::string>(), HasSubstr("1 line after the mesh was not read"));
}

// Rounding in a rotation tilts horizontals by 1e-14 mm, rounding in a file by 1e-5.
TEST(Import, NearlyLevelLinesAreLevel) {
  const ScratchFolder folder;
  const std::string svg = folder.file("cup.svg"), pot = folder.file("cup.pot.json");
  const auto imported = [&](const std::string& transform, const std::string& floor) {
    write_text(svg,
               "<svg xmlns='http://www.w3.org/2000/svg' width='200mm' height='300mm' "
               "viewBox='0 0 200 300'><path transform='" +
                   transform + "' d='M0,100 H40 V0 H34 V94 L0," + floor + " Z'/></svg>");
    const Ran made = claystack("import --json --axis left " + svg + " -o " + pot);
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_EQ(made.err, "");
    return made.json();
  };
  for (const char* transform : {"scale(2)", "rotate(360) scale(2)", "rotate(360, 30, 70) scale(2)",
                                "rotate(90) rotate(-90) scale(2)"})
    for (const char* floor : {"94", "94.00001", "93.99999"}) {
      const auto json = imported(transform, floor);
      EXPECT_EQ(json.at("rings"), 300) << transform << floor;
      EXPECT_LT(json.at("deviation_mm"), 1e-3);
      EXPECT_NEAR(json.at("height_mm").get<double>(), 200.0, 1e-9);
      EXPECT_NEAR(json.at("volume_mm3").get<double>(), 1'290'214.4, 1.0);
    }
}

TEST(Import, SampleDrawingsAreTrueAndPassStoneware) {
  const ScratchFolder folder;
  for (const char* drawing : {"jug.svg", "bowl.dxf", "tumbler.csv --wall 6"}) {
    const std::string pot = folder.file("a.pot.cbor"), stl = folder.file("a.stl");
    const auto run =
        claystack("import --json " + sample(std::string("drawings/") + drawing) + " -o " + pot);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_LE(run.json().at("deviation_mm").get<double>(), 0.02) << drawing;
    EXPECT_EQ(run.json().at("deviation_at_mm").size(), 2u);
    const auto done = claystack("export " + pot + " " + stl + " --process stoneware");
    EXPECT_EQ(done.status, 0) << drawing << done.out << done.err;
    EXPECT_EQ(claystack("check -q " + pot + " --process stoneware").status, 0) << drawing;
  }
}

TEST(Import, ReadsEndingsInCapitalLetters) {
  const ScratchFolder folder;
  const std::string drawing = folder.file("JUG.SVG"), pot = folder.file("jug.pot.json");
  write_text(drawing, read_text(sample("drawings/jug.svg")));
  const Ran run = claystack("import -q " + drawing + " -o " + pot);
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(Import, ReadsADrawingOnStandardInput) {
  for (const char* drawing : {"jug.svg", "bowl.dxf", "tumbler.csv"}) {
    const std::string file = sample(std::string("drawings/") + drawing);
    const Ran named = claystack("import -q " + file + " -o -");
    const Ran streamed = claystack("import -q - -o - < " + file);
    ASSERT_EQ(streamed.status, 0) << streamed.err;
    EXPECT_EQ(streamed.out, named.out) << drawing;
  }
  const ScratchFolder folder;
  const std::string mesh = folder.file("a.stl");
  write_text(mesh, "solid a\nendsolid a\n");
  const Ran refused = claystack("import - -o - < " + mesh);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("-: expected a drawing (SVG, DXF or CSV) on standard input, "
                                     "found an STL mesh in text"));
}

TEST(Export, NotesThePotInA3mf) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json"), package = folder.file("a.3mf");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + package + " --shrinkage 20%").status, 0);
  const Ran run = claystack("export " + package + " " + folder.file("b.stl"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("note: " + package +
                         ": the pot inside is used; it has no shrinkage and no finish: "),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find(", 1.25 and 1.25 times as much"), std::string::npos) << run.out;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(claystack("check " + package).out.find("the pot inside has no shrinkage and no finish"),
            std::string::npos);
}

TEST(Import, PointsToThePotInA3mf) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json"), again = folder.file("b.pot.json");
  ASSERT_EQ(claystack("import -q " + sample("drawings/jug.svg") + " -o " + pot).status, 0);
  for (const std::string name : {"a.3mf", "a.stl"}) {
    const std::string mesh = folder.file(name);
    ASSERT_EQ(claystack("export -q " + pot + " " + mesh).status, 0);
    const auto read = claystack("import " + mesh + " -o " + again);
    EXPECT_EQ(read.status, 0) << read.err;
    EXPECT_EQ(read.out.find("carries its exact pot") != std::string::npos, name == "a.3mf")
        << read.out;
  }
}

TEST(Import, CountsTheBodiesOfAMeshOfTwoCups) {
  const ScratchFolder folder;
  const std::string stl = folder.file("two.stl"), pot = folder.file("a.pot.json");
  const solid::TriangleMesh cup =
      solid::revolve({{{{0, 0}, {30, 0}, {35, 80}, {32, 80}, {27, 4}, {0, 4}}}}, 48);
  const auto imported = [&](const solid::TriangleMesh& mesh) {
    write_text(stl, solid::encode_stl_binary(mesh));
    return claystack("import " + stl + " -o " + pot);
  };
  const auto two =
      imported(solid::shapes::together(cup, solid::shapes::moved(cup, {100.0, 0.0, 0.0})));
  EXPECT_EQ(two.status, 2);
  EXPECT_THAT(two.err, HasSubstr("two.stl: the mesh has 2 separate bodies: keep one; "));
  EXPECT_EQ(imported(cup).status, 0);
}

TEST(Import, ReportsTheThinnestWallOfAHollowedOutline) {
  const ScratchFolder folder;
  const std::string dish = folder.file("dish.csv"), pot = folder.file("dish.pot.json");
  write_text(dish, "radius_mm,height_mm\n30,0\n80,10\n80,15\n");
  const Ran leaning = claystack("import --json --wall 3 " + dish + " -o " + pot);
  ASSERT_EQ(leaning.status, 0) << leaning.err;
  EXPECT_NEAR(leaning.json().at("thinnest_wall_mm").get<double>(), 3.0, 1e-3);
  EXPECT_EQ(leaning.err, "");
  EXPECT_THAT(claystack("import --wall 3 " + dish + " -o " + pot).out,
              HasSubstr("thinnest wall as drawn: 3.00 mm"));
  const Ran solid = claystack("import --json " + dish + " -o " + pot);
  EXPECT_TRUE(solid.json().at("thinnest_wall_mm").is_null());
}

/// The facets of an export take some hundredths of a millimetre from a curved wall.
TEST(Import, AWallOfALimitPassesIt) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json"), tumbler = sample("drawings/tumbler.csv");
  for (const char* mm : {"3", "5"}) {
    ASSERT_EQ(claystack("import " + tumbler + " --wall " + mm + " -o " + pot).status, 0);
    const Ran check = claystack("check " + pot + " --min-wall " + mm);
    EXPECT_EQ(check.status, 0) << check.out;
  }
}

TEST(Import, StatesThatAnOutlineWithoutAWallIsSolid) {
  const ScratchFolder folder;
  const std::string pot = folder.file("a.pot.json");
  const std::string import = "import " + sample("drawings/tumbler.csv") + " -o " + pot;
  EXPECT_THAT(claystack(import).out, HasSubstr("solid: the drawing shows no inside (--wall LENGTH "
                                               "makes one)"));
  EXPECT_EQ(claystack(import + " --wall 4").out.find("solid:"), std::string::npos);
}

/// Its outside rises by 1 mm over 2 mm, so the level rim ends in an edge of 27 degrees.
TEST(Import, WarnsOfASharpRim) {
  const ScratchFolder folder;
  const std::string dish = folder.file("dish.csv"), pot = folder.file("dish.pot.json");
  write_text(dish, "radius_mm,height_mm\n30,0\n40,10\n80,30\n");
  const Ran flat = claystack("import --wall 3 " + dish + " -o " + pot);
  EXPECT_EQ(flat.status, 0);
  EXPECT_THAT(flat.err,
              HasSubstr("dish.csv: the wall leans outward by 63 degrees at the rim, which "
                        "is cut level, so its edge is sharp"));
  write_text(dish, "radius_mm,height_mm\n30,0\n60,30\n");
  EXPECT_EQ(claystack("import --wall 3 " + dish + " -o " + pot).err, "");
}

// A frustum with radii of 30 and 40 mm; both of its ends could be the axis.
TEST(Import, TakesTheRightEndAsTheAxis) {
  const ScratchFolder folder;
  const std::string svg = folder.file("lump.svg"), pot = folder.file("lump.pot.json");
  write_text(svg,
             "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' "
             "viewBox='0 0 100 100'><path d='M20,10 H50 V60 H10 Z'/></svg>");
  const std::string line = "import --axis right " + svg + " -o " + pot;
  const Ran made = claystack(line + " --json");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.json().at("axis"), "right");
  EXPECT_NEAR(made.json().at("axis_mm").get<double>(), 50.0, 1e-9);
  EXPECT_NEAR(made.json().at("drawn_mm3").get<double>(),
              std::numbers::pi * 50.0 / 3.0 * (1600.0 + 1200.0 + 900.0), 1e-3);
  EXPECT_THAT(claystack(line).out, HasSubstr("axis at x = 50.000 mm of the drawing (its right"));
}

TEST(Import, ReportsErrorsAndLeavesNoFile) {
  const ScratchFolder folder;
  const std::string pot = folder.file("x.pot.json"), drawing = folder.file("x.csv");
  write_text(drawing, "10,0\n10,ten\n");
  const auto broken = claystack("import " + drawing + " -o " + pot);
  EXPECT_EQ(broken.status, 2);
  EXPECT_THAT(broken.err, HasSubstr("x.csv:2: expected a radius and a height in mm"));
  EXPECT_EQ(claystack("import " + folder.file("none.svg") + " -o " + pot).status, 3);
  write_text(drawing, "10,0\n10,20\n");
  const auto axis = claystack("import " + drawing + " -o " + pot + " --axis up");
  EXPECT_EQ(axis.status, 2);
  EXPECT_THAT(axis.err, HasSubstr("--axis: expected left, middle, right or a place in mm, found"));
  EXPECT_EQ(claystack("import " + drawing + " -o " + drawing).status, 2);
  const auto mesh = claystack("import " + drawing + " -o " + folder.file("x.stl"));
  EXPECT_EQ(mesh.status, 2);
  EXPECT_THAT(mesh.err, HasSubstr("x.stl: expected a name that ends in .pot.json or .pot.cbor"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("x.stl")));
  EXPECT_FALSE(std::filesystem::exists(pot));
  EXPECT_EQ(claystack("import -q " + drawing + " -o " + pot).status, 0);
  EXPECT_TRUE(std::filesystem::exists(pot));
}

}  // namespace
}  // namespace clay::test
