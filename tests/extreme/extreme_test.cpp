#include "extreme/suite.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <string>

namespace clay::extreme {

/// What googletest says when one fails.
static void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

namespace {

class Extreme : public testing::TestWithParam<Case> {};

TEST_P(Extreme, HoldsOnTheWheel) {
  const Outcome outcome = GetParam().run(Who::conserving);
  EXPECT_EQ(outcome.verdict, Verdict::passed) << outcome.note;
}

/// A suite that the paper as printed passes is not testing.
TEST_P(Extreme, TellsThePaperAsPrinted) {
  const Outcome outcome = GetParam().run(Who::literal);
  EXPECT_EQ(outcome.verdict, GetParam().literal) << outcome.note;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name(info.param.name);
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Case, Extreme, testing::ValuesIn(cases().begin(), cases().end()), name_of);

TEST(ExtremeTable, NamesEachCaseOnce) {
  std::set<std::string_view> names;
  for (const Case& c : cases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
}

}  // namespace
}  // namespace clay::extreme
