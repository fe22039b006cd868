#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include "tests/engine/files/arbitrary.hpp"
#include "tests/engine/files/full_scene.hpp"
#include "tests/engine/files/text_edits.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace clay {
namespace {

using test::Json;

constexpr Quanta kMm2 = Quanta{1} << 36;

/// Four rings and a balanced ledger.
Pot small_pot() {
  Pot pot;
  pot.stack = ClayStack::from_rings(0.75,
                                    {{100 * kMm2, 0},
                                     {121 * kMm2, 81 * kMm2},
                                     {144 * kMm2 + 1, 100 * kMm2},
                                     {2 * kMm2, kMm2}},
                                    17, 16)
                  .value();
  pot.ledger.added = 3;
  pot.ledger.trimmed = 5 * kMm2;
  pot.ledger.outside = 1;
  pot.ledger.initial = pot.stack.volume() + pot.ledger.trimmed + 1 - 3;
  pot.model = Model::paper;
  pot.density_g_cm3 = 2.1;
  return pot;
}

Pot collapsed_pot() {
  Pot pot = small_pot();
  pot.rim = {7, -3};
  pot.motion = {-12.5, 0.1};
  pot.thrown_with = settings_of(test::full_scene());
  pot.shaped_with = ToolSpec{};
  pot.collapse = Collapse{
      2, {11.5, 2.25, -3.0}, {0.6, 0.0, -0.8}, 1.25, 12.5, {0.8, -1.5, 0.6}, 12.0, 45.5, 31.75};
  return pot;
}

void expect_pot_error(std::string_view from, std::string_view to, const std::string& message) {
  SCOPED_TRACE(to);
  const std::string text = write_pot(collapsed_pot(), PotEncoding::json);
  test::expect_refused(parse_pot(test::replaced(text, from, to), "p.json"),
                       "p.json:" + std::to_string(test::line_of(text, from)) + ": " + message);
}

TEST(PotFile, AlsoWritesReadableRadii) {
  const Json file = Json::parse(write_pot(collapsed_pot(), PotEncoding::json));
  EXPECT_EQ(file["schema"], "claystack-pot-1");
  EXPECT_EQ(file["rings"]["outer2"], Json({100 * kMm2, 121 * kMm2, 144 * kMm2 + 1, 2 * kMm2}));
  EXPECT_EQ(file["rings"]["inner2"], Json({Quanta{0}, 81 * kMm2, 100 * kMm2, kMm2}));
  EXPECT_EQ(file["rings"]["outer_mm"], Json({10, 11, 12, 1.414214}));
  EXPECT_EQ(file["rings"]["inner_mm"], Json({0, 9, 10, 1}));
  EXPECT_EQ(file["crown"], "17");
  EXPECT_EQ(file["ledger"]["trimmed"], "343597383680");
  EXPECT_EQ(file["collapse"]["axis"], Json({0.6, 0, -0.8}));
}

TEST(PotFile, ReadsAnOldCollapseWithoutAShiftAsARotation) {
  Pot pot = collapsed_pot();
  Json file = Json::parse(write_pot(pot, PotEncoding::json));
  for (const char* name : {"shift_mm", "threshold_kpa", "energy_lost_mj", "plastic_work_mj"})
    ASSERT_EQ(file["collapse"].erase(name), 1u) << name;
  pot.collapse = Collapse{2, {11.5, 2.25, -3.0}, {0.6, 0.0, -0.8}, 1.25, 12.5};
  const auto read = parse_pot(file.dump(), "old");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, pot);
}

RC_GTEST_PROP(PotFile, RoundTrips, ()) {
  const Pot pot = test::arbitrary_pot();
  for (const PotEncoding encoding : {PotEncoding::json, PotEncoding::cbor}) {
    const std::string bytes = write_pot(pot, encoding);
    const auto read = parse_pot(bytes, "written");
    RC_ASSERT(read.has_value());
    RC_ASSERT(*read == pot);
    RC_ASSERT(write_pot(*read, encoding) == bytes);
  }
}

RC_GTEST_PROP(PotFile, CborHoldsTheFieldsOfJsonExceptRadii, ()) {
  const Pot pot = test::arbitrary_pot();
  Json file = Json::parse(write_pot(pot, PotEncoding::json));
  file["rings"].erase("outer_mm");
  file["rings"].erase("inner_mm");
  RC_ASSERT(Json::from_cbor(write_pot(pot, PotEncoding::cbor)) == file);
}

