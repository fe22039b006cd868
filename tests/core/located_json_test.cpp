#include "core/json/located_json.hpp"

#include "tests/engine/files/text_edits.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace clay::files {
namespace {

Result<LocatedJson> parse(std::string_view text, std::size_t max_values = 1000) {
  return LocatedJson::from_json(text, "F", max_values);
}

void expect_refused(std::string_view text, const std::string& message) {
  SCOPED_TRACE(std::string(text.substr(0, 60)));
  test::expect_refused(parse(text), message);
}

TEST(LocatedJson, FindsTheLineOfEveryValue) {
  const std::string text =
      "\n{\n\"a\": 1\n,\n\"b\":\n[\n1\n,\n-2.5\n,{\n\"a\"\n:\n\"x\"}\n],\n\"c\": "
      "{\n},\"d\":\ntrue\n}";
  const auto json = parse(text);
  ASSERT_TRUE(json) << json.error().message;
  const auto line = [&](const Path& path) { return json->error_at(path, "here").message; };
  EXPECT_EQ(line({}), "F:2: here");
  EXPECT_EQ(line({"a"}), "F:3: here");
  EXPECT_EQ(line({"b"}), "F:6: here");
  EXPECT_EQ(line({"b", std::size_t{0}}), "F:7: here");
  EXPECT_EQ(line({"b", std::size_t{1}}), "F:9: here");
  EXPECT_EQ(line({"b", std::size_t{2}}), "F:10: here");
  EXPECT_EQ(line({"b", std::size_t{2}, "a"}), "F:13: here");
  EXPECT_EQ(line({"c"}), "F:15: here");
  EXPECT_EQ(line({"d"}), "F:17: here");
  EXPECT_EQ(json->field_error({"b", std::size_t{2}, "a"}, "no").message, "F:13: b[2].a: no");
}

TEST(LocatedJson, CountsFromTheGivenFirstLine) {
  const auto json = LocatedJson::from_json("[1]", "F", 10, 41);
  EXPECT_EQ(json->error_at({}, "here").message, "F:41: here");
}

TEST(LocatedJson, KeepsIntegersExactly) {
  const auto json = parse("[9223372036854775807, -9223372036854775808, 18446744073709551615]");
  ASSERT_TRUE(json);
  EXPECT_EQ(json->root()[0].get<std::int64_t>(), INT64_MAX);
  EXPECT_EQ(json->root()[1].get<std::int64_t>(), INT64_MIN);
  EXPECT_EQ(json->root()[2].get<std::uint64_t>(), UINT64_MAX);
}

TEST(LocatedJson, RefusesAnythingButOneValue) {
  expect_refused("", "F:1: expected JSON, found no text");
  expect_refused("\n\n ", "F:3: expected JSON, found no text");
  expect_refused("{\n\"a\": 1\n}\n1\n",
                 "F:4: syntax error while parsing value - unexpected number literal; expected end "
                 "of input");
  expect_refused("[1,\n2",
                 "F:2: syntax error while parsing array - unexpected end of input; "
                 "expected ']'");
  expect_refused("[1\n2\n]",
                 "F:2: syntax error while parsing array - unexpected number literal; "
                 "expected ']'");
  expect_refused("// comment\n1",
                 "F:1: syntax error while parsing value - invalid literal; last "
                 "read: '/'");
  expect_refused(std::string_view("{}\n\0[]", 6), "F:2: expected JSON, found a zero byte");
}

TEST(LocatedJson, RefusesAmbiguousJson) {
  expect_refused("{\"a\": 1,\n\"b\": {}, \"a\": 2}", "F:2: duplicate field \"a\"");
  expect_refused("[1,\n1e999]", "F:2: number overflow parsing '1e999'");
  expect_refused("[\n-1e999\n]", "F:2: number overflow parsing '-1e999'");
  EXPECT_FALSE(parse("[NaN]"));
  EXPECT_FALSE(parse("[Infinity]"));
  EXPECT_FALSE(parse("[01]"));
}

TEST(LocatedJson, RefusesMalformedUtf8) {
  for (const char* bytes : {"\xff", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"}) {
    const auto json = parse(std::string("[\n\"").append(bytes).append("\"]"));
    ASSERT_FALSE(json);
    EXPECT_EQ(json.error().message.substr(0, 5), "F:2: ");
    for (const char c : json.error().message) EXPECT_TRUE(c >= ' ' && c <= '~');
  }
  EXPECT_TRUE(parse("[\"\u00fc\u6c34\"]"));
}

TEST(LocatedJson, LimitsDepthMembersAndValues) {
  const auto nested = [](std::size_t n) { return std::string(n, '[') + std::string(n, ']'); };
  EXPECT_TRUE(parse(nested(64)));
  expect_refused(nested(65), "F:1: expected at most 64 levels, found more");
  expect_refused(std::string(5'000'000, '['), "F:1: expected at most 64 levels, found more");

  std::string members = "{";
  for (int i = 0; i < 64; ++i) members.append("\"").append(std::to_string(i)).append("\":0,");
  EXPECT_TRUE(parse(members.substr(0, members.size() - 1) + "}"));
  expect_refused(members + "\n\"x\":0}", "F:2: expected at most 64 fields, found more");

  EXPECT_TRUE(parse("[0,0,0]", 4));
  EXPECT_FALSE(parse("[0,0,0,0]", 4));
}

TEST(LocatedJson, DistinguishesUnfinishedFromDamagedText) {
  const std::string whole = R"({"a": [1, -2.5e3, true, "x\u00fcy"], "b": null})";
  EXPECT_FALSE(is_unfinished_json(whole));
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_TRUE(is_unfinished_json(whole.substr(0, n))) << whole.substr(0, n);
  for (const char* damaged : {"{\"a\": 1,}", "{\"a\": 1]", "[1 2", "[1}", "{\"a\":1,\"a\":2}", "}"})
    EXPECT_FALSE(is_unfinished_json(damaged)) << damaged;
}

RC_GTEST_PROP(LocatedJson, NeverThrows, (const std::vector<char>& bytes)) {
  const std::string text(bytes.begin(), bytes.end());
  (void)parse(text);
  (void)parse("[\"" + text);
  (void)is_unfinished_json(text);
}

}  // namespace
}  // namespace clay::files
