// Valid but large meshes: they give a verdict or are refused in advance, for any memory limit.

#include "app/cli/memory_room.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

namespace clay::test {
namespace {

/// Runs the program with a limit of address space.
Ran with_megabytes(std::size_t megabytes, const std::string& arguments) {
  return shell("ulimit -v " + std::to_string(1024 * megabytes) + " && " CLAYSTACK_PROGRAM " " +
               arguments);
}

/// The address space that the program needs for almost no work, with a margin.
constexpr std::size_t kProgram = 700;

/// Nested octahedra about one axis, alternately outward and inward, as binary STL.
std::string nest(std::uint32_t shells) {
  constexpr std::array<std::array<int, 3>, 6> kCorners{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  constexpr std::array<std::array<std::size_t, 3>, 8> kFaces{
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  std::string stl(84 + 50 * 8 * std::size_t{shells}, '\0');
  const std::uint32_t count = 8 * shells;
  std::memcpy(stl.data() + 80, &count, 4);
  char* at = stl.data() + 84;
  for (std::uint32_t shell = 0; shell < shells; ++shell) {
    for (const auto& face : kFaces) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t corner = shell % 2 == 0 ? i : 2 - i;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto mm =
              static_cast<float>(kCorners[face[corner]][axis]) * static_cast<float>(shells - shell);
          std::memcpy(at + 12 + 12 * i + 4 * axis, &mm, 4);
        }
      }
      at += 50;
    }
  }
  return stl;
}

TEST(CheckLarge, ChecksManyNestedShellsInLittleMemory) {
  const ScratchFolder folder;
  write_text(folder.file("nest.stl"), nest(30'000));
  const Ran run = with_megabytes(kProgram, "check --json " + folder.file("nest.stl"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("components"), 30'000);
  EXPECT_EQ(run.json().at("checks").at(0).at("text").get<std::string>().substr(0, 22),
            "15000 closed cavities,");
}

TEST(CheckLarge, StreamsTextFiles) {
  // A tetrahedron between blank lines: more bytes than there is address space.
  const ScratchFolder folder;
  const std::string facet_begin = "facet normal 0 0 0\nouter loop\n";
  std::string text = "solid wide\n";
  for (const char* corners :
       {"vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n",
        "vertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\n",
        "vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n"}) {
    text += facet_begin + corners + "endloop\nendfacet\n";
    for (int line = 0; line < 2'000; ++line) text += std::string(60'000, ' ') + '\n';
  }
  text += "endsolid wide\n";
  constexpr std::size_t kMegabytes = 400;
  ASSERT_GT(text.size(), kMegabytes << 20);
  write_text(folder.file("wide.stl"), text);
  const Ran stl = with_megabytes(kMegabytes, "check --json " + folder.file("wide.stl"));
  EXPECT_EQ(stl.status, 0) << stl.err;
}

TEST(CheckLarge, RefusesAMeshThatNeedsTooMuchMemoryInAdvance) {
  // 20 million facets without a byte on disk: they are never read.
  const ScratchFolder folder;
  const std::uint32_t count = 20'000'000;
  std::string head(84, '\0');
  std::memcpy(head.data() + 80, &count, 4);
  write_text(folder.file("big.stl"), head);
  std::filesystem::resize_file(folder.file("big.stl"), 84 + 50 * std::uintmax_t{count});
  const Ran run = with_megabytes(1600, "check " + folder.file("big.stl"));
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("big.stl: checking about 20000000 triangles needs about "),
            std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find(" GB available within the limit on address space (ulimit -v)"),
            std::string::npos)
      << run.err;
}

/// A pot of `rings` equal rings, as JSON.
std::string tall_pot(std::size_t rings) {
  constexpr std::int64_t kOuter2 = 100LL << 36, kInner2 = 50LL << 36;
  const auto repeated = [&](std::int64_t value) {
    std::string list = std::to_string(value);
    for (std::size_t i = 1; i < rings; ++i) list.append(",").append(std::to_string(value));
    return list;
  };
  const std::string count = std::to_string(rings);
  return R"({"schema":"claystack-pot-1","written_by":"test","model":"conserving",)"
         R"("density_g_cm3":1.9,"ring_height_mm":0.001,"max_rings":)" +
         count + R"(,"quantum_mm2":"2^-36","rings":{"outer2":[)" + repeated(kOuter2) +
         R"(],"inner2":[)" + repeated(kInner2) + R"(]},"crown":"0","ledger":{"initial":")" +
         std::to_string((kOuter2 - kInner2) * static_cast<std::int64_t>(rings)) +
         R"(","added":"0","trimmed":"0","outside":"0"},"collapse":null})";
}

