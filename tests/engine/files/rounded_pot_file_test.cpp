#include "claystack/engine/clay.hpp"
#include "claystack/engine/files.hpp"
#include "tests/engine/files/arbitrary.hpp"
#include "tests/engine/files/text_edits.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace clay {
namespace {

using test::Json;

/// Outer radii 10, 10.002, 10.005, 10.005 and inner radii 0, 0, 9, 9.001 mm, slightly off.
Pot small_rounded_pot() {
  std::vector<Ring> rings;
  const double outer[] = {10.0, 10.002, 10.005, 10.005};
  const double inner[] = {0.0, 0.0, 9.0, 9.001};
  for (int i = 0; i < 4; ++i)
    rings.push_back({quanta_from_radius(outer[i] + 0.0002),
                     inner[i] > 0.0 ? quanta_from_radius(inner[i] - 0.0003) : 0});
  Pot pot;
  pot.stack = ClayStack::from_rings(0.75, std::move(rings), 17, 16).value();
  pot.ledger.initial = pot.stack.volume();
  return rounded_pot(pot, 0.001).value();
}

std::string small_rounded_text() { return write_pot(small_rounded_pot(), PotEncoding::json); }

void expect_rounded_error(std::string_view from, std::string_view to, const std::string& message) {
  SCOPED_TRACE(to);
  const std::string text = small_rounded_text();
  test::expect_refused(
      parse_pot(test::replaced(text, from, to), "p.json"),
      "p.json:" + std::to_string(test::line_of(text, from)) + ": rounded_rings." + message);
}

/// After any edit, an accepted pot can be written and read.
void expect_valid(const Pot& pot) {
  EXPECT_EQ(to_string(pot.ledger.imbalance(pot.stack.recount())), "0");
  const auto again = parse_pot(write_pot(pot, PotEncoding::cbor), "again");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_TRUE(*again == pot);
}

TEST(RoundedPotFile, StoresSecondDifferencesAndRadii) {
  const Json rings = Json::parse(small_rounded_text())["rounded_rings"];
  EXPECT_EQ(rings["rounded_to_mm"], 0.001);
  EXPECT_EQ(rings["outer_differences"], Json({10000, -9998, 1, -3}));
  EXPECT_EQ(rings["inner_differences"], Json({0, 0, 9000, -8999}));
  EXPECT_EQ(rings["outer_mm"], Json({10, 10.002, 10.005, 10.005}));
  EXPECT_EQ(rings["inner_mm"], Json({0, 0, 9, 9.001}));
  EXPECT_EQ(rings["exact_volume"], to_string(small_rounded_pot().rounding->exact_volume));
}

RC_GTEST_PROP(RoundedPotFile, RoundTrips, ()) {
  const auto pot = rounded_pot(test::arbitrary_pot(), *rc::gen::inRange(10, 1'000'001) / 1e6);
  RC_PRE(pot.has_value());
  for (const PotEncoding encoding : {PotEncoding::json, PotEncoding::cbor}) {
    const std::string bytes = write_pot(*pot, encoding);
    const auto read = parse_pot(bytes, "written");
    RC_ASSERT(read.has_value());
    RC_ASSERT(*read == *pot);
    RC_ASSERT(write_pot(*read, encoding) == bytes);
  }
}

RC_GTEST_PROP(RoundedPotFile, CborHoldsTheFieldsOfJsonExceptRadii, ()) {
  const auto pot = rounded_pot(test::arbitrary_pot(), 0.001);
  RC_PRE(pot.has_value());
  Json file = Json::parse(write_pot(*pot, PotEncoding::json));
  file["rounded_rings"].erase("outer_mm");
  file["rounded_rings"].erase("inner_mm");
  RC_ASSERT(Json::from_cbor(write_pot(*pot, PotEncoding::cbor)) == file);
}

TEST(RoundedPotFile, WritesAPotWithWrongRoundingExactly) {
  Pot pot = small_rounded_pot();
  std::vector<Ring> rings(pot.stack.rings().begin(), pot.stack.rings().end());
  ++rings[1].outer2;
  pot.stack = ClayStack::from_rings(0.75, std::move(rings), 17, 16).value();
  ++pot.ledger.initial;
  const auto read = parse_pot(write_pot(pot, PotEncoding::cbor), "p");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->rounding);
  EXPECT_TRUE(read->stack == pot.stack);
}

TEST(RoundedPotFile, ErrorsNameTheRingAndItsLine) {
  expect_rounded_error(
      "[10000, -9998,", "[0, -9998,",
      "outer_differences[0]: expected a difference that gives an outer radius from 0.001 "
      "to 5000 mm, found 0");
  expect_rounded_error(
      "[10000, -9998,", "[10000, -20000,",
      "outer_differences[1]: expected a difference that gives an outer radius from 0.001 "
      "to 5000 mm, found -20000");
  expect_rounded_error(
      "[10000, -9998,", "[10000, 4980001,",
      "outer_differences[1]: expected a difference that gives an outer radius from 0.001 "
      "to 5000 mm, found 4980001");
  expect_rounded_error(
      "[10000, -9998,", "[10000, 1000000001,",
      "outer_differences[1]: expected an integer from -1000000000 to 1000000000, found "
      "1000000001");
  expect_rounded_error(
      "[10000, -9998,", "[10000, -9998.0,",
      "outer_differences[1]: expected an integer from -1000000000 to 1000000000, found "
      "-9998.0");
  expect_rounded_error(
      "[0, 0, 9000,", "[0, -1, 9000,",
      "inner_differences[1]: expected a difference that gives an inner radius from 0 to "
      "5000 mm, found -1");
  expect_rounded_error(
      "[0, 0, 9000,", "[0, 0, 10005,",
      "inner_differences[2]: expected a difference that gives an inner radius below the "
      "outer one, found 10005");
  expect_rounded_error(
      "[0, 0, 9000, -8999]", "[0, 0, 9000]",
      "inner_differences: expected one count for each of 4 rings, found an array of 3");
  expect_rounded_error("[10000, -9998, 1, -3]", "[]",
                       "outer_differences: expected 1 to 16777216 rings, found an array of 0");
  expect_rounded_error("[0, 0, 9, 9.001]", "[0, 0, 9, 9.002]",
                       "inner_mm[3]: expected the radius that the count of ring 3 gives, "
                       "9.001000000000223 mm, found 9.002");
}

