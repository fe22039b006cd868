// The fuzzers' guarantee on a fixed set of mutated files, short enough for every build.

#include "tests/fuzz/mesh_promise.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace clay::solid {
namespace {

/// Damages a file like disks, editors and attackers. The standard's distributions differ between
/// libraries, so numbers are drawn by remainder.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutate(std::string bytes) {
    for (std::size_t left = 1 + below(3); left > 0; --left) mutate_once(bytes);
    return bytes;
  }

  std::size_t below(std::size_t bound) { return random_() % bound; }

 private:
  void mutate_once(std::string& bytes) {
    static constexpr std::array<std::string_view, 22> kWords = {
        "nan",        "inf",
        "-inf",       "1e39",
        "1e-50",      "0",
        "-1",         "-99",
        "4294967296", "//",
        "/",          "\\\n",
        "\n",         " ",
        "#",          "f",
        "v",          "facet",
        "solid",      "endsolid",
        "vertex",     std::string_view("\0", 1)};
    if (bytes.empty()) bytes = "solid";
    const std::size_t at = below(bytes.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(bytes.size() - at, 64));
    switch (below(8)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random_());
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(below(bytes.size()), bytes.substr(at, length));
        break;
      case 5:
        std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\xFF');
        break;
      case 6:
        bytes.insert(at, kWords[below(kWords.size())]);
        break;
      default:
        replace_word(bytes, at, kWords[below(kWords.size())]);
        break;
    }
  }

  static void replace_word(std::string& bytes, std::size_t at, std::string_view word) {
    const std::size_t end = std::min(bytes.find_first_of(" \n", at), bytes.size());
    bytes.replace(at, end - at, word);
  }

  std::mt19937 random_;
};

class ReadMesh : public testing::TestWithParam<MeshFormat> {};

TEST_P(ReadMesh, ReadsValidFiles) {
  for (const std::string& file : samples::good_files(GetParam())) {
    const auto mesh = decode_mesh(file, GetParam(), "good");
    EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
  }
}

TEST_P(ReadMesh, MutatedFilesGiveAMeshOrAnError) {
  const std::vector<std::string> good = samples::good_files(GetParam());
  Mutator mutator(20'240'229);
  std::size_t refused = 0;
  constexpr std::size_t kRuns = 5000;
  for (std::size_t run = 0; run < kRuns; ++run) {
    const std::string bytes = mutator.mutate(good[mutator.below(good.size())]);
    const auto broken = samples::broken_promise(bytes, GetParam());
    ASSERT_FALSE(broken.has_value()) << *broken << " in run " << run;
    refused += !decode_mesh(bytes, GetParam(), "again").has_value();
  }
  // Both outcomes occur: most mutants are refused, and some are still meshes.
  EXPECT_GT(refused, kRuns / 4);
  EXPECT_LT(refused, kRuns);
}

RC_GTEST_PROP(ReadMeshAtAll, AnyBytesGiveAMeshOrAnError, (const std::string& bytes)) {
  for (const std::string_view start : {"", "solid\n", "v 0 0 0\nf ", "DRACO\2\2\1\1", "DRACO\2\2\1",
                                       "ply\nformat ascii 1.0\n", "OFF\n1 1 0\n"}) {
    for (const FormatFacts& facts : kFormatFacts) {
      RC_ASSERT(samples::broken_promise(std::string(start) + bytes, facts.format) == std::nullopt);
    }
  }
}

std::vector<MeshFormat> formats_of_this_build() {
  std::vector<MeshFormat> formats;
  for (const FormatFacts& facts : kFormatFacts) {
#ifndef CLAYSTACK_DRACO
    if (facts.format == MeshFormat::drc) continue;
#endif
    formats.push_back(facts.format);
  }
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, ReadMesh, testing::ValuesIn(formats_of_this_build()),
                         [](const auto& chosen) { return std::string(name_of(chosen.param)); });

}  // namespace
}  // namespace clay::solid
