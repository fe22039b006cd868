// The parts that are missing on a machine; and the manual pages and completions made from the
// options.

#include "tests/support/run_program.hpp"
#include "tests/support/schema_check.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

namespace clay::test {
namespace {

const nlohmann::json& finding(const nlohmann::json& report, const std::string& name) {
  for (const nlohmann::json& one : report.at("findings"))
    if (one.at("name") == name) return one;
  throw std::runtime_error("no finding named " + name);
}

TEST(Doctor, FollowsItsSchemaAndItsExitStatus) {
  const Ran run = claystack("doctor --json");
  const nlohmann::json report = run.json();
  EXPECT_EQ(violation(load_schema("doctor"), report), "");
  bool good = true;
  for (const nlohmann::json& one : report.at("findings")) {
    good = good && one.at("good").get<bool>();
    EXPECT_NE(one.at("good").get<bool>(), one.contains("fix")) << one;
  }
  EXPECT_EQ(report.at("good"), good);
  EXPECT_EQ(run.status, good ? 0 : 1);
}

// A sanitizer needs more addresses than the limit leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Doctor, ReportsALimitOfMemory) {
  const Ran run = shell("ulimit -v 900000 && " CLAYSTACK_PROGRAM " doctor --json");
  EXPECT_FALSE(finding(run.json(), "memory").at("good"));
}
#endif

TEST(Doctor, NamesWhatIsMissingAndTheFix) {
  const ScratchFolder folder;
  const std::string program = CLAYSTACK_PROGRAM;
  const auto look = [&](const std::string& environment) {
    return shell("env " + environment + " " + program + " doctor --json").json();
  };
  EXPECT_TRUE(finding(look("HOME=" + folder.path().string()), "home folder").at("good"));
  const nlohmann::json no_folder = finding(look("HOME=/proc XDG_STATE_HOME="), "home folder");
  EXPECT_EQ(no_folder.at("found"), "/proc/.local/state/claystack");
  // A file is no home, and nothing outside of the home folder gets another owner.
  EXPECT_EQ(finding(look("HOME=/dev/null XDG_STATE_HOME="), "home folder").at("fix"),
            "export HOME=/path/to/a/folder");
  // Only root may write into /, the nearest folder that exists.
  if (::geteuid() != 0) {
    EXPECT_EQ(finding(look("HOME=/nonexistent XDG_STATE_HOME="), "home folder").at("fix"),
              "export HOME=/path/to/a/folder");
  }
#ifdef CLAYSTACK_STUDIO
  write_text(folder.file("zenity"), "#!/bin/sh\n");
  std::filesystem::permissions(folder.file("zenity"), std::filesystem::perms::owner_all);
  EXPECT_EQ(finding(look("PATH=" + folder.path().string()), "file dialog").at("found"), "zenity");
  EXPECT_EQ(finding(look("PATH=/nowhere"), "file dialog").at("fix"), "sudo apt install zenity");
  EXPECT_FALSE(finding(look("-u DISPLAY -u WAYLAND_DISPLAY"), "screen").at("good"));
  EXPECT_TRUE(finding(look("DISPLAY=:9"), "screen").at("good"));
#endif
}

/// An installed program finds its rule beside itself, even if its folder was moved. A machine that
/// has the rule, and a program without devices, need no fix.
TEST(Doctor, NamesTheRuleBesideTheProgram) {
  const ScratchFolder folder;
  namespace fs = std::filesystem;
  fs::create_directories(folder.path() / "bin");
  fs::create_directories(folder.path() / "lib/udev/rules.d");
  fs::copy_file(CLAYSTACK_PROGRAM, folder.path() / "bin/claystack");
  const std::string rule = folder.file("lib/udev/rules.d/60-claystack.rules");
  write_text(rule, "#\n");
  const nlohmann::json report = shell(folder.file("bin/claystack") + " doctor --json").json();
  for (const nlohmann::json& one : report.at("findings"))
    if (one.at("name") == "udev rule" && one.contains("fix")) {
      EXPECT_NE(one.at("fix").get<std::string>().find("sudo cp " + rule + " "), std::string::npos)
          << one;
    }
}

/// An installed program names the samples beside itself, even if its folder was moved.
TEST(Manual, NamesTheSamplesBesideTheProgram) {
  const ScratchFolder folder;
  namespace fs = std::filesystem;
  fs::create_directories(folder.path() / "bin");
  fs::create_directories(folder.path() / "share/claystack/samples");
  fs::copy_file(CLAYSTACK_PROGRAM, folder.path() / "bin/claystack");
  const std::string program = folder.file("bin/claystack");
  const std::string samples = folder.file("share/claystack/samples");
  EXPECT_NE(shell(program + " --help").out.find("cp -r " + samples + " ."), std::string::npos);
}

TEST(Manual, ShowsEveryOptionThatHelpLists) {
  for (const std::string command : {"export", "check", "throw", "batch"}) {
    const Ran page = claystack("manual " + command);
    ASSERT_EQ(page.status, 0) << page.err;
    std::string text;  // without the marks of roff
    for (std::size_t i = 0; i < page.out.size(); ++i)
      if (page.out[i] != '\\') text += page.out[i];
    std::istringstream help(claystack(command + " --help").out);
    std::size_t options = 0;
    for (std::string word; help >> word;) {
      const std::size_t at = word.find("--");
      if (at == std::string::npos || word.size() < at + 3) continue;
      word = word.substr(at, word.find_first_of(",;:.)", at) - at);
      EXPECT_NE(text.find(word), std::string::npos) << command << ": " << word;
      ++options;
    }
    EXPECT_GT(options, 5u);
  }
  EXPECT_EQ(claystack("manual nothing").status, 2);
}

TEST(Manual, CompletesInBash) {
  const ScratchFolder folder;
  write_text(folder.file("c"), claystack("manual bash").out);
  const auto complete = [&](const std::string& words) {
    return shell("bash -c '. " + folder.file("c") + "; compopt() { :; }; COMP_WORDS=(" + words +
                 "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _claystack; echo ${COMPREPLY[@]}'")
        .out;
  };
  EXPECT_EQ(complete("claystack exp"), "export\n");
  EXPECT_EQ(complete("claystack export a --smo"), "--smooth --smooth-length\n");
  EXPECT_EQ(complete("claystack export a --smooth \"\""), "fair exact none\n");
  const std::string commands = complete("claystack help \"\"");
  EXPECT_NE(commands.find("export"), std::string::npos) << commands;
  EXPECT_EQ(complete("claystack help exp"), "export\n");
  // Words, and names of files beside them.
  EXPECT_EQ(complete("claystack export a --process po"), "porcelain\n");
  EXPECT_EQ(complete("claystack export a --process " + folder.file("")), folder.file("c") + "\n");
  // A name with a blank is one word. Files are offered for files alone.
  write_text(folder.file("d e"), "");
  EXPECT_EQ(complete("claystack check " + folder.file("d")), folder.file("d e") + "\n");
  EXPECT_EQ(complete("claystack check a --certificate " + folder.file("d")),
            folder.file("d e") + "\n");
  EXPECT_EQ(complete("claystack check a --min-wall " + folder.file("")), "\n");
  EXPECT_EQ(complete("claystack doctor " + folder.file("")), "\n");
  // Bash takes --smooth=e for three words.
  EXPECT_EQ(complete("claystack export a --smooth = e"), "exact\n");
  EXPECT_EQ(complete("claystack export a --smooth ="), "fair exact none\n");
  const bool devices = claystack("throw --help").out.find("--device") != std::string::npos;
  EXPECT_EQ(complete("claystack throw a --device sim"), devices ? "simulated\n" : "\n");
}

/// The statuses of a command appear once, and not as an example.
TEST(Manual, StatesTheExitStatusOfTheCommand) {
  const auto page = [](const char* name) { return claystack("manual " + std::string(name)).out; };
  EXPECT_NE(page("export").find(".SH EXIT STATUS\n0 done and sound; 1 the pot or mesh "),
            std::string::npos);
  const std::string doctor = page("doctor");
  EXPECT_NE(doctor.find(".SH EXIT STATUS\n0 nothing is missing; 1 something is.\n.PP\n"),
            std::string::npos)
      << doctor;
  EXPECT_EQ(doctor.find("Exit status"), std::string::npos) << doctor;
  EXPECT_EQ(doctor.find("done and sound"), std::string::npos) << doctor;
}

/// The words that shells offer are those of the help.
TEST(Manual, CompletesTheProcessesInEveryShell) {
  const std::string help = claystack("export --help").out;
  const std::string words = "fdm sla earthenware stoneware porcelain";
  EXPECT_NE(help.find("fdm, sla, earthenware, stoneware, porcelain, or a .json"), help.npos);
  for (const auto& [shell, line] :
       {std::pair("bash", "export:--process) words='" + words + "' files=1"),
        std::pair("zsh", "_alternative 'words:word:(" + words + ")' 'files:file:_files'"),
        std::pair("zsh", std::string(":PROCESS:_claystack_process'")),
        std::pair("fish", " -l process -r -F -a '" + words + "'"),
        std::pair("fish", std::string("'__fish_seen_subcommand_from help' -a"))}) {
    const std::string script = claystack("manual " + std::string(shell)).out;
    EXPECT_NE(script.find(line), std::string::npos) << shell << ": " << line;
  }
}

}  // namespace
}  // namespace clay::test
