// The guarantee of the readers of the window's files, and of firmware, as read_text_test.cpp checks
// it for the others.

#include "tests/fuzz/program_readers.hpp"

#include <gtest/gtest.h>

namespace clay {
namespace {

std::vector<samples::TextReader> readers() {
  auto readers = samples::window_readers(CLAYSTACK_SAMPLES);
#ifdef CLAYSTACK_FALCON
  readers.push_back(samples::firmware_reader());
#endif
  return readers;
}

TEST(ReadWindowFiles, ReadsValidFiles) {
  for (const samples::TextReader& reader : readers())
    for (const std::string& file : reader.good) {
      const auto broken = reader.broken_promise(file);
      EXPECT_FALSE(broken) << reader.name << ": " << *broken;
    }
  EXPECT_TRUE(studio::parse_settings(studio::write_settings({}), "settings"));
}

TEST(ReadWindowFiles, MutatedFilesGiveAValueOrAnError) {
  for (const samples::TextReader& reader : readers()) {
    const auto broken = samples::first_broken(reader, 1, 500, [](const std::string&) {});
    EXPECT_FALSE(broken) << reader.name << ": " << *broken;
  }
}

}  // namespace
}  // namespace clay
