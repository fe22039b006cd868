#pragma once
// Splits a text mesh file into words with line numbers. The first fault is kept, as in an input
// stream: after it every read returns empty, so that a parser can check for errors once at its end.

#include "export/formats/byte_stream.hpp"

#include "claystack/core/result.hpp"

#include "core/text.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::solid::inline formats {

/// `comments`: a '#' begins a comment, which ends with its line. `comments_and_continuation`: also,
/// a backslash at the end of a line continues it.
enum class LineRule { plain, comments, comments_and_continuation };

/// Of lines [KiB]; the longer ones are for formats whose faces may have any number of corners.
inline constexpr std::size_t kUsualLineKib = 64, kLongLineKib = 16 * 1024;

class TextScanner {
 public:
  /// Skips a byte order mark. Reports a NUL byte or a longer line than `most_kib`, up to a megabyte
  /// before the parser reaches it. The stream and the name outlive this.
  TextScanner(ByteStream& text, std::string_view name, LineRule rule,
              std::size_t most_kib = kUsualLineKib);

  /// The next word on this line or a later one; empty at the end of the text. The view is valid
  /// until the next read.
  std::string_view word();
  /// The next word on this line; empty at its end, and at a comment.
  std::string_view word_in_line();
  /// Whether the words of this line end at a comment.
  [[nodiscard]] bool at_comment() const noexcept;
  void skip_line();

  /// Ignores case, because writers differ.
  void expect(std::string_view keyword);
  /// A number that does not change the surface, such as a part of a normal: it may be NaN or
  /// infinite, as some programs write for triangles without area. These are counted.
  void unused_number(std::string_view word);
  float coordinate(std::string_view word);
  long long whole_number(std::string_view word);

  void fail(std::string_view what) { fail_at(line_, what); }
  void fail_at(std::size_t line, std::string_view what);
  /// "expected WHAT, found 'WORD'".
  void fail_expected(std::string_view what, std::string_view found);
  [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  /// A note on the unused numbers that are not finite, if there are any; `notes` may be null.
  void note_not_finite(std::vector<std::string>* notes) const;

 private:
  bool next_lines();
  void check_lines(std::size_t line);
  void skip_blanks();
  void leave_line();
  [[nodiscard]] std::size_t continuation_length() const noexcept;

  ByteStream& stream_;
  std::string_view text_;  ///< the complete lines in memory
  std::string_view name_;
  LineRule rule_;
  std::size_t most_line_;  ///< bytes
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t not_finite_ = 0, not_finite_line_ = 0;  ///< unused numbers; the first
  std::optional<Error> fault_;
};

/// Parsed directly as float32; values too small for it are 0. Empty: not a number, or too large.
[[nodiscard]] std::optional<float> parse_float(std::string_view word) noexcept;

/// Text of a file for a message: in single quotes, shortened, without characters that do not print.
[[nodiscard]] std::string quoted(std::string_view text);

/// The same of a word; if it is empty, "the end of the line or file".
[[nodiscard]] std::string shown_word(std::string_view word);

/// "line 3: 2 lines before the mesh were not read"; `where` is "before" or "after".
[[nodiscard]] std::string stray_lines_note(std::size_t first_line, std::size_t count,
                                           std::string_view where);

/// ASCII only, independent of the locale.
[[nodiscard]] bool equal_ignoring_case(std::string_view word, std::string_view lower) noexcept;

}  // namespace clay::solid::inline formats
