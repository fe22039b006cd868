// The user of the machine may open each device that the driver supports.

#include "claystack/falcon/usb.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace clay::falcon {
namespace {

std::vector<std::string> rules() {
  std::ifstream file(CLAYSTACK_UDEV_RULES);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line[0] != '#') lines.push_back(line);
  return lines;
}

std::string digits(unsigned id) {
  char text[5];
  std::snprintf(text, sizeof text, "%04x", id);
  return text;
}

bool covers(const std::string& rule, const SpaceMouseModel& model) {
  const auto names = [&rule](const std::string& text) {
    return rule.find(text) != std::string::npos;
  };
  return names(digits(model.vendor)) && (!names("idProduct") || names(digits(model.product)));
}

TEST(UdevRules, CoverEveryDeviceAndSortBeforeSeatRules) {
  const auto lines = rules();
  ASSERT_GE(lines.size(), 4u);
  for (const std::string& rule : lines)
    EXPECT_NE(rule.find("TAG+=\"uaccess\""), std::string::npos) << rule;
  for (const SpaceMouseModel& model : space_mouse_models()) {
    bool covered = false;
    for (const std::string& rule : lines) covered |= covers(rule, model);
    EXPECT_TRUE(covered) << model.name;
  }
  EXPECT_NE(lines[0].find("\"cb48\""), std::string::npos);
  const std::string path = CLAYSTACK_UDEV_RULES;
  EXPECT_LT(path.substr(path.rfind('/') + 1), "73-seat-late.rules");
}

}  // namespace
}  // namespace clay::falcon
