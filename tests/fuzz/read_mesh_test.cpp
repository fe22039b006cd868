// The fuzzers' guarantee on a fixed set of mutated files, short enough for every build.

#include "tests/fuzz/mesh_promise.hpp"
#include "tests/fuzz/mutator.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>

namespace clay::solid {
namespace {

constexpr std::array<std::string_view, 22> kWords = {"nan",        "inf",
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

class ReadMesh : public testing::TestWithParam<MeshFormat> {};

TEST_P(ReadMesh, ReadsValidFiles) {
  for (const std::string& file : samples::good_files(GetParam())) {
    const auto mesh = decode_mesh(file, GetParam(), "good");
    EXPECT_TRUE(mesh.has_value()) << mesh.error().message;
  }
}

TEST_P(ReadMesh, MutatedFilesGiveAMeshOrAnError) {
  const std::vector<std::string> good = samples::good_files(GetParam());
  test::Mutator mutator(20'240'229, kWords);
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
