#include "claystack/export/walls.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <string>

namespace clay::solid {
namespace {

TEST(ProcessLimits, EveryFigureHasASourceAndASize) {
  for (const std::string_view name : kProcessNames) {
    const auto process = process_named(name);
    ASSERT_TRUE(process);
    EXPECT_EQ(process->name, name);
    ASSERT_FALSE(process->walls.empty());
    for (const WallLimit& wall : process->walls) {
      EXPECT_GT(wall.min_wall_mm, 0.0);
      EXPECT_GT(wall.source.size(), 10u);
    }
  }
  EXPECT_EQ(process_named("FDM").value().name, "fdm");
  EXPECT_FALSE(process_named("xfdm"));
  const auto unknown = process_named("bronze");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("porcelain"), std::string::npos);
}

TEST(ProcessLimits, WallsGrowWithTheObject) {
  const ProcessLimits sla = process_named("sla").value();
  EXPECT_EQ(sla.wall_for(150.0).min_wall_mm, 1.0);
  EXPECT_EQ(sla.wall_for(200.0).min_wall_mm, 1.0);
  EXPECT_EQ(sla.wall_for(200.4).min_wall_mm, 2.0);
  EXPECT_EQ(sla.wall_for(1e6).min_wall_mm, 3.0);
}

/// A cylinder drawn at the limits, 60 mm wide and 80 mm high: a revolve of n facets that has its
/// volume is wider by the factor sqrt((2 pi / n) / sin(2 pi / n)), here 60.037 mm.
TEST(ProcessLimits, APotDrawnAtALimitOfSizePassesWithItsFacets) {
  const double angle = 2.0 * std::numbers::pi / 72.0;
  const double wide = 60.0 * std::sqrt(angle / std::sin(angle));
  ASSERT_GT(wide, 60.03);
  const SizeLimit kiln{60.0, 60.0, 80.0, "our kiln"};
  EXPECT_TRUE(kiln.fits({wide, wide, 80.0}));
  EXPECT_FALSE(kiln.fits({60.2, 60.0, 80.0}));
  EXPECT_FALSE(kiln.fits({60.0, 60.2, 80.0}));
  EXPECT_FALSE(kiln.fits({60.0, 60.0, 80.2}));
  const ProcessLimits sla = process_named("sla").value();
  EXPECT_EQ(sla.wall_for(size_sum_mm({wide, wide, 80.0})).min_wall_mm, 1.0);
}

TEST(ProcessLimits, MessagesHaveTheTitleOfTheProcess) {
  EXPECT_EQ(process_title("sla"), "SLA (resin)");
  EXPECT_EQ(process_title("earthenware"), "Earthenware");
  EXPECT_EQ(process_title("my kiln"), "my kiln");
  const ProcessLimits fdm = process_named("fdm").value();
  EXPECT_EQ(fdm.wall_for(100.0).asked_by().find("FDM (filament): design guides"), 0u);
  EXPECT_NE(overhang_text(60.0, 1.0, fdm).find("; FDM (filament): at most 45 "), std::string::npos);
}

/// The library has no options, so a command gives the name of its option.
TEST(ProcessLimits, ARequestedWallHasTheSourceThatTheCallerNames) {
  WallDemand demand;
  demand.min_wall_mm = 3.0;
  EXPECT_EQ(demand.for_size(100.0).value().asked_by(), "requested minimum wall");
  demand.min_wall_source = "--min-wall";
  EXPECT_EQ(demand.for_size(100.0).value().asked_by(), "--min-wall");
}

constexpr const char* kWorkshop = R"({"schema": "claystack-process-1", "name": "workshop",
  "walls": [{"up_to_size_sum_mm": 300, "min_wall_mm": 2.5, "source": "our own trials"},
            {"up_to_size_sum_mm": 600, "min_wall_mm": 4, "source": "our own trials"}]})";

TEST(ProcessLimits, ReadsAFile) {
  const auto process = parse_process(kWorkshop, "w.json");
  ASSERT_TRUE(process) << process.error().message;
  EXPECT_EQ(process->name, "workshop");
  EXPECT_EQ(process->wall_for(299.0).min_wall_mm, 2.5);
  EXPECT_EQ(process->wall_for(301.0).min_wall_mm, 4.0);
  EXPECT_EQ(process->wall_for(9e9).min_wall_mm, 4.0);  // the last also applies to all larger ones
}

TEST(ProcessLimits, ErrorsNameTheField) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& says) {
    std::string bad = kWorkshop;
    bad.replace(bad.find(from), from.size(), to);
    const auto process = parse_process(bad, "w.json");
    ASSERT_FALSE(process) << from;
    EXPECT_EQ(process.error().kind, ErrorKind::bad_input);
    EXPECT_EQ(process.error().message.find("w.json:"), 0u) << process.error().message;
    EXPECT_NE(process.error().message.find(says), std::string::npos) << process.error().message;
  };
  expect("2.5", "-2.5",
         "w.json:2: walls[0].min_wall_mm: expected a number above 0 to 10000, found -2.5");
  expect("2.5", "0", "walls[0].min_wall_mm: expected a number above 0 to 10000, found 0");
  expect("2.5", "1e308", "walls[0].min_wall_mm: expected a number above 0 to 10000, found 1e+308");
  expect("600", "1e308",
         "w.json:3: walls[1].up_to_size_sum_mm: expected a number above 0 to 1e+07");
  expect("2.5", "\"thick\"", "walls[0].min_wall_mm: expected a number");
  expect("600", "200", "w.json:3: walls[1]: expected a size that is larger");
  expect("\"source\"", "\"sauce\"", "walls[0]: expected a field \"source\", found none");
  expect("process-1", "process-2",
         "schema: expected \"claystack-process-1\", found \"claystack-process-2\"");
  expect("\"walls\": [", "\"walls\": [], \"x\": [", "walls: expected at least one wall");
  expect("\"name\"", "\"x\": 1, \"name\"", "unknown field \"x\"");
  expect("}]}", "}", "w.json:3: syntax error");
}

TEST(ProcessLimits, ErrorsNameTheKindOfAnotherFile) {
  const auto expect = [](const std::string& bytes, const std::string& says) {
    const auto process = parse_process(bytes, "w.json");
    ASSERT_FALSE(process);
    EXPECT_EQ(process.error().message, "w.json: " + says);
  };
  expect("", "expected a JSON object, found an empty file");
  expect("solid vase\nfacet", "expected a JSON object, found an STL mesh in text");
  expect("DRACO\x02\x02", "expected a JSON object, found a Draco mesh");
  expect("radius, height\n10, 0",
         "expected a JSON object, found text that begins with 'radius, height'");
  expect(std::string(84, '\0'), "expected a JSON object, found binary data");
  expect("{\"schema\": \"claystack-pot-1\"}", "expected a process (.process.json), found a pot");
  std::string marked = "\xEF\xBB\xBF";
  marked += kWorkshop;
  EXPECT_TRUE(parse_process(marked, "w.json"));
}

}  // namespace
}  // namespace clay::solid