TEST(PotFile, SettingsAreThoseOfTheSceneFile) {
  const Json pot = Json::parse(write_pot(collapsed_pot(), PotEncoding::json));
  const Json scene = Json::parse(write_scene(test::full_scene()));
  for (const auto& [name, part] : pot["thrown_with"].items()) EXPECT_EQ(part, scene[name]) << name;
  EXPECT_EQ(pot["thrown_with"].size(), 6u);
  EXPECT_FALSE(Json::parse(write_pot(small_pot(), PotEncoding::json)).contains("thrown_with"));
}

TEST(PotFile, TwoHundredRingsFitIntoFourKilobytes) {
  // All radii differ, low bits are used, and clay is trimmed, so that no part is short by chance.
  std::vector<Ring> rings;
  for (int i = 0; i < 200; ++i)
    rings.push_back({quanta_from_radius(45.0 + 0.0123 * i), quanta_from_radius(40.0 + 0.0071 * i)});
  Pot pot;
  pot.stack = ClayStack::from_rings(0.75, std::move(rings), 123'456'789'012, 800).value();
  pot.ledger.trimmed = pot.stack.volume() / 7;
  pot.ledger.initial = pot.stack.volume() + pot.ledger.trimmed;
  const std::string bytes = write_pot(pot, PotEncoding::cbor);
  RecordProperty("bytes", static_cast<int>(bytes.size()));
  EXPECT_LE(bytes.size(), 4000u);
  pot.collapse = Collapse{100,
                          {0.1, 0.2, 0.3},
                          {std::sin(1.0), 0.0, std::cos(1.0)},
                          1.1,
                          9.9,
                          {0.4, 0.5, 0.6},
                          9.8,
                          7.7,
                          6.6};
  EXPECT_LE(write_pot(pot, PotEncoding::cbor).size(), 4096u);
}

TEST(PotFile, RefusesALedgerOffByOneQuantum) {
  Pot pot = small_pot();
  pot.ledger.added += 1;
  const std::string text = write_pot(pot, PotEncoding::json);
  const std::string message =
      "ledger: expected every quantum accounted for, found 1 too few (in the stack, trimmed and "
      "outside, less initial and added)";
  test::expect_refused(parse_pot(text, "p"),
                       "p:" + std::to_string(test::line_of(text, "\"ledger\"")) + ": " + message);
  test::expect_refused(parse_pot(write_pot(pot, PotEncoding::cbor), "p"), "p: " + message);
}

TEST(PotFile, ErrorsNameTheRingAndItsLine) {
  expect_pot_error("1.414214", "1.414",
                   "rings.outer_mm[3]: expected the radius that the count of ring "
                   "3 gives, 1.4142135623730951 mm, found 1.414");
  expect_pot_error("[10, 11, 12, 1.414214]", "[10, 11, 12]",
                   "rings.outer_mm: expected one radius for each of 4 rings, found an array of 3");
  expect_pot_error(
      "[0, 9, 10, 1]", "[0, 9.00002, 10, 1]",
      "rings.inner_mm[1]: expected the radius that the count of ring 1 gives, 9 mm, found "
      "9.00002");
  expect_pot_error("[0, 5566277615616,", "[0, 8315056685056,",
                   "rings.inner2[1]: expected less than the outer count of the ring, found "
                   "8315056685056");
  expect_pot_error("[0, 5566277615616,", "[0,",
                   "rings.inner2: expected one count for each of 4 rings, found an array of 3");
  expect_pot_error("[6871947673600,", "[68718,",
                   "rings.outer2[0]: expected an integer from 68719 to 1717986918400000000, found "
                   "68718");
  expect_pot_error("[6871947673600,", "[6871947673600.0,",
                   "rings.outer2[0]: expected an integer from 68719 to 1717986918400000000, found "
                   "6871947673600.0");
}

TEST(PotFile, AcceptsRoundedRadii) {
  const std::string text = write_pot(small_pot(), PotEncoding::json);
  EXPECT_TRUE(parse_pot(test::replaced(text, "1.414214", "1.41421"), "rounded"));
}

TEST(PotFile, ErrorsNameTheLineOfEveryOtherField) {
  const std::string digits =
      "crown: expected a text of 1 to 30 decimal digits without leading zeros, found ";
  expect_pot_error("\"17\"", "17", digits + "17");
  expect_pot_error("\"17\"", "\"017\"", digits + "\"017\"");
  expect_pot_error("\"17\"", "\"-1\"", digits + "\"-1\"");
  expect_pot_error("\"17\"", "\"\"", digits + "\"\"");
  expect_pot_error("\"17\"", "\"1000000000000000000000000000000\"",
                   digits + "\"1000000000000000000000000000000\"");
  expect_pot_error("\"max_rings\": 16", "\"max_rings\": 3",
                   "max_rings: expected at least the number of rings, 4, found 3");
  expect_pot_error("[0.6, 0, -0.8]", "[0.6, 0, -0.7]",
                   "collapse.axis: expected a horizontal axis of length 1, found an array of 3");
  expect_pot_error("[0.6, 0, -0.8]", "[0.6, 0.8, 0]",
                   "collapse.axis: expected a horizontal axis of length 1, found an array of 3");
  expect_pot_error("[0.6, 0, -0.8]", "[0.6, 0]",
                   "collapse.axis: expected an array of 3 numbers, found an array of 2");
  expect_pot_error("\"failed_ring\": 2", "\"failed_ring\": 4",
                   "collapse.failed_ring: expected a ring below their number, 4, found 4");
  expect_pot_error(
      "\"density_g_cm3\": 2.1", "\"density_g_cm3\": 2.1, \"density\": 2",
      "unknown field \"density\"; expected one of schema, written_by, model, "
      "density_g_cm3, ring_height_mm, max_rings, quantum_mm2, rings, rounded_rings, crown, "
      "ledger, rim, motion, thrown_with, shaped_with, collapse");
  expect_pot_error("\"gap_mm\": 4.5", "\"gap_mm\": 0",
                   "thrown_with.tool.gap_mm: expected a number from 0.001 to 1000, found 0");
  expect_pot_error("\"friction\": 0.3", "\"friction\": 0.3, \"grip\": 1",
                   "unknown field \"grip\" in thrown_with.force; expected one of "
                   "stiffness_n_per_mm2, limit_n, friction, wheel, paper_stiffness_n_per_mm");
}

TEST(PotFile, ErrorsInCborNameTheField) {
  const std::string bytes = write_pot(small_pot(), PotEncoding::cbor);
  test::expect_refused(parse_pot(test::replaced(bytes, "paper", "papal"), "p"),
                       "p: model: expected one of conserving, paper, found \"papal\"");
  test::expect_refused(parse_pot(test::replaced(bytes, "added", "addad"), "p"),
                       "p: ledger: expected a field \"added\", found \"addad\"");
}

TEST(PotFile, RefusesFilesThatAreNotPots) {
  EXPECT_FALSE(parse_pot("", "empty"));
  EXPECT_FALSE(parse_pot("[]", "array"));
  EXPECT_FALSE(parse_pot("\xa0", "empty map"));
  EXPECT_FALSE(parse_pot(std::string(1'000'000, '\xbf'), "nested"));
  EXPECT_FALSE(parse_pot("\xa1" + std::string(1'000'000, '\x7f'), "nested key"));
  const std::string bytes = write_pot(small_pot(), PotEncoding::cbor);
  for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(parse_pot(bytes.substr(0, n), "cut"));
  EXPECT_FALSE(parse_pot(bytes + '\0', "trailing"));
}

TEST(PotFile, AFlippedBitNeverGivesAnUnbalancedPot) {
  const std::string bytes = write_pot(collapsed_pot(), PotEncoding::cbor);
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string flipped = bytes;
      flipped[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1u << bit));
      if (const auto pot = parse_pot(flipped, "flipped")) {
        EXPECT_EQ(to_string(pot->ledger.imbalance(pot->stack.recount())), "0");
      }
    }
}

