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
  EXPECT_EQ(error_of("\nmove 3\n"), "s:2: expected move X Y [over SECONDS], found 1 argument");
  EXPECT_EQ(error_of("close now"), "s:1: expected close, found 1 argument");
  EXPECT_EQ(error_of("press"), "s:1: expected press left|right|middle, found 0 arguments");
  EXPECT_EQ(error_of("wait 1e9"), "s:1: expected 0 to 3600 seconds, found 1e9");
  EXPECT_EQ(error_of("type \"open"), "s:1: expected a closing quote, found none");
  EXPECT_EQ(error_of("wait 1\nkey Hyper+X"),
            "s:2: expected a key such as Ctrl+Z, F10 or Esc, found Hyper+X");
  EXPECT_EQ(error_of("expect colour red"), "s:1: expected a fact, found colour");
  EXPECT_EQ(error_of("expect heigth_mm 3"),
            "s:1: expected a fact, found heigth_mm; did you mean height_mm?");
  EXPECT_EQ(error_of("type \xc3\xbc"), "s:1: expected ASCII text, found \xc3\xbc");
  EXPECT_EQ(error_of("do edit.fly"), "s:1: expected an action, found edit.fly");
  EXPECT_EQ(error_of("do edit.undoo"),
            "s:1: expected an action, found edit.undoo; did you mean edit.undo?");
  EXPECT_EQ(error_of("expect node over 3"),
            "s:1: expected below NUMBER or above NUMBER, found over 3");
  EXPECT_EQ(error_of("press both"), "s:1: expected left, right or middle, found both");
  EXPECT_EQ(error_of("move 1 2 over soon"),
            "s:1: expected over 0 to 3600 seconds, found over soon");
  EXPECT_EQ(error_of("pressure 1.5"), "s:1: expected 0 to 1 or none, found 1.5");
  EXPECT_EQ(error_of("stick left 0 -2"), "s:1: expected -1 to 1, found -2");
  EXPECT_EQ(error_of("stick up 0 0"), "s:1: expected left or right, found up");
  EXPECT_EQ(error_of("trigger right -1"), "s:1: expected 0 to 1, found -1");
  EXPECT_EQ(error_of("trigger left 1 over"), "s:1: expected over 0 to 3600 seconds, found over");
  EXPECT_EQ(error_of("pad turbo"), "s:1: expected a button of a gamepad, found turbo");
  EXPECT_EQ(error_of(""), "none");
}

}  // namespace
}  // namespace clay::studio
