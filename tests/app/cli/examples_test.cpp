// Every example of every help text, run in an empty folder with the samples as they are installed.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace clay::test {
namespace {

/// The lines below "Examples:" that are commands.
std::vector<std::string> examples_in(const std::string& help) {
  std::vector<std::string> examples;
  std::istringstream lines(help.substr(std::min(help.find("Examples:"), help.size())));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  claystack ")) examples.push_back(line.substr(2));
  return examples;
}

/// As the parser lists them.
std::vector<std::string> commands() {
  std::vector<std::string> names;
  std::istringstream lines(claystack("--help").out);
  bool listed = false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (listed && begin == std::string::npos) break;
    if (listed) names.push_back(line.substr(begin, line.find(' ', begin) - begin));
    listed = listed || line.starts_with("Subcommands:");
  }
  return names;
}

/// A test must not move a real arm, and has no screen.
std::string harmless(std::string example) {
  for (const auto& [wanted, instead] :
       {std::pair("--device auto", "--device simulated --seconds 1"),
        {"devices falcon --firmware FILE --monitor", "devices simulated --monitor --seconds 1"}})
    if (const std::size_t at = example.find(wanted); at != std::string::npos)
      example.replace(at, std::string(wanted).size(), instead);
  return example;
}

/// A build without the benchmarks has no `bench`.
TEST(ExamplesOfTheProgram, NameCommandsThatItHas) {
  const std::vector<std::string> names = commands();
  const auto examples = examples_in(claystack("--help").out);
  EXPECT_FALSE(examples.empty());
  for (const std::string& example : examples) {
    std::istringstream words(example);
    std::string program, name;
    words >> program >> name;
    EXPECT_TRUE(name == "help" || std::ranges::find(names, name) != names.end()) << example;
  }
}

class Examples : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* component : {"program", "studio"}) {
      const Ran installed =
          shell(CLAYSTACK_INSTALL " --prefix " + folder_.file("usr") + " --component " + component);
      ASSERT_EQ(installed.status, 0) << installed.err;
    }
  }

  /// Runs an example with the installed program, in a separate folder.
  [[nodiscard]] Ran run(const std::string& folder, const std::string& example) const {
    return shell("cd " + folder + " && env -u DISPLAY -u WAYLAND_DISPLAY HOME=" + folder +
                 " PATH=" + folder_.file("usr/bin") + ":$PATH " + example);
  }

  const ScratchFolder folder_;
};

TEST_F(Examples, OfEveryCommandRunInTheirOrder) {
  std::vector<std::string> pages = commands();
  ASSERT_GE(pages.size(), 6u);
  pages.insert(pages.begin(), "");
  for (const std::string& page : pages) {
    const std::string folder = folder_.file("at-" + page);
    std::filesystem::create_directory(folder);
    std::filesystem::copy(folder_.file("usr/share/claystack/samples"), folder + "/samples",
                          std::filesystem::copy_options::recursive);
    const auto examples = examples_in(claystack("help " + page).out);
    EXPECT_FALSE(examples.empty()) << page;
    for (const std::string& example : examples) {
      if (example.starts_with("claystack bench")) continue;  // takes minutes
      const Ran ran = run(folder, harmless(example));
      // Without a screen the window fails, and the doctor reports that.
      const bool screen = example.starts_with("claystack studio") && ran.status == 4;
      const bool doctor = example.starts_with("claystack doctor") && ran.status == 1;
      EXPECT_TRUE(ran.status == 0 || screen || doctor)
          << page << ": " << example << " ended with " << ran.status << "\n"
          << ran.err;
    }
  }
}

TEST_F(Examples, NameFilesThatAreInstalledOrMade) {
  for (const std::string& page : commands())
    for (const std::string& example : examples_in(claystack("help " + page).out)) {
      static const std::regex kSample("samples/[^ ]+");
      for (std::sregex_iterator at(example.begin(), example.end(), kSample), end; at != end; ++at)
        EXPECT_TRUE(std::filesystem::exists(folder_.file("usr/share/claystack/" + at->str())))
            << example;
    }
}

/// The samples are not in the folder of a person who installed a package.
TEST_F(Examples, NameTheFolderOfTheirSamples) {
  for (const std::string& page : commands()) {
    if (page == "studio") continue;  // another program, which has the samples built in
    const std::string help = run(folder_.path().string(), "claystack help " + page).out;
    const bool uses_samples = help.find(" samples/") != std::string::npos;
    const std::string copy = "cp -r " + folder_.file("usr/share/claystack/samples") + " .";
    EXPECT_EQ(help.find(copy) != std::string::npos, uses_samples) << help;
  }
}

TEST_F(Examples, MatchInManualAndHelp) {
  for (const std::string& page : commands()) {
    std::string manual = claystack("manual " + page).out;
    for (std::size_t at = 0; (at = manual.find("\\-", at)) != std::string::npos;)
      manual.erase(at, 1);
    for (const std::string& example : examples_in(claystack("help " + page).out))
      EXPECT_NE(manual.find(example), std::string::npos) << page << ": " << example << manual;
  }
}

}  // namespace
}  // namespace clay::test