TEST(RoundedPotFile, ErrorsNameTheLineOfEveryOtherField) {
  expect_rounded_error("\"rounded_to_mm\": 0.001", "\"rounded_to_mm\": 0.0010001",
                       "rounded_to_mm: expected a whole number of nanometres, found 0.0010001");
  expect_rounded_error("\"rounded_to_mm\": 0.001", "\"rounded_to_mm\": 2",
                       "rounded_to_mm: expected a number from 1e-05 to 1, found 2");
  expect_rounded_error(
      "\"exact_volume\": \"", "\"exact_volume\": \"-",
      "exact_volume: expected a text of 1 to 30 decimal digits without leading zeros, found \"-" +
          to_string(small_rounded_pot().rounding->exact_volume) + "\"");
  const std::string text = small_rounded_text();
  test::expect_refused(parse_pot(test::replaced(text, "rounded_rings", "rounded_ring"), "p"),
                       "p:1: expected a field \"rings\", found none");
  Json both = Json::parse(text);
  both["rings"] = {{"outer2", {68719476736}}, {"inner2", {0}}};
  const auto read = parse_pot(both.dump(), "p");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("rounded_rings: expected either these or rings"),
            std::string::npos);
}

TEST(RoundedPotFile, RefusesALedgerOffByOneQuantum) {
  Pot pot = small_rounded_pot();
  pot.ledger.added += 1;
  test::expect_refused(parse_pot(write_pot(pot, PotEncoding::cbor), "p"),
                       "p: ledger: expected every quantum accounted for, found 1 too few (in "
                       "the stack, trimmed and outside, less initial and added)");
}

TEST(RoundedPotFile, RefusesEveryTruncation) {
  const std::string bytes = write_pot(small_rounded_pot(), PotEncoding::cbor);
  for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(parse_pot(bytes.substr(0, n), "cut"));
  EXPECT_FALSE(parse_pot(bytes + '\0', "trailing"));
}

TEST(RoundedPotFile, AnEditedByteNeverGivesAnInvalidPot) {
  const std::string bytes = write_pot(small_rounded_pot(), PotEncoding::cbor);
  std::size_t refused = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (unsigned value = 1; value < 256; value = value < 16 ? value + 1 : value * 2 - 1) {
      std::string edited = bytes;
      edited[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ value);
      if (const auto pot = parse_pot(edited, "edited"))
        expect_valid(*pot);
      else
        ++refused;
    }
  EXPECT_GT(refused, 10 * bytes.size());
}

TEST(RoundedPotFile, RefusesSumsThatOverflow) {
  // 2^18 differences of 10^9: their double sum would overflow 64 bits.
  Json file = Json::parse(small_rounded_text());
  file["max_rings"] = kMaxRings;
  for (const std::int64_t difference : {1'000'000'000, -1'000'000'000}) {
    for (const char* name : {"outer_differences", "inner_differences"}) {
      Json edited = file;
      edited["rounded_rings"][name] = std::vector<std::int64_t>(1 << 18, difference);
      EXPECT_FALSE(parse_pot(edited.dump(), "sums"));
    }
  }
}

TEST(RoundedPotSchema, NamesTheWrittenFields) {
  const auto written = test::member_paths(Json::parse(small_rounded_text()));
  auto described = test::property_paths(test::load_schema("pot"));
  std::erase_if(described, [](const std::string& path) {
    return path.starts_with("/rings") || path.starts_with("/rim") || path.starts_with("/motion") ||
           path.starts_with("/thrown_with") || path.starts_with("/shaped_with") ||
           path.starts_with("/collapse/");
  });
  EXPECT_EQ(std::set(written.begin(), written.end()), std::set(described.begin(), described.end()));
}

TEST(RoundedPotSchema, AgreesWithTheReader) {
  const Json schema = test::load_schema("pot");
  const Json file = Json::parse(small_rounded_text());
  EXPECT_EQ(test::violation(schema, file), "");
  std::size_t compared = 0;
  for (const auto& [what, edited] : test::edits(schema, file)) {
    const bool conforms = test::violation(schema, edited).empty();
    // Edited radii no longer agree with the ledger, nor the limit with the rings.
    const bool is_rule_between_fields =
        what.starts_with("/rounded_rings/") || what.starts_with("/max_rings: ");
    if (conforms && is_rule_between_fields) continue;
    const auto read = parse_pot(edited.dump(), "edited");
    EXPECT_EQ(read.has_value(), conforms) << what;
    ++compared;
  }
  EXPECT_GT(compared, 50u);
}

}  // namespace
}  // namespace clay
