// The guarantee of the readers of Claystack's own files on a fixed set of damaged files, short
// enough for every build. mutate_readers tries more of them, under the sanitizers.

#include "tests/fuzz/text_promise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace clay {
namespace {

TEST(ReadText, ReadsValidFiles) {
  for (const samples::TextReader& reader : samples::text_readers(CLAYSTACK_SAMPLES))
    for (const std::string& file : reader.good) {
      const auto broken = reader.broken_promise(file);
      EXPECT_FALSE(broken) << reader.name << ": " << *broken;
    }
  // The promise also holds for an error, so these must be read.
  for (const auto encoding : {PotEncoding::json, PotEncoding::cbor})
    for (const std::string& file : samples::good_pots(encoding)) {
      const auto pot = parse_pot(file, "pot");
      EXPECT_TRUE(pot) << pot.error().message;
    }
  const auto certificate = solid::parse_certificate(samples::good_certificate(), "certificate");
  EXPECT_TRUE(certificate) << certificate.error().message;
}

/// Otherwise no mutant would reach the code behind the check of a line's checksum.
TEST(ReadText, AChangedLineGetsItsChecksum) {
  const auto readers = samples::text_readers(CLAYSTACK_SAMPLES);
  for (const auto& [name, from, to] : {std::array{"session", R"("t_us":0)", R"("t_us":7)"},
                                       {"work", R"("scene":0)", R"("scene":1)"}}) {
    const auto reader = std::ranges::find(readers, name, &samples::TextReader::name);
    std::string bytes = reader->good[0];
    const std::size_t at = bytes.rfind(from);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, std::string_view(from).size(), to);
    EXPECT_NE(reader->error(bytes), "") << name;
    EXPECT_EQ(reader->error(reader->with_checksums(bytes)), "") << name;
  }
}

TEST(ReadText, MutatedFilesGiveAValueOrAnError) {
  for (const samples::TextReader& reader : samples::text_readers(CLAYSTACK_SAMPLES)) {
    const auto broken = samples::first_broken(reader, 1, 500, [](const std::string&) {});
    EXPECT_FALSE(broken) << reader.name << ": " << *broken;
  }
}

}  // namespace
}  // namespace clay
