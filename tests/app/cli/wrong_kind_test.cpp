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
  const std::string script = sample("strokes/cylinder.strokes.json");
  const std::string wants_pot = ": expected a pot (.pot.json, .pot.cbor), found ";
  const std::string wants_scene = ": expected a scene (.scene.json), found ";
  const std::vector<Case> cases = {
      {"export " + stl + " " + folder.file("x.obj"),
       stl + wants_pot + "an STL mesh; claystack import makes a pot from a mesh"},
      {"export " + scene + " " + folder.file("x.obj"),
       scene + wants_pot + "a scene; claystack throw makes a pot from a scene and its session"},
      {"render " + session + " -o " + folder.file("x.png"),
       session + wants_pot + "a session; claystack throw makes a pot from a session and its scene"},
      {"check " + script,
       script + wants_pot + "a stroke script; claystack strokes SCENE SCRIPT makes"},
      {"plan " + session, session + wants_scene + "a session; claystack throw SCENE --session"},
      {"plan " + sample("mouse.work"), wants_scene + "a work; claystack throw plays it"},
      {"throw " + pot + " -o " + folder.file("y.pot.json"),
       pot + wants_scene + "a pot; claystack throw --from POT continues it"},
      {"throw " + scene + " -s " + stl + " -o " + folder.file("y.pot.json"),
       stl + ": expected a session (.session), found an STL mesh"},
      {"strokes " + scene + " " + session + " -o " + folder.file("y.session"),
       session + ": expected a stroke script (.strokes.json), found a session"},
      {"plan " + script,
       script + wants_scene + "a stroke script; claystack strokes SCENE SCRIPT makes"},
      {"import " + pot + " -o " + folder.file("y.pot.json"),
       pot + ": expected a drawing (.svg, .dxf, .csv) or a mesh, found a pot"},
      {"check " + stl + " --process " + scene,
       scene + ": expected a process (.process.json), found a scene"},
      {"export " + pot + " " + folder.file("x.stl") + " --process " + pot,
       pot + ": expected a process (.process.json), found a pot"},
      {"check " + stl + " --certificate " + pot,
       pot + ": expected a certificate (.certificate.json), found a pot"},
      {"batch " + scene, scene + ": expected jobs (.jsonl), found a scene"},
      {"check " + session, "the file is a session"}};
  for (const Case& c : cases) {
    const Ran run = claystack(c.arguments);
    EXPECT_EQ(run.status, 2) << c.arguments;
    EXPECT_NE(run.err.find(c.message), std::string::npos) << c.arguments << "\n" << run.err;
  }
}

TEST(WrongKind, NamesKindFromContents) {
  const ScratchFolder folder;
  const std::string pot = folder.file("v.pot.json"), stl = folder.file("v.stl"),
                    obj = folder.file("v.obj");
  ASSERT_EQ(claystack("throw -q " + sample("cylinder.scene.json") + " -o " + pot).status, 0);
  ASSERT_EQ(claystack("export -q " + pot + " " + stl + " " + obj).status, 0);
  const std::string svg = read_text(sample("drawings/jug.svg"));
  const std::string cube =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"
      "f 2 3 4\nf 3 1 4\n# the name is that of another format\n";
  struct Case {
    std::string name, bytes, message;
  };
  const std::vector<Case> cases = {
      {"stl.obj", read_text(stl), "expected an OBJ file, found an STL mesh"},
      {"stl.ply", read_text(stl), "expected a PLY file, found an STL mesh"},
      {"obj.stl", cube, "expected an STL file, found text that begins with 'v 0 0 0'"},
      {"svg.stl", svg, "expected an STL file, found an "},
      {"empty.stl", "", "expected an STL file, found an empty file"},
      {"empty.obj", "", "expected an OBJ file, found an empty file"},
      {"empty.3mf", "", "expected a 3MF file, found an empty file"},
      {"empty.glb", "", "expected a GLB file, found an empty file"},
      {"empty.off", "", "expected an OFF file, found an empty file"},
      {"empty.ply", "", "expected a PLY file, found an empty file"},
      {"empty.drc", "", "expected a Draco file, found an empty file"}};
  for (const auto& [name, bytes, message] : cases) {
    const std::string path = folder.file(name), out = folder.file("out.stl");
    write_text(path, bytes);
    for (const std::string& options : {std::string(), " --repair -o " + out}) {
      const Ran run = claystack("check " + path + options);
      EXPECT_EQ(run.status, 2) << name;
      EXPECT_NE(run.err.find(path + ": " + message), std::string::npos) << name << run.err;
    }
  }
  // The header of a binary STL may hold anything, also the beginning of a pot.
  for (const char first : {'{', '\xA5'}) {
    std::string bytes = read_text(stl);
    bytes[0] = first;
    write_text(folder.file("marked.stl"), bytes);
    const Ran piped = claystack("check - <" + folder.file("marked.stl"));
    EXPECT_EQ(piped.status, 0) << piped.err;
  }
  const Ran nothing = claystack("check - </dev/null");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_NE(nothing.err.find("expected a mesh or a pot, found no input"), std::string::npos);
  for (const auto& ending : std::vector<std::string>{".svg", ".dxf", ".csv"}) {
    const std::string drawing = folder.file("stl" + ending);
    write_text(drawing, read_text(stl));
    const Ran run = claystack("import " + drawing + " -o " + folder.file("i.pot.json"));
    EXPECT_EQ(run.status, 2) << ending;
    EXPECT_NE(run.err.find("expected a drawing (" + ending + "), found an STL mesh"),
              std::string::npos)
        << run.err;
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
