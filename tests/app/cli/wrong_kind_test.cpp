// Messages about files of the wrong kind, and the JSON of an error.

#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace clay::test {
namespace {

TEST(WrongKind, IsNamedInTheMessage) {
  const ScratchFolder folder;
  const std::string pot = folder.file("v.pot.json"), stl = folder.file("v.stl");
  const std::string scene = sample("cylinder.scene.json"), session = sample("cylinder.session");
  ASSERT_EQ(claystack("throw -q " + scene + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + stl).status, 0);
  struct Case {
    std::string arguments, message;
  };
  const std::string wants_pot = ": expected a pot (.pot.json, .pot.cbor), found ";
  const std::vector<Case> cases = {
      {"export " + stl + " " + folder.file("x.obj"), stl + wants_pot + "an STL mesh"},
      {"export " + scene + " " + folder.file("x.obj"), scene + wants_pot + "a scene"},
      {"render " + session + " -o " + folder.file("x.png"), session + wants_pot + "a session"},
      {"throw " + pot + " -o " + folder.file("y.pot.json"),
       pot + ": expected a scene (.scene.json), found a pot"},
      {"throw " + scene + " -s " + stl + " -o " + folder.file("y.pot.json"),
       stl + ": expected a session (.session), found an STL mesh"},
      {"strokes " + scene + " " + session + " -o " + folder.file("y.session"),
       session + ": expected a stroke script (.strokes.json), found a session"},
      {"plan " + sample("strokes/cylinder.strokes.json"),
       ": expected a scene (.scene.json), found a stroke script"},
      {"import " + pot + " -o " + folder.file("y.pot.json"),
       pot + ": expected a drawing (.svg, .dxf, .csv), found a pot"},
      {"check " + session, "the file is a session"}};
  for (const Case& c : cases) {
    const Ran run = claystack(c.arguments);
    EXPECT_EQ(run.status, 2) << c.arguments;
    EXPECT_NE(run.err.find(c.message), std::string::npos) << c.arguments << "\n" << run.err;
  }
}

TEST(ErrorsAsJson, HaveOneShapeInAllCommands) {
  const ScratchFolder folder;
  const Json schema = load_schema("error");
  const std::string out = " -o " + folder.file("x");
  for (const std::string& arguments : std::vector<std::string>{
           "throw none.scene.json" + out + ".pot.json", "export none.pot.json x.stl",
           "check none.stl", "plan none.scene.json", "render none.pot.json" + out + ".png",
           "strokes none.scene.json none.strokes.json" + out + ".session",
           "import none.svg" + out + ".pot.json", "export", "knead"}) {
    const Ran run = claystack(arguments + " --json");
    const Json error = run.json();
    EXPECT_EQ(violation(schema, error), "") << arguments;
    EXPECT_EQ(error.value("status", 0), run.status) << arguments;
    EXPECT_EQ(run.status, arguments.find("none") == std::string::npos ? 2 : 3) << arguments;
    EXPECT_NE(run.err.find(error.value("error", "?")), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace clay::test
