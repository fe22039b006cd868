// Reading numbers and lines, and showing text of unknown origin.
#include "core/text.hpp"

#include "core/file_reader.hpp"
#include "core/nearest_word.hpp"
#include "core/number_parsing.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace clay {
namespace {

TEST(Shown, BoundsTextAndReplacesUnprintableCharacters) {
  EXPECT_EQ(shown("abc", 3), "abc");
  EXPECT_EQ(shown("abcd", 3), "abc...");
  EXPECT_EQ(shown("a\x1b[2J\n~ "), "a?[2J?~ ");
  EXPECT_EQ(shown("H\u00F6he \u20AC \U0001F3FA"), "H\u00F6he \u20AC \U0001F3FA");
  EXPECT_EQ(shown("H\xF6he \xE2\x82"), "H?he ??");  // Latin-1, and half a character
  // The first and the last half of a pair of UTF-16, which UTF-8 cannot hold.
  EXPECT_EQ(shown("\xED\x9F\xBF|\xED\xA0\x80|\xED\xBF\xBF"), "\xED\x9F\xBF|???|???");
  EXPECT_EQ(shown("a\u0085b\u202Ec\u200Bd"), "a?b?c?d");  // control, reversal, no width
  EXPECT_EQ(shown("\u00F6\u00F6\u00F6", 2), "\u00F6\u00F6...");
  std::string cut(40, 'x');
  cut += "...";  // with operator+, GCC 12 warns of bounds that are kept
  EXPECT_EQ(shown(std::string(1000, 'x')), cut);
}

/// By the first bytes that the formats' specifications state.
TEST(KindOfFile, NamesDrawingsOfOtherPrograms) {
  EXPECT_EQ(kind_of_file("%PDF-1.7\n"), "a PDF document");
  EXPECT_EQ(kind_of_file("%!PS-Adobe-3.0 EPSF-3.0\n"), "a PostScript drawing");
  EXPECT_EQ(kind_of_file("AC1032"), "a DWG drawing");
  EXPECT_EQ(kind_of_file("\x1F\x8B\x08"), "a gzip archive");
  EXPECT_EQ(kind_of_file("0\nSECTION"), "text that begins with '0'");
}

/// A binary STL has a header of 80 bytes, the number of its triangles, and 50 bytes for each.
TEST(KindOfFile, CountsTheTrianglesOfABinaryStl) {
  std::string stl(84 + 50, '\0');
  stl[80] = 1;
  EXPECT_EQ(kind_of_file(stl), "an STL mesh");
  EXPECT_EQ(kind_of_file(stl + '\0'), "binary data");
  EXPECT_EQ(kind_of_file(std::string(84, '\0')), "binary data") << "no triangle";
}

/// Distances by hand: a swap of neighbours counts as one.
TEST(NearestWord, IsTheFirstOfTheNearestWithinAThirdOfItsLength) {
  EXPECT_EQ(nearest_word("exprot", {"import", "export"}), "export");
  EXPECT_EQ(nearest_word("tool_x", {"tool_a", "tool_b"}), "tool_a") << "both differ in one letter";
  EXPECT_EQ(nearest_word("abx", {"abc"}), "abc");
  EXPECT_EQ(nearest_word("ax", {"ab"}), "") << "half of it differs";
}

TEST(NameOfFile, HasNeitherFolderNorKind) {
  EXPECT_EQ(name_of_file("pots/bowl.pot.json"), "bowl");
  EXPECT_EQ(name_of_file("Bowl.POT.CBOR"), "Bowl");
  EXPECT_EQ(name_of_file("a/b.c/jug 2.5.scene.json"), "jug 2.5");
  EXPECT_EQ(name_of_file("v1.2.3mf"), "v1.2");
  EXPECT_EQ(name_of_file("cup"), "cup");
  EXPECT_EQ(name_of_file("pots.old/cup"), "cup");
  EXPECT_EQ(name_of_file(".pot.json"), ".pot") << "hidden, without another name";
  EXPECT_EQ(name_of_file(".cup"), ".cup");
  EXPECT_EQ(name_of_file("-"), "pot");
}

TEST(ParseNumber, ReadsTheWholeTextOrNothing) {
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<double>("2.5e3"), 2500.0);
  for (const char* text : {"", "+5", " 5", "5 ", "5x", "2147483648", "0x5"})
    EXPECT_EQ(parse_number<int>(text), std::nullopt) << text;
  EXPECT_EQ(parse_number<std::uint32_t>("-1"), std::nullopt);
}

TEST(TwoNumbers, ReadsBothOrNothing) {
  EXPECT_EQ(two_numbers<int>("1280x720", 'x'), std::pair(1280, 720));
  EXPECT_EQ(two_numbers<int>("-3/4", '/'), std::pair(-3, 4));
  for (const char* text :
       {"", "x", "5", "5x", "x5", "+5x7", "5x 7", "5x7x", "5x7 ", "5x4294967297"})
    EXPECT_EQ(two_numbers<int>(text, 'x'), std::nullopt) << text;
}

/// The lines of a file of these bytes.
struct Read {
  std::vector<std::string> lines;
  std::string rest;
  std::uint64_t bytes = 0;
  bool failed = false;
};

Read read_lines(const std::string& bytes, std::size_t most_bytes) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("lines." + std::to_string(::getpid()))).string();
  std::ofstream(path, std::ios::binary) << bytes;
  FileLines lines(FileReader::open(path).value(), most_bytes);
  Read read;
  for (;;) {
    const auto line = lines.next();
    read.failed = !line;
    if (!line || !*line) break;
    read.lines.emplace_back(**line);
    EXPECT_EQ(lines.number(), read.lines.size());
  }
  read.rest = lines.rest();
  read.bytes = lines.bytes();
  std::filesystem::remove(path);
  return read;
}

TEST(FileLines, JoinsLinesAcrossBlocks) {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{65534},
                                   std::size_t{65535}, std::size_t{65536}, std::size_t{200'000}}) {
    const std::string line(length, 'a');
    const Read read = read_lines(line + "\nb\n\n" + line, 1u << 20);
    EXPECT_EQ(read.lines, (std::vector<std::string>{line, "b", ""})) << length;
    EXPECT_EQ(read.rest, line);
    EXPECT_EQ(read.bytes, 2 * length + 4);
    EXPECT_FALSE(read.failed);
  }
}

TEST(FileLines, RefusesALineAboveTheLimit) {
  EXPECT_TRUE(read_lines(std::string(500'000, 'a'), 100'000).failed);
  std::string line(90'000, 'a');
  line += '\n';
  EXPECT_FALSE(read_lines(line, 100'000).failed);
  // Within one block, too.
  EXPECT_FALSE(read_lines(line, 90'000).failed);
  EXPECT_TRUE(read_lines(line, 89'999).failed);
}

}  // namespace
}  // namespace clay
