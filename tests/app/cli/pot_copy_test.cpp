#include "tests/app/cli/thrown_bowl.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay::test {
namespace {

class PotCopies : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    ASSERT_EQ(
        claystack("throw -q " + sample(std::string(GetParam()) + ".scene.json") + " -o " + pot)
            .status,
        0);
  }
  ScratchFolder folder;
  std::string pot = folder.file("p.pot.json");
};

TEST_P(PotCopies, RoundTripToTheSameBytes) {
  const std::string cbor = folder.file("c.pot.cbor"), back = folder.file("b.pot.json");
  ASSERT_EQ(claystack("export -q " + pot + " " + cbor).status, 0);
  ASSERT_EQ(claystack("export -q " + cbor + " " + back).status, 0);
  EXPECT_TRUE(read_text(back) == read_text(pot));
  EXPECT_LT(3 * read_text(cbor).size(), read_text(pot).size());
}

TEST_P(PotCopies, RoundedRoundTripToTheSameBytes) {
  const std::string json = folder.file("r.pot.json"), cbor = folder.file("r.pot.cbor");
  ASSERT_EQ(claystack("export -q --precision 0.001 " + pot + " " + json + " " + cbor).status, 0);
  const std::string back = folder.file("b.pot.json"), again = folder.file("b.pot.cbor");
  ASSERT_EQ(claystack("export -q " + cbor + " " + back).status, 0);
  ASSERT_EQ(claystack("export -q " + json + " --precision 0.001 " + again).status, 0);
  EXPECT_TRUE(read_text(back) == read_text(json));
  EXPECT_TRUE(read_text(again) == read_text(cbor));
}

double clay_mm3(const std::string& pot_text) {
  const auto pot = nlohmann::json::parse(pot_text);
  long double counted = std::stold(pot.at("crown").get<std::string>()) / 0x1p36L;
  const auto& rings = pot.contains("rings") ? pot.at("rings") : pot.at("rounded_rings");
  for (std::size_t i = 0; i < rings.at("outer_mm").size(); ++i) {
    const auto outer = rings.at("outer_mm").at(i).get<long double>();
    const auto inner = rings.at("inner_mm").at(i).get<long double>();
    counted += outer * outer - inner * inner;
  }
  return static_cast<double>(counted * std::numbers::pi_v<long double> *
                             pot.at("ring_height_mm").get<long double>());
}

TEST_P(PotCopies, ReportTheEffectOfRounding) {
  const std::string rounded = folder.file("r.pot.json");
  const auto run = claystack("export --json --precision 0.01 " + pot + " " + rounded);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto file = run.json().at("files").at(0);
  EXPECT_EQ(file.at("format"), "pot.json");
  EXPECT_EQ(file.at("bytes"), read_text(rounded).size());
  EXPECT_EQ(file.at("rounded_to_mm"), 0.01);
  const double before = clay_mm3(read_text(pot));
  const double change = clay_mm3(read_text(rounded)) - before;
  // The radii for people of the exact pot have six decimals.
  EXPECT_NEAR(file.at("volume_change_mm3"), change, 1e-6 * before);
  EXPECT_NEAR(file.at("volume_change_relative"), change / before, 1e-6);
  EXPECT_NE(file.at("volume_change_mm3"), 0.0);
}

TEST_P(PotCopies, RoundedPotsAreSoundAndPrintable) {
  const std::string rounded = folder.file("r.pot.cbor"), stl = folder.file("r.stl");
  ASSERT_EQ(claystack("export -q --precision 0.001 " + pot + " " + rounded).status, 0);
  const Ran check = claystack("check " + rounded);
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  EXPECT_NE(check.out.find("note: radii rounded to 0.001 mm"), std::string::npos) << check.out;
  EXPECT_EQ(claystack("export -q --tolerance 0.1 " + rounded + " " + stl).status, 0);
  EXPECT_EQ(claystack("check -q " + stl).status, 0);
}

INSTANTIATE_TEST_SUITE_P(Export, PotCopies, testing::Values("bowl", "vase", "bottle", "cylinder"));

class PotCopy : public ThrownBowl {};

TEST_F(PotCopy, MeshesKeepTheExactRadiiBesideARoundedCopy) {
  const std::string alone = folder.file("a.stl"), beside = folder.file("b.stl");
  const std::string copy = folder.file("b.pot.cbor");
  ASSERT_EQ(claystack("export -q " + pot + " " + alone).status, 0);
  const Ran run = claystack("export --precision 0.1 " + pot + " " + copy + " " + beside);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(read_text(beside) == read_text(alone));
  EXPECT_NE(run.out.find("rounded to 0.1 mm; counted clay changed by "), std::string::npos)
      << run.out;
}

TEST_F(PotCopy, RefusesUnroundablePotsAndWritesNothing) {
  const std::string copy = folder.file("c.pot.cbor"), stl = folder.file("c.stl");
  const auto expect = [&](const std::string& arguments, const std::string& says) {
    const Ran run = claystack("export " + arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(copy));
    EXPECT_FALSE(std::filesystem::exists(stl));
  };
  expect("--precision 0.001 " + pot + " " + stl,
         "--precision: expected a pot among the files to write, found none");
  expect("--precision 2 " + pot + " " + copy, "--precision");
  expect("--precision 0.00012345 " + pot + " " + copy + " " + stl, "in whole nanometres");
  expect("--precision 0.0000123 " + pot + " " + copy, "claystack: --precision with " + pot);
  const std::string coarse = folder.file("d.pot.cbor");
  ASSERT_EQ(claystack("export -q --precision 0.01 " + pot + " " + coarse).status, 0);
  expect("--precision 0.001 " + coarse + " " + copy, "0.01 mm or coarser");
  expect(pot + " " + pot, "expected a separate output file");
}

TEST(PotCopyCollapsed, IsCopiedAndRounded) {
  const ScratchFolder folder;
  const std::string pot = folder.file("c.pot.json"), copy = folder.file("d.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("paper/collapse.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q --precision 0.001 " + pot + " " + copy).status, 0);
  const auto before = nlohmann::json::parse(read_text(pot));
  const auto after = nlohmann::json::parse(read_text(copy));
  EXPECT_EQ(after.at("collapse"), before.at("collapse"));
  EXPECT_EQ(after.at("crown"), before.at("crown"));
  EXPECT_EQ(after.at("ledger").at("trimmed"), "0");
}

}  // namespace
}  // namespace clay::test
