#include "app/bench/extreme/hand.hpp"
#include "app/bench/extreme/suite.hpp"
#include "app/bench/literal/literal_paper.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <ostream>
#include <set>
#include <string>

namespace clay::extreme {

/// googletest's text for a failed case.
static void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

namespace {

class Extreme : public testing::TestWithParam<Case> {};

TEST_P(Extreme, EngineMeetsEveryRequiredResult) {
  const Outcome outcome = GetParam().run(Model::conserving);
  EXPECT_EQ(outcome.verdict, Verdict::passed) << outcome.note;
}

/// A suite that the paper as printed passes would not test anything.
TEST_P(Extreme, LiteralPaperGivesItsExpectedResult) {
  const Outcome outcome = GetParam().run(Model::literal);
  EXPECT_EQ(outcome.verdict, GetParam().literal) << outcome.note;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name(info.param.name);
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Case, Extreme, testing::ValuesIn(cases().begin(), cases().end()), name_of);

/// Speed is measured in both versions, so they must give the same results.
TEST(LiteralPaper, GivesTheSameResultInBothVersions) {
  bench::LiteralScene scene;
  scene.rings = 60;
  scene.ring_height_mm = 1.0;
  scene.outer_radius_mm = 30.0;
  scene.inner_radius_mm = 12.0;
  scene.inside_share = 0.0;  // a bore that is too small for its share would be NaN in both
  scene.friction = 0.3;
  scene.max_stress_kg_per_mm2 = 2e-4;
  bench::LiteralPaper printed(scene);
  scene.writing = bench::LiteralWriting::eased;
  bench::LiteralPaper eased(scene);
  Hand hand(5);
  int touched = 0, collapsed = 0;
  for (int k = 0; k < 2'000; ++k) {
    const glm::dvec3 hip = hand.next().position_mm;
    const bench::LiteralReport a = printed.step(hip), b = eased.step(hip);
    ASSERT_EQ(a.rings_touched, b.rings_touched);
    ASSERT_EQ(a.collapsed, b.collapsed);
    // f' is unbounded toward a pole, and atan rounds there.
    ASSERT_NEAR(glm::length(a.force_n), glm::length(b.force_n), 1e-9);
    touched += a.rings_touched > 0;
    collapsed += a.collapsed;
  }
  EXPECT_EQ(printed.volume(), eased.volume());
  EXPECT_GT(touched, 200);
  EXPECT_GT(collapsed, 0);
}

TEST(ExtremeTable, CaseNamesAreUnique) {
  std::set<std::string_view> names;
  for (const Case& c : cases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
}

}  // namespace
}  // namespace clay::extreme
