#pragma once
// Kinds of characters in text files: one look-up for each character.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace clay::solid::inline formats {

class CharacterSet {
 public:
  explicit constexpr CharacterSet(std::string_view characters) {
    for (const char c : characters) in_[static_cast<unsigned char>(c)] = true;
  }
  [[nodiscard]] constexpr bool has(char c) const noexcept {
    return in_[static_cast<unsigned char>(c)];
  }
  /// The place of the first of them at `from` or later; the size of the text if there is none.
  [[nodiscard]] std::size_t find_in(std::string_view text, std::size_t from) const noexcept {
    const auto found = std::find_if(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(),
                                    [this](char c) { return has(c); });
    return static_cast<std::size_t>(found - text.begin());
  }

 private:
  std::array<bool, 256> in_{};
};

}  // namespace clay::solid::inline formats
