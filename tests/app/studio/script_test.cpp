#include "app/studio/script.hpp"

#include <gtest/gtest.h>

namespace clay::studio {
namespace {

std::string error_of(const std::string& text) {
  const auto lines = parse_script(text, "s");
  return lines ? std::string("none") : lines.error().message;
}

TEST(Script, ReadsWordsQuotesAndComments) {
  const auto lines = parse_script("# a comment\n\n  type \"two words\"  # why\r\nwait 1\n", "s");
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 2u);
  EXPECT_EQ((*lines)[0].number, 3u);
  EXPECT_EQ((*lines)[0].words, (std::vector<std::string>{"type", "two words"}));
  EXPECT_EQ((*lines)[1].words, (std::vector<std::string>{"wait", "1"}));
}

TEST(Script, ErrorsNameTheLine) {
  EXPECT_EQ(error_of("wait 1\ndance\n"), "s:2: expected a command, found dance");
  EXPECT_EQ(error_of("\nmove 3\n"), "s:2: expected move X Y [over SECONDS], found 1 arguments");
  EXPECT_EQ(error_of("close now"), "s:1: expected close, found 1 arguments");
  EXPECT_EQ(error_of("type \"open"), "s:1: expected a closing quote, found none");
  EXPECT_EQ(error_of(""), "none");
}

}  // namespace
}  // namespace clay::studio
