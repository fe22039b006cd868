#pragma once
// The window without a screen, driven by scripts.

#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::test {

class Window : public ::testing::Test {
 protected:
  /// Runs a script on the sample bowl; FOLDER in it is the folder of this test.
  Ran run(std::string script, const std::string& options = "--size 960x640") {
    for (auto at = script.find("FOLDER"); at != std::string::npos; at = script.find("FOLDER"))
      script.replace(at, 6, folder.path().string());
    write_text(folder.file("s"), script);
    return claystack("studio " + test::sample("bowl.scene.json") + " --script " + folder.file("s") +
                     " " + options);
  }
  /// Colour of a pixel as ImageMagick reads it: "r g b".
  std::string pixel(const std::string& picture, int x, int y) {
    const std::string at = "p{" + std::to_string(x) + "," + std::to_string(y) + "}";
    return shell("convert " + folder.file(picture) + " -format \"%[fx:round(255*" + at +
                 ".r)] %[fx:round(255*" + at + ".g)] %[fx:round(255*" + at + ".b)]\" info:")
        .out;
  }
  ScratchFolder folder;
};

inline constexpr const char* kPress =
    "key 1\n"
    "point 65 18\npress left\nexpect throwing yes\n"
    "point 56 18 over 0.4\nwait 0.2\nexpect contact yes\n"
    "point 65 18 over 0.3\nwait 0.2\nrelease left\nexpect throwing no\n";

/// Deeper than the groove of kPress.
inline constexpr const char* kDeeper =
    "point 65 18\npress left\npoint 48 18 over 0.4\nwait 0.2\nexpect contact yes\n"
    "point 65 18 over 0.3\nwait 0.2\nrelease left\n";

}  // namespace clay::test