TEST(PotSchema, NamesTheWrittenFields) {
  std::set<std::string> written;
  for (const ToolShapeSpec& shape :
       {ToolShapeSpec(SphereSpec{}), ToolShapeSpec(EllipseSpec{}), ToolShapeSpec(RibSpec{}),
        ToolShapeSpec(SampledSpec{{0, 1}, {1, 1}})}) {
    Pot pot = collapsed_pot();
    pot.thrown_with->tool.shape = shape;
    const auto paths = test::member_paths(Json::parse(write_pot(pot, PotEncoding::json)));
    written.insert(paths.begin(), paths.end());
  }
  std::erase_if(written,  // described as the tool of thrown_with
                [](const std::string& path) { return path.starts_with("/shaped_with/"); });
  auto described = test::property_paths(test::load_schema("pot"));
  std::erase_if(described,
                [](const std::string& path) { return path.starts_with("/rounded_rings"); });
  EXPECT_EQ(written, std::set(described.begin(), described.end()));
}

/// The reader is stricter than the schema only where fields depend on each other: counts on ledger
/// and radii, indices on the stack.
bool is_rule_between_fields(const std::string& edit) {
  constexpr std::array kRules = {
      "/rings/",  "/failed_ring: ", "/axis/", "/max_rings: at minimum", "/max_rings: above minimum",
      "/sampled/"};
  return std::ranges::any_of(
      kRules, [&](const char* rule) { return edit.find(rule) != std::string::npos; });
}

