#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace clay {

/// Splits a text into complete lines and counts them.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  /// Empty at the end, and for a last line without its newline.
  std::optional<std::string_view> next() {
    const auto newline = rest_.find('\n');
    if (newline == std::string_view::npos) return std::nullopt;
    const auto line = rest_.substr(0, newline);
    rest_.remove_prefix(newline + 1);
    ++number_;
    return line;
  }
  [[nodiscard]] std::string_view rest() const noexcept { return rest_; }
  [[nodiscard]] std::size_t number() const noexcept { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

}  // namespace clay
