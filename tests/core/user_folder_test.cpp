#include "core/user_folder.hpp"

#include <gtest/gtest.h>

namespace clay {
namespace {

TEST(CurrentFolder, IsEmptyWhenItHasBeenRemoved) {
  namespace fs = std::filesystem;
  const fs::path before = fs::current_path();
  EXPECT_EQ(current_folder(), before);
  const fs::path removed = fs::temp_directory_path() / "claystack-removed";
  fs::create_directory(removed);
  fs::current_path(removed);
  fs::remove(removed);
  EXPECT_EQ(current_folder(), fs::path());
  fs::current_path(before);
}

}  // namespace
}  // namespace clay
