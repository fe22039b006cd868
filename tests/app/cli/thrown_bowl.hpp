#pragma once
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clay::test {

/// The sample bowl, thrown by the program.
class ThrownBowl : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(claystack("throw -q " + sample("bowl.scene.json") + " -o " + pot).status, 0);
  }
  ScratchFolder folder;
  std::string pot = folder.file("bowl.pot.json");
};

/// The sample bowl, and its export as an STL.
class ExportedBowl : public ThrownBowl {
 protected:
  [[nodiscard]] Ran run(const std::string& options) const {
    return claystack("export " + pot + " " + stl + " " + options);
  }
  std::string stl = folder.file("bowl.stl");
};

}  // namespace clay::test
