// Work that may take more than 2 s shows a line on the terminal, and nothing elsewhere.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace clay::test {
namespace {

constexpr const char* kErase = "\r\x1b[K";

struct Shown {
  std::string arguments;
  std::vector<std::string> stages;  ///< in this order
};

class ProgressLine : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(claystack("throw -q " + bowl_ + " -o " + pot_).status, 0);
    ASSERT_EQ(claystack("export -q --segments 64 --certificate " + pot_ + " " + mesh_).status, 0);
    write_text(folder_.file("a.csv"), "30,0\n40,60\n");
    write_text(folder_.file("a.strokes.json"),
               R"({"start_mm": [120, 120], "strokes": [{"through_mm": [[110, 100], [110, 80]]}]})");
  }

  [[nodiscard]] std::vector<Shown> commands() const {
    const std::string out = folder_.file("out");
    std::vector<Shown> all = {
        {"throw " + bowl_ + " -o " + out + ".pot.json", {"throwing: reading", "throwing: writing"}},
        {"throw " + sample("mouse.work") + " -o " + out + ".pot.json",
         {"throwing: reading", "throwing: replaying the strokes"}},
        {"strokes " + bowl_ + " " + folder_.file("a.strokes.json") + " -o " + out + ".session",
         {"strokes: playing"}},
        {"plan " + bowl_, {"measuring: "}},
        {"export " + pot_ + " --holds 350ml --report " + out + ".html " + out + ".stl",
         {"exporting: reading", "exporting: scaling", "exporting: smooth",
          "exporting: encode_stl"}},
        {"check " + pot_, {"check: reading", "check: smooth", "check: checking"}},
        {"check " + mesh_ + " --min-wall 1 --certificate " + mesh_ + ".certificate.json",
         {"check: reading", "check: checking", "check: verifying the certificate"}},
        {"doctor", {"doctor: examining"}},
    };
#ifdef CLAYSTACK_DRAWINGS
    all.push_back({"import " + folder_.file("a.csv") + " --wall 4 -o " + out + ".pot.json",
                   {"importing: reading", "importing: making rings"}});
    all.push_back({"import " + mesh_ + " -o " + out + ".pot.json",
                   {"importing: reading", "importing: finding the axis"}});
#endif
#ifdef CLAYSTACK_WINDOW
    all.push_back({"render " + pot_ + " --wall-map --time --size 64x64 -o " + out + ".png",
                   {"rendering: reading", "rendering: drawing", "rendering: timing"}});
#endif
    return all;
  }

  static std::string on_a_terminal(const std::string& arguments) {
    return shell("script -qec '" CLAYSTACK_PROGRAM " " + arguments + " >/dev/null' /dev/null").out;
  }

  const ScratchFolder folder_;
  const std::string bowl_ = sample("bowl.scene.json");
  const std::string pot_ = folder_.file("bowl.pot.json"), mesh_ = folder_.file("bowl.stl");
};

TEST_F(ProgressLine, ShowsTheStagesOfEveryCommandOnATerminal) {
  for (const Shown& command : commands()) {
    const std::string text = on_a_terminal(command.arguments);
    std::size_t at = 0;
    for (const std::string& stage : command.stages) {
      const std::size_t found = text.find(kErase + stage, at);
      EXPECT_NE(found, std::string::npos) << command.arguments << ": " << stage << "\n" << text;
      at = std::min(found, text.size());
    }
    EXPECT_NE(text.find(kErase, at + 1), std::string::npos) << "not erased: " << text;
  }
}

TEST_F(ProgressLine, IsAbsentFromPipesAndWhenQuiet) {
  for (const Shown& command : commands()) {
    EXPECT_EQ(claystack(command.arguments).err.find('\r'), std::string::npos) << command.arguments;
    EXPECT_EQ(on_a_terminal(command.arguments + " -q").find(kErase), std::string::npos)
        << command.arguments;
  }
}

/// Otherwise the warning would begin in the middle of the line.
TEST_F(ProgressLine, GoesBeforeAWarningIsPrinted) {
  const std::string text =
      on_a_terminal("throw " + sample("vase.scene.json") + " -s " + sample("bowl.session"));
  EXPECT_NE(text.find(std::string(kErase) + "claystack: "), std::string::npos) << text;
}

}  // namespace
}  // namespace clay::test
