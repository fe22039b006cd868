#include "tests/app/import/generated_drawings.hpp"

#include <gtest/gtest.h>

namespace clay::importing {
namespace {

// compare_drawings does the same for any number of drawings.
TEST(GeneratedDrawings, ImportAsTheyArePainted) {
  for (const char* format : {"svg", "dxf", "csv"})
    for (unsigned number = 0; number < 7; ++number)
      EXPECT_EQ(generated::difference(format, number), "");
}

}  // namespace
}  // namespace clay::importing