/// One setting at a time at its limits and beyond: a thrown pot is never lost.
TEST(PotFile, HoldsTheSettingsOfEveryWheelThatCanBeBuilt) {
  using Field = double& (*)(SceneSpec&);
  const std::vector<Field> fields = {
      [](SceneSpec& s) -> double& { return s.lump.ring_height_mm; },
      [](SceneSpec& s) -> double& { return s.lump.density_g_cm3; },
      [](SceneSpec& s) -> double& { return s.tool.gap_mm.emplace(); },
      [](SceneSpec& s) -> double& { return s.removal.rate_per_s; },
      [](SceneSpec& s) -> double& { return s.removal.yield_depth_mm; },
      [](SceneSpec& s) -> double& { return s.removal.min_wall_mm; },
      [](SceneSpec& s) -> double& { return s.removal.paper_fraction.emplace(); },
      [](SceneSpec& s) -> double& { return s.flow.sigma_mm; },
      [](SceneSpec& s) -> double& { return s.flow.reach_mm; },
      [](SceneSpec& s) -> double& { return s.flow.inside_share; },
      [](SceneSpec& s) -> double& { return s.force->stiffness_n_per_mm2; },
      [](SceneSpec& s) -> double& { return s.force->paper_stiffness_n_per_mm.emplace(); },
      [](SceneSpec& s) -> double& { return s.force->limit_n; },
      [](SceneSpec& s) -> double& { return s.force->friction; },
      [](SceneSpec& s) -> double& { return s.stability.emplace().max_stress_kpa; },
      [](SceneSpec& s) -> double& { return s.clay.emplace().wheel_rpm; },
      [](SceneSpec& s) -> double& { return s.clay.emplace().floor_mm; },
      [](SceneSpec& s) -> double& { return s.clay.emplace().finger_mm.emplace(); },
      [](SceneSpec& s) -> double& { return s.clay.emplace().finger_behind.emplace(); },
      [](SceneSpec& s) -> double& { return s.clay.emplace().heave_slope.emplace(); }};
  int built = 0;
  for (std::size_t field = 0; field < fields.size(); ++field)
    for (const double value : {-1.0, 0.0, 1e-9, 1e-3, 0.5, 1.0 - 1e-9, 1.0, 2.0, 10.0, 25.0, 200.0,
                               1e3, 1e6, 1e9, 2e9, 1e300, HUGE_VAL}) {
      SceneSpec scene;
      fields[field](scene) = value;
      auto wheel = Wheel::build(scene);
      if (!wheel) continue;
      wheel->step({0, {60.0, 40.0, 0.0}});
      const Pot pot = wheel->pot();
      const auto read = parse_pot(write_pot(pot, PotEncoding::json), "thrown");
      ASSERT_TRUE(read) << "field " << field << ", " << value << ": " << read.error().message;
      EXPECT_EQ(*read, pot);
      ++built;
    }
  EXPECT_GT(built, 100);
}

TEST(PotSchema, AgreesWithTheReader) {
  const Json schema = test::load_schema("pot");
  for (const Pot& pot : {small_pot(), collapsed_pot()}) {
    const Json file = Json::parse(write_pot(pot, PotEncoding::json));
    EXPECT_EQ(test::violation(schema, file), "");
    for (const auto& [what, edited] : test::edits(schema, file)) {
      const auto read = parse_pot(edited.dump(), "edited");
      const bool conforms = test::violation(schema, edited).empty();
      if (conforms && is_rule_between_fields(what)) continue;
      EXPECT_EQ(read.has_value(), conforms)
          << what << ": " << (read ? "read" : read.error().message);
    }
  }
}

}  // namespace
}  // namespace clay