TEST(MemoryLimit, RefusesAPotThatDoesNotFitInAdvance) {
  const ScratchFolder folder;
  const std::string pot = folder.file("tall.pot.json");
  write_text(pot, tall_pot(600'000));
  const auto copy_with = [&](const std::string& memory) {
    return claystack("export -q --memory " + memory + " " + pot + " " +
                     folder.file("copy.pot.cbor"));
  };
  const Ran refused = copy_with("60MiB");
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(
      refused.err.find("tall.pot.json: reading the pot needs about 0.058 GB of memory, found"),
      std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("available within the limit --memory"), std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("copy.pot.cbor")));
  const Ran done = copy_with("200MiB");
  EXPECT_EQ(done.status, 0) << done.err;
}

TEST(MemoryLimit, GivesNoVerdictOnAPotWhoseMeshDoesNotFit) {
  const ScratchFolder folder;
  const std::string pot = folder.file("jug.pot.json"), tall = folder.file("tall.pot.json");
  ASSERT_EQ(claystack("import -q " + sample("drawings/jug.svg") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("check -q " + pot).status, 0);
  const Ran small = claystack("check --memory 8MiB " + pot);
  EXPECT_EQ(small.status, 3) << small.out;
  EXPECT_NE(small.err.find("jug.pot.json: checking "), std::string::npos) << small.err;
  EXPECT_NE(small.err.find("available within the limit --memory"), std::string::npos) << small.err;
  EXPECT_EQ(small.out.find("will not print"), std::string::npos) << small.out;
  write_text(tall, tall_pot(600'000));
  const Ran large = claystack("check --memory 60MiB " + tall);
  EXPECT_EQ(large.status, 3) << large.out;
  EXPECT_NE(large.err.find("tall.pot.json: reading the pot needs about 0.058 GB"),
            std::string::npos)
      << large.err;
}

TEST(MemoryLimit, EndsWorkThatGrowsBeyondIt) {
  // The estimate does not cover the data that an export makes of the pot.
  const ScratchFolder folder;
  write_text(folder.file("tall.pot.json"), tall_pot(600'000));
  const Ran run = claystack("export --json --memory 85MiB " + folder.file("tall.pot.json") + " " +
                            folder.file("tall.obj"));
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_EQ(violation(load_schema("error"), run.json()), "");
  EXPECT_NE(run.err.find("out of memory, with a limit of 0.089 GB"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("tall.obj")));
}

TEST(MemoryLimit, RefusesAMeshThatDoesNotFitInAdvanceAndStreamsStl) {
  const ScratchFolder folder;
  const std::string pot = folder.file("bowl.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  const auto fine = [&](const std::string& file, const std::string& memory) {
    return claystack("export -q --segments 4000 --memory " + memory + " " + pot + " " +
                     folder.file(file));
  };
  const Ran refused = fine("bowl.obj", "100MiB");
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("writing meshes needs about"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("bowl.obj")));
  EXPECT_EQ(fine("bowl.stl", "100MiB").status, 0);
  EXPECT_EQ(fine("bowl.obj", "1GiB").status, 0);
}

TEST(MemoryLimit, RefusesACompressedMeshThatDoesNotFitInAdvance) {
  const ScratchFolder folder;
  const std::string pot = folder.file("bowl.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  for (const auto& [file, options] : {std::pair("draco.glb", "--glb draco"),
                                      {"meshopt.glb", "--glb meshopt"},
                                      {"core.glb", "--glb core"},
                                      {"bowl.drc", ""}}) {
    const std::string path = folder.file(file);
    const Ran made =
        claystack("export --json --segments 2000 " + std::string(options) + " " + pot + " " + path);
    ASSERT_EQ(made.status, 0) << made.err;
    const auto triangles = made.json().at("triangles").get<std::uint64_t>();
    const auto check_with = [&](const std::string& memory) {
      return claystack("check -q --memory " + memory + " " + path);
    };
    const Ran refused = check_with("64MiB");
    EXPECT_EQ(refused.status, 3) << file;
    EXPECT_NE(refused.err.find(std::string(file) + ": checking about " + std::to_string(triangles) +
                               " triangles needs about "),
              std::string::npos)
        << refused.err;
    EXPECT_EQ(check_with("400MiB").status, 0) << file;
  }
}

TEST(MemoryLimit, RefusesA3mfThatUnpacksToMoreThanFitsInAdvance) {
  const ScratchFolder folder;
  const std::string pot = folder.file("bowl.pot.json"), file = folder.file("bowl.3mf");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  const Ran made = claystack("export --json --segments 2000 " + pot + " " + file);
  ASSERT_EQ(made.status, 0) << made.err;
  const Ran refused = claystack("check -q --memory 64MiB " + file);
  EXPECT_EQ(refused.status, 3);
  const std::string begin = "bowl.3mf: checking about ";
  const std::size_t at = refused.err.find(begin);
  ASSERT_NE(at, std::string::npos) << refused.err;
  const double about = std::stod(refused.err.substr(at + begin.size()));
  const double triangles = made.json().at("triangles").get<double>();
  EXPECT_GT(about, triangles);
  EXPECT_LT(about, 1.5 * triangles);
  EXPECT_EQ(claystack("check -q --memory 400MiB " + file).status, 0);
}

TEST(MemoryLimit, RefusesTheWheelAndThePotOfMoreRingsThanFit) {
  const ScratchFolder folder;
  const std::string scene = folder.file("tall.scene.json");
  write_text(scene, R"({"schema":"claystack-scene-1","name":"tall","lump":{"rings":1000000,)"
                    R"("ring_height_mm":0.001,"max_rings":1000000},"tool":{"shape":)"
                    R"({"sphere":{"radius_mm":9}},"gap_mm":5}})");
  const auto thrown = [&](const std::string& memory) {
    return claystack("throw -q --memory " + memory + " " + scene + " -s " +
                     sample("cylinder.session") + " -o " + folder.file("tall.pot.json"));
  };
  const Ran wheel = thrown("40MiB");
  EXPECT_EQ(wheel.status, 3);
  const std::string needs = "tall.scene.json: a wheel for up to 1000000 rings needs about 0.05 GB";
  EXPECT_NE(wheel.err.find(needs), std::string::npos) << wheel.err;
  const Ran plan = claystack("plan -q --memory 40MiB " + scene);
  EXPECT_EQ(plan.status, 3);
  EXPECT_NE(plan.err.find(needs), std::string::npos) << plan.err;
  const Ran pot = thrown("150MiB");
  EXPECT_EQ(pot.status, 3);
  EXPECT_NE(pot.err.find("tall.pot.json: writing the pot needs about 0.18 GB"), std::string::npos)
      << pot.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("tall.pot.json")));
}

#ifdef CLAYSTACK_STUDIO
// Without memory, a driver of OpenGL crashes.
TEST(MemoryLimit, RefusesAWindowWithoutRoomForOpenGl) {
  const ScratchFolder folder;
  const Ran run = with_megabytes(300, "studio --script " + sample("window/plain.script") +
                                          " --screenshot " + folder.file("w.png"));
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("drawing needs about 0."), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("w.png")));
}
#endif

