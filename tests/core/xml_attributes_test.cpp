// The limit on the attributes of a tag, at every distance from the tag before it.

#include "core/xml_attributes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace clay {
namespace {

constexpr std::size_t kMost = XmlAttributeLimit::kMost;

/// The line of the fault; 0: none. The text comes in pieces of this size.
std::size_t fault_line(std::string_view text, std::size_t piece) {
  XmlAttributeLimit limit;
  for (std::size_t at = 0; at < text.size(); at += piece)
    if (const auto fault = limit.take(text.substr(at, piece))) return fault->line;
  return 0;
}

/// The shortest tag with this many; the next `<` ends it.
std::string tag(std::size_t attributes) { return "<a" + std::string(attributes, '='); }

TEST(XmlAttributes, TheLimitIsTheSameAtEveryPlace) {
  for (std::size_t blanks = 0; blanks <= kMost + 10; ++blanks) {
    const std::string before = "<r>\n<b c='d'/>\n" + std::string(blanks, ' ') + "\n";
    for (const std::size_t piece : {std::size_t{701}, std::size_t{1} << 20}) {
      ASSERT_EQ(fault_line(before + tag(kMost) + "</r>", piece), 0u) << blanks;
      ASSERT_EQ(fault_line(before + tag(kMost + 1) + "</r>", piece), 4u) << blanks;
      ASSERT_EQ(fault_line(before + tag(kMost + 1), piece), 4u) << blanks;
    }
  }
}

TEST(XmlAttributes, CountsLinesOfShortTags) {
  std::string text = "<?xml version='1.0'?>\n";
  for (int i = 0; i < 3000; ++i) text += "<v x='1'\n y='2'/>\n";
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  for (const std::size_t piece : {1u, 2u, 3u, 17u, 1000u, 1001u, 1'000'000u}) {
    EXPECT_EQ(fault_line(text, piece), 0u) << piece;
    EXPECT_EQ(fault_line(text + "\n" + tag(kMost + 1), piece), lines + 2) << piece;
  }
}

TEST(XmlAttributes, EachTagCountsAlone) {
  std::string text = "<r>";
  for (int i = 0; i < 20; ++i) text += "<a" + std::string(kMost - 300, '=') + "\n";
  EXPECT_EQ(fault_line(text, text.size()), 0u);
  // Equal signs in a value, in a text and in an instruction are no attributes.
  const std::string many(2 * kMost, '=');
  for (const std::string& other : {"<a b='" + many + "'/>", "<a>" + many, "<?a " + many + "?>"})
    EXPECT_EQ(fault_line("<r>" + other + "<b/>", 1'000'000), 0u) << other;
}

}  // namespace
}  // namespace clay
