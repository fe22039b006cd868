#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace clay::cli {

/// "fair, exact or none".
[[nodiscard]] inline std::string choice_of(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text.append(i == 0 ? "" : i + 1 == words.size() ? " or " : ", ").append(words[i]);
  return text;
}

}  // namespace clay::cli