TEST(MemoryLimit, StatesTwoFiguresThatDiffer) {
  EXPECT_EQ(
      cli::lack_of_room("drawing", 3'000'000'000, {1'200'000'000, "the limit --memory"}),
      "drawing needs about 3.0 GB of memory, found 1.2 GB available within the limit --memory");
  EXPECT_EQ(cli::lack_of_room("drawing", 1'634'000'000, {1'629'000'000, "the limit --memory"}),
            "drawing needs about 1.634 GB of memory, found 1.629 GB available within the limit "
            "--memory");
}

TEST(MemoryLimit, IsAnOptionOfEveryCommand) {
  for (const std::string command :
       {"throw", "export", "check", "strokes", "plan", "import", "batch", "doctor"})
    EXPECT_NE(claystack(command + " --help").out.find("--memory SIZE "), std::string::npos)
        << command;
  EXPECT_EQ(claystack("doctor --memory much").status, 2);
}

TEST(CheckLarge, RefusesATooLongTextInAdvance) {
  const ScratchFolder folder;
  write_text(folder.file("long.stl"), "solid long\n" + std::string(200, ' '));
  std::filesystem::resize_file(folder.file("long.stl"), std::uintmax_t{9} << 30);
  const Ran run = claystack("check " + folder.file("long.stl"));
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("expected at most 20000000 triangles, found about 37 million"),
            std::string::npos)
      << run.err;
}

}  // namespace
}  // namespace clay::test
