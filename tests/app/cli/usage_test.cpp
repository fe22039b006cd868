#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace clay::test {
namespace {

TEST(Usage, VersionListsTheBuildOptions) {
  const Ran run = claystack("--version");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out.rfind("claystack 0.", 0), 0u) << run.out;
  EXPECT_NE(run.out.find("export"), std::string::npos);
}

TEST(Usage, HelpShowsExamplesAndExitStatuses) {
  for (const char* command : {"", "throw ", "export ", "check ", "plan ", "render "}) {
    const Ran run = claystack(std::string(command) + "--help");
    EXPECT_EQ(run.status, 0) << command;
    EXPECT_NE(run.out.find("Example"), std::string::npos) << command;
  }
  EXPECT_NE(claystack("--help").out.find("Exit status"), std::string::npos);
}

TEST(Usage, ReturnsTwoForBadUsage) {
  for (const char* arguments :
       {"", "knead", "throw", "export x.pot.json", "check", "throw x --unknown",
        "export x.pot.json x.stl --tolerance -1", "export x.pot.json x.stl --segments two",
        "check x.pot.json --min-wall nan", "throw -"})
    EXPECT_EQ(claystack(arguments).status, 2) << arguments;
}

TEST(Usage, ReportsAnUnknownCommand) {
  EXPECT_NE(claystack("knead").err.find("found knead"), std::string::npos);
}

TEST(Usage, ReturnsThreeForAFailedStdout) {
  const std::string scene = sample("bowl.scene.json");
  for (const std::string& command :
       {"throw --json " + scene, "plan " + scene, std::string("--help")})
    EXPECT_EQ(shell(CLAYSTACK_PROGRAM " " + command + " >/dev/full").status, 3) << command;
}

TEST(Usage, QuietPrintsNothing) {
  const ScratchFolder folder;
  const Ran run =
      claystack("throw --quiet " + sample("bowl.scene.json") + " -o " + folder.file("b.pot.json"));
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(run.out.empty()) << run.out;
  EXPECT_TRUE(run.err.empty()) << run.err;
}

TEST(Usage, AcceptsADashForStandardStreams) {
  const Ran run = shell(std::string(CLAYSTACK_PROGRAM) + " throw -q - -s " +
                        sample("bowl.session") + " -o - < " + sample("bowl.scene.json"));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.json().at("schema"), "claystack-pot-1");
}

TEST(Usage, ReturnsThreeForAMissingFolder) {
  const Ran run =
      claystack("throw -q " + sample("bowl.scene.json") + " -o /no/such/folder/b.pot.json");
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("/no/such/folder"), std::string::npos) << run.err;
}

