#pragma once
// Numbers and files as messages for people show them.
#include <string>
#include <string_view>

namespace clay {

/// The shortest decimal that reads back as the same number. std::to_string gives 1e-9 as 0.000000,
/// and 300 digits of 1e300.
[[nodiscard]] std::string number_text(double value);
/// Six significant digits, with an exponent where the number is very large or small.
[[nodiscard]] std::string short_number_text(double value);
/// Nine significant digits: enough to tell two neighbouring float32 apart.
[[nodiscard]] std::string in_mm(double mm);

/// What a file is by its first bytes, such as "a Draco mesh"; empty where they do not say.
[[nodiscard]] std::string_view known_kind(std::string_view bytes);
/// The same for a message; else "text that begins with 'abc'", "binary data".
[[nodiscard]] std::string kind_of_file(std::string_view bytes);
/// The text behind a byte order mark of UTF-8, where it begins with one.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text) noexcept;

}  // namespace clay
