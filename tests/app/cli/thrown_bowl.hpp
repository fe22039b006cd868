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

}  // namespace clay::test