TEST(Usage, HelpCommandPrintsTheHelpOfTheCommand) {
  const auto help = claystack("help export"), option = claystack("export --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.out, option.out);
  EXPECT_NE(help.out.find("--tolerance"), std::string::npos);
  EXPECT_EQ(claystack("help").out, claystack("--help").out);
}

TEST(Usage, SuggestsTheNearestCommandAndOption) {
  EXPECT_NE(claystack("exprot pot.json").err.find("did you mean export?"), std::string::npos);
  EXPECT_NE(
      claystack("export a.pot.json a.stl --tolerence 1").err.find("did you mean --tolerance?"),
      std::string::npos);
  // Among other words, and in a required option.
  for (const auto& [typo, name] :
       {std::pair{"check --acept prints a.stl", "--accept"},
        std::pair{"check a.stl --acept prints", "--accept"},
        std::pair{"import a.svg --outptu b.pot.json", "--output"},
        std::pair{"strokes a.strokes.json --ouput b.session", "--output"},
        std::pair{"render a.pot.json -o b.png --materail glaze", "--material"},
        std::pair{"plan a.scene.json --jsno", "--json"}, std::pair{"doctor --jsno", "--json"},
        std::pair{"throw --form a.pot.json", "--from"}})
    EXPECT_NE(claystack(typo).err.find("did you mean " + std::string(name) + "?"),
              std::string::npos)
        << claystack(typo).err;
  EXPECT_EQ(claystack("zzzz").err.find("did you mean"), std::string::npos);
}

TEST(Usage, ErrorsNameTheOptionTheExpectedAndTheFound) {
  const struct {
    const char* arguments;
    const char* message;
  } cases[] = {
      {"--versoin", "unknown option --versoin; did you mean --version?"},
      {"", "expected a command, found none\nrun claystack --help for usage\n"},
      {"export",
       "expected pot (NAME.pot.json, .pot.cbor, or a .3mf by Claystack, or - for standard input), "
       "found none\nrun claystack export --help for usage\n"},
      {"strokes a.scene.json -o b.session", "expected script (NAME.strokes.json), found none\n"},
      {"import a.svg", "expected --output, found none"},
      {"export a b --segments 2", "--segments: expected a whole number from 3 to 1048576, found 2"},
      {"export a b --smooth soft", "--smooth: expected fair, exact or none, found soft"},
      {"export a b --tolerance", "--tolerance: expected a value, found none"},
      {"export a b --tolerance 1 --tolerance 2",
       "--tolerance: expected once, found more than once"},
      {"export a b --tolerance 1m",
       "--tolerance: expected a length from 1e-05 to 10 mm (mm, cm, in), found 1m\n"},
      {"export a b --glaze-allowance 1.1cm",
       "--glaze-allowance: expected 0 or a length from 0.001 to 10 mm (mm, cm, in), found 1.1cm\n"},
      {"export a b --foot 60mmx6ftx4mm", "such as 60x6x4 or 6mmx4mm, found 60mmx6ftx4mm\n"},
      {"export a b --tolerance ''", "(mm, cm, in), found nothing\n"},
      {"export a b --smooth ''", "--smooth: expected fair, exact or none, found nothing\n"},
      {"throw a --device simulated --damping ''", "--damping: expected a value, found nothing\n"},
      {"throw a --device simulated --seconds ''", "--seconds: expected a value, found nothing\n"},
      {"export '' b.stl", "pot: expected a value, found nothing\n"},
      {"export a.pot.json b.stl --report ''", "--report: expected a value, found nothing\n"},
      {"throw a --at one", "--at: expected a whole number from 0 to 4294967295, found one"},
      {"throw a b",
       "unexpected argument b; the command takes one file, and claystack batch runs it on many\n"},
      {"check a.stl b.stl", "unexpected argument b.stl; the command takes one file, and "},
      {"strokes a b c -o d", "unexpected argument c\n"},
      {"export a b --smooth-length 1km",
       "--smooth-length: expected tool or a length from 0 to 10000 mm (mm, cm, in), found 1km\n"},
      {"check a --jsn", "unknown option --jsn; did you mean --json?\n"},
      {"check a --memory lots", "--memory: expected at least 8MiB, "},
      {"check a --memory 7MiB", "(512MiB, 2GiB), found 7MiB\n"},
      {"plan a --rate 0", "--rate: expected a number from 10 to 100000, found 0"}};
  for (const auto& [arguments, message] : cases) {
    const Ran run = claystack(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_NE(run.err.find(message), std::string::npos) << arguments << "\n" << run.err;
  }
}

TEST(Usage, AFileWhoseNameBeginsWithADashIsNotAnOption) {
  const ScratchFolder folder;
  const std::string file = folder.file("-dash.stl");
  ASSERT_EQ(shell("echo solid > " + file).status, 0);
  const auto run = [&](const std::string& arguments) {
    return shell("cd " + folder.path().string() + " && " CLAYSTACK_PROGRAM " " + arguments);
  };
  const Ran ran = run("check -dash.stl");
  EXPECT_EQ(ran.status, 2);
  EXPECT_NE(ran.err.find("unknown option -dash.stl; write ./-dash.stl for the file of this name\n"),
            std::string::npos)
      << ran.err;
  EXPECT_EQ(run("check -zebra.stl").err.find("file of this name"), std::string::npos);
  EXPECT_EQ(run("check ./-dash.stl").err.find("option"), std::string::npos);
}

TEST(Usage, EveryLengthMayHaveAUnit) {
  const ScratchFolder folder;
  const std::string pot = folder.file("bowl.pot.json");
  ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  const auto file = [&](const std::string& options) {
    const std::string out = folder.file("bowl.stl");
    const Ran run = claystack("export " + pot + " " + out + " " + options);
    EXPECT_EQ(run.status, 0) << options << "\n" << run.err;
    return run.out + read_text(out);
  };
  // Each is compared with plain mm, and with none: it has an effect.
  const std::string none = file("");
  for (const char* option : {"--fill-line 25.4|1in|2.54cm|25.4 mm", "--glaze-allowance 0.5|0.5mm",
                             "--floor-fillet 5|5mm|0.5cm", "--foot 40x6x2|40mmx6mmx2mm|4x.6x.2cm",
                             "--diameter 127|5in|12.7cm", "--smooth-length 9|9mm|.9cm",
                             "--lip-fillet 0.5|0.5mm|.05cm"}) {
    const std::string text = option, name = text.substr(0, text.find(' '));
    std::istringstream values(text.substr(name.size() + 1));
    std::string value, first;
    while (std::getline(values, value, '|')) {
      const std::string made = file(name + " '" + value + "'");
      if (first.empty()) first = made;
      EXPECT_TRUE(made == first) << name << " " << value;
    }
    EXPECT_FALSE(first == none) << name;
  }
}

TEST(Usage, HelpNamesTheKindOfEveryValue) {
  const std::string help = claystack("export --help").out;
  for (const char* line :
       {"pot FILE REQUIRED", "out FILE ...", "--report FILE", "--segments NUMBER",
        "--shrinkage PERCENT", "--holds VOLUME", "--weighs WEIGHT",
        "--smooth {fair,exact,none}=fair", "--process PROCESS"})
    EXPECT_NE(help.find(line), std::string::npos) << line << "\n" << help;
  for (const char* command : {"throw", "export", "check", "plan", "strokes", "doctor"}) {
    const std::string text = claystack(std::string(command) + " --help").out;
    for (const char* type : {"TEXT", "FLOAT", "UINT", " INT"})
      EXPECT_EQ(text.find(type), std::string::npos) << command << ": " << type << "\n" << text;
  }
}

TEST(Usage, HelpSaysWhatALengthLooksLike) {
  for (const char* command : {"export", "check", "import", "render", "throw"})
    EXPECT_NE(claystack(std::string(command) + " --help")
                  .out.find("LENGTH: in mm, or with its unit (mm, cm, in)"),
              std::string::npos)
        << command;
}

// An escape sequence in a file name would act on the terminal, a newline would end the message, and
// a character that reverses the text would hide the ending of the name.
TEST(Usage, MessagesHoldNoControlCharacters) {
  const ScratchFolder folder;
  const std::string name = "\"$(printf 'r\\033[31med\\nb.stl')\"";
  EXPECT_EQ(claystack("check " + name).err,
            "claystack: r?[31med?b.stl: could not open: No such file or directory\n");
  EXPECT_EQ(claystack("check 'a\u202Elts.exe\u200B\u0085\xF6.stl'").err,
            "claystack: a?lts.exe???.stl: could not open: No such file or directory\n");
  write_text(folder.file("cube.obj"),
             "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const std::string at = "cd " + folder.path().string() + " && ";
  const std::string red = "\"$(printf 'r\\033[31me\\nd.obj')\"";
  const Ran run = shell(at + "cp cube.obj " + red + " && " CLAYSTACK_PROGRAM " check " + red);
  EXPECT_TRUE(run.out.starts_with("r?[31me?d.obj: sound\n")) << run.out;
}

#ifdef CLAYSTACK_STUDIO
TEST(Usage, ReportsAMissingFileEvenWithoutADisplay) {
  const ScratchFolder folder;
  const std::string file = folder.file("none.work");
  const auto run = shell("env -u DISPLAY -u WAYLAND_DISPLAY XDG_CONFIG_HOME=" + folder.file("") +
                         " " CLAYSTACK_PROGRAM " studio " + file);
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "claystack: " + file + ": could not open: No such file or directory\n");
}

TEST(Usage, ReportsAnEmptyDisplayWithoutAStrayBlank) {
  const auto run =
      shell("env DISPLAY= WAYLAND_DISPLAY= XDG_RUNTIME_DIR= " CLAYSTACK_PROGRAM " studio");
  EXPECT_EQ(run.status, 4);
  EXPECT_EQ(run.err.find(" ;"), std::string::npos) << run.err;
}
#endif

}  // namespace
}  // namespace clay::test
