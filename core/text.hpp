#pragma once
// Formats numbers, words and kinds of files for messages.
#include "claystack/core/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace clay {

/// The shortest decimal that reads back as the same number. (std::to_string prints 1e-9 as
/// 0.000000, and 300 digits of 1e300.)
[[nodiscard]] std::string number_text(double value);
/// Six significant digits, with an exponent where the number is very large or small.
[[nodiscard]] std::string short_number_text(double value);
/// Nine significant digits: enough to distinguish neighbouring float32 values.
[[nodiscard]] std::string nine_digit_text(double value);
/// "1 warning", "2 warnings": for nouns with a plural in s.
[[nodiscard]] std::string counted(std::size_t count, std::string_view noun);

/// "expected the number of a vertex, from 1 to 8": of 8 vertices that are counted from 1.
[[nodiscard]] std::string expected_number(std::string_view of_what, std::size_t first,
                                          std::size_t count);

/// The text with a capital letter at its beginning.
[[nodiscard]] std::string sentence(std::string text);
/// A name for scripts as words: "needs homing" of "needs_homing".
[[nodiscard]] std::string words_of_name(std::string_view name);

/// Whether the file has the size that the number of triangles in its head states, above 0.
[[nodiscard]] bool is_binary_stl(std::string_view head, std::uint64_t file_bytes);
/// The kind of a file by its first bytes, such as "a Draco mesh" or "a pot"; empty if unknown.
[[nodiscard]] std::string_view known_kind(std::string_view bytes);
/// The same for a message; if unknown, "text that begins with 'abc'" or "binary data".
[[nodiscard]] std::string kind_of_file(std::string_view bytes);
/// The error of a reader that expected another kind of file: "NAME: expected a pot (.pot.json),
/// found an STL mesh". `expected` begins with the kind as known_kind names it; if the file is of
/// that kind, or of an unknown one, the reader's own error.
[[nodiscard]] Error kind_error(Error error, std::string_view bytes, std::string_view name,
                               std::string_view expected);
/// Whether the text ends in `ending`, which is in lower case; ASCII only, independent of the
/// locale.
[[nodiscard]] bool ends_ignoring_case(std::string_view text, std::string_view ending) noexcept;

/// The name of a file without its folder and its kind: "bowl" of "pots/bowl.pot.json", "v1.2" of
/// "v1.2.3mf", "pot" of "-", which is a stream.
[[nodiscard]] std::string name_of_file(std::string_view path);

/// Text of unknown origin for a message: at most `most` characters, then "..."; bytes that are not
/// UTF-8, and characters that control, hide or reorder text, become '?'.
[[nodiscard]] std::string shown(std::string_view text, std::size_t most = 40);

/// Invalid UTF-8, and characters that XML forbids, become U+FFFD: file names may hold any bytes.
[[nodiscard]] std::string valid_text(std::string_view text);

/// The text without a leading UTF-8 byte order mark.
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text) noexcept;

}  // namespace clay
