#include "claystack/servo/servo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace clay::servo {
namespace {

TEST(LiveSettings, ErrorsNameTheSetting) {
  const auto refused = [](auto change) {
    LiveSettings settings;
    change(settings);
    const auto checked = check(settings);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(refused([](LiveSettings& s) { s.rate_hz = 100; }),
            "rate_hz: expected a value from 400 to 4000, found 100");
  EXPECT_EQ(refused([](LiveSettings& s) { s.rate_hz = 4000.0004; }),
            "rate_hz: expected a value from 400 to 4000, found 4000.0004");
  EXPECT_EQ(refused([](LiveSettings& s) { s.clay_rate_hz = 2000; }),
            "clay_rate_hz: expected a value from 20 to 1000, found 2000");
  EXPECT_NE(refused([](LiveSettings& s) { s.seconds = std::nan(""); }), "");
  EXPECT_NE(refused([](LiveSettings& s) { s.gap_mm = -1; }), "");
  EXPECT_EQ(refused([](LiveSettings&) {}), "");
}

}  // namespace
}  // namespace clay::servo
