// The samples of the paper's rules are also data of replay: their pots and meshes keep their bytes.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace clay::test {
namespace {

class PaperSample : public testing::TestWithParam<const char*> {};

/// samples/paper/sha256sums lists a pot without the line that names the program's version and
/// without the settings that it remembers, and two meshes of it.
TEST_P(PaperSample, KeepsTheBytesOfItsPotAndMeshes) {
  const ScratchFolder folder;
  const std::string name = GetParam(), pot = folder.file("thrown.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("paper/" + name + ".scene.json") + " -o " + pot).status,
            0);
  ASSERT_EQ(claystack("export -q " + pot + " " + folder.file(name + ".stl") + " " +
                      folder.file(name + ".drc"))
                .status,
            0);
  const Ran run = shell("cd " + folder.path().string() +
                        " && sed '/\"written_by\"/d; /\"thrown_with\"/,/^  },$/d' " + pot + " > " +
                        name + ".pot.json && grep ' " + name + "[.]' " +
                        sample("paper/sha256sums") + " | sha256sum -c --strict");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 3) << run.out;
}

INSTANTIATE_TEST_SUITE_P(All, PaperSample,
                         testing::Values("bowl", "vase", "bottle", "cylinder", "collapse"),
                         [](const auto& pot) { return std::string(pot.param); });

}  // namespace
}  // namespace clay::test
