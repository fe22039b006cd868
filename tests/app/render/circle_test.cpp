#include "app/render/circle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clay::test {
namespace {

TEST(Circle, HasEqualAngles) {
  for (const std::size_t count :
       {std::size_t{4}, std::size_t{12}, std::size_t{24}, std::size_t{64}}) {
    const auto around = render::directions_around(count);
    ASSERT_EQ(around.size(), count);
    for (std::size_t k = 0; k < count; ++k) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
      EXPECT_NEAR(around[k].x, std::cos(angle), 1e-15) << count << ' ' << k;
      EXPECT_NEAR(around[k].y, std::sin(angle), 1e-15) << count << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace clay::test
