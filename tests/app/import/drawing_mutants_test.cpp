#include "tests/fuzz/drawing_promise.hpp"

#include <gtest/gtest.h>

namespace clay::importing {
namespace {

class DrawingMutants : public testing::TestWithParam<const char*> {};

TEST_P(DrawingMutants, GoodDrawingsMakePots) {
  for (const std::string& bytes : samples::good_drawings(GetParam())) {
    const std::string name = std::string("good.") + GetParam();
    const auto drawing = read_drawing(bytes, name);
    ASSERT_TRUE(drawing) << drawing.error().message;
    const auto section = half_section(*drawing, {}, name);
    EXPECT_TRUE(section) << section.error().message << bytes;
  }
}

TEST_P(DrawingMutants, GiveAPotOrAnError) {
  const auto broken = samples::first_broken(GetParam(), 1, 1000, [](const std::string&) {});
  EXPECT_FALSE(broken) << *broken;
}

INSTANTIATE_TEST_SUITE_P(Formats, DrawingMutants, testing::Values("dxf", "svg", "csv"));

}  // namespace
}  // namespace clay::importing
