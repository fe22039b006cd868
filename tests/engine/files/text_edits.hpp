#pragma once
#include "claystack/core/result.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace clay::test {

/// `text` with the first `from` replaced; fails the test if it is missing.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The line, from 1, on which `part` begins.
inline std::size_t line_of(std::string_view text, std::string_view part) {
  const auto at = text.find(part);
  EXPECT_NE(at, std::string_view::npos) << part;
  return 1 + static_cast<std::size_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// Expects an error of kind bad_input with exactly this message.
template <class T>
void expect_refused(const Result<T>& result, const std::string& message) {
  ASSERT_FALSE(result) << "accepted, expected: " << message;
  EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
  EXPECT_EQ(result.error().message, message);
}

}  // namespace clay::test
