#include "export/formats/text_scanner.hpp"

#include "core/cancel.hpp"
#include "core/lower_case.hpp"
#include "core/number_parsing.hpp"
#include "core/text.hpp"
#include "export/formats/character_set.hpp"
#include "export/formats/mesh_limits.hpp"

#include <algorithm>
#include <cmath>

namespace clay::solid::inline formats {
namespace {

/// A newline is no blank: it ends a line. '#' and '\\' end a word only at a comment or
/// continuation.
constexpr CharacterSet kBlank(" \t\r\v\f"), kMayEndWord(" \t\r\v\f\n#\\");

/// from_chars accepts no '+', but text files contain it.
std::string_view without_plus(std::string_view word) noexcept {
  const bool plain_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return plain_plus ? word.substr(1) : word;
}

template <class Number>
std::optional<Number> parse(std::string_view word) noexcept {
  word = without_plus(word);
  Number value{};
  const auto [end, error] = from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

/// Parses directly to float32, because a detour by double may round twice. Values too small for
/// float32 are out of range for from_chars, and become 0.
std::optional<float> parse_float(std::string_view word) noexcept {
  if (const auto direct = parse<float>(word)) return direct;
  const auto wide = parse<double>(word);
  if (wide && std::abs(*wide) < 1.0) return 0.0F;
  return std::nullopt;
}

/// Also removes the control characters of terminals.
std::string quoted(std::string_view text) {
  return std::string("'").append(shown(text)).append("'");
}

std::string shown_word(std::string_view word) {
  return word.empty() ? "the end of the line or file" : quoted(word);
}

std::string stray_lines_note(std::size_t first_line, std::size_t count, std::string_view where) {
  return ("line " + std::to_string(first_line) + ": " + counted(count, "line") + " ")
      .append(where)
      .append(count == 1 ? " the mesh was not read" : " the mesh were not read");
}

bool equal_ignoring_case(std::string_view word, std::string_view lower) noexcept {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return lower_case(a) == b; });
}

TextScanner::TextScanner(ByteStream& text, std::string_view name, LineRule rule,
                         std::size_t most_kib)
    : stream_(text), name_(name), rule_(rule), most_line_(most_kib * 1024) {
  if (!next_lines()) return;
  at_ = text_.size() - without_byte_order_mark(text_).size();
  check_lines(line_);
}

/// Returns false at the end; `text_` is then empty.
bool TextScanner::next_lines() {
  if (fault_) return false;
  stream_.take(text_.size());
  bool more = stream_.fill(ByteStream::kStretch);
  text_ = stream_.ahead();
  while (more && text_.size() <= most_line_ && text_.find('\n') == text_.npos) {
    more = stream_.fill(text_.size() + ByteStream::kStretch);
    text_ = stream_.ahead();
  }
  at_ = 0;
  if (stream_.fault()) {
    fault_ = stream_.fault();
    text_ = {};
  }
  // Keeps the start of an overlong line, which is then reported as too long.
  if (const std::size_t end = text_.rfind('\n'); more && end != text_.npos)
    text_ = text_.substr(0, end + 1);
  return !text_.empty();
}

void TextScanner::check_lines(std::size_t line) {
  const std::size_t nul = text_.find('\0');
  for (std::size_t begin = 0; begin < text_.size(); ++line) {
    step_of_loop();
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    if (nul < end) return fail_at(line, "expected text, found a NUL byte");
    if (end - begin > most_line_)
      return fail_at(line,
                     "expected a line of at most " + std::to_string(most_line_ / 1024) + " KiB");
    begin = end + 1;
  }
}

std::string_view TextScanner::word() {
  for (;;) {
    const std::string_view found = word_in_line();
    if (!found.empty() || at_ >= text_.size()) return found;
    leave_line();
  }
}

std::string_view TextScanner::word_in_line() {
  step_of_loop();
  skip_blanks();
  const std::size_t begin = at_;
  while (true) {
    at_ = kMayEndWord.find_in(text_, at_);
    if (at_ == text_.size() || kBlank.has(text_[at_]) || text_[at_] == '\n' ||
        continuation_length() > 0 || at_comment())
      break;
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

bool TextScanner::at_comment() const noexcept {
  if (rule_ == LineRule::plain || at_ >= text_.size() || text_[at_] != '#') return false;
  return at_ == 0 || text_[at_ - 1] != '.';  // some programs write NaN as 1.#IND
}

void TextScanner::skip_line() {
  while (!word_in_line().empty()) {
  }
  leave_line();
}

void TextScanner::skip_blanks() {
  while (at_ < text_.size()) {
    if (kBlank.has(text_[at_])) {
      ++at_;
    } else if (const std::size_t joint = continuation_length(); joint > 0) {
      at_ += joint;
      ++line_;
      if (at_ == text_.size() && next_lines()) check_lines(line_);
    } else {
      return;
    }
  }
}

/// Moves to the next line, if there is one: the last line keeps its number for messages. A
/// backslash does not continue a comment: a path in a comment may end with one, and would hide the
/// next line.
void TextScanner::leave_line() {
  const std::size_t newline = std::min(text_.find('\n', at_), text_.size());
  at_ = std::min(newline + 1, text_.size());
  if (at_ < text_.size()) {
    ++line_;
  } else if (next_lines()) {
    check_lines(++line_);
  }
}

std::size_t TextScanner::continuation_length() const noexcept {
  if (rule_ != LineRule::comments_and_continuation || text_[at_] != '\\') return 0;
  const std::string_view rest = text_.substr(at_ + 1, 2);
  if (rest.starts_with('\n')) return 2;
  return rest == "\r\n" ? 3 : 0;
}

void TextScanner::expect(std::string_view keyword) {
  const std::string_view found = word();
  if (!equal_ignoring_case(found, keyword)) fail_expected(keyword, found);
}

void TextScanner::unused_number(std::string_view word) {
  const auto value = parse<double>(word.substr(0, word.find(".#")));  // as of "-1.#IND"
  if (!value) return fail_expected("a number", word);
  const bool finite = std::isfinite(*value) && word.find(".#") == word.npos;
  if (!finite && not_finite_++ == 0) not_finite_line_ = line_;
}

void TextScanner::note_not_finite(std::vector<std::string>* notes) const {
  if (notes == nullptr || not_finite_ == 0) return;
  notes->push_back("line " + std::to_string(not_finite_line_) + ": NaN or infinity in " +
                   counted(not_finite_, "number") +
                   " of normals or other attributes, which are not used");
}

float TextScanner::coordinate(std::string_view word) {
  const auto value = parse_float(word);
  if (value && is_coordinate(*value)) return *value;
  fail_expected(kCoordinateRule, word);
  return 0.0F;
}

long long TextScanner::whole_number(std::string_view word) {
  const auto value = parse<long long>(word);
  if (value) return *value;
  fail_expected("a whole number", word);
  return 0;
}

void TextScanner::fail_expected(std::string_view what, std::string_view found) {
  fail(std::string("expected ").append(what).append(", found ").append(shown_word(found)));
}

void TextScanner::fail_at(std::size_t line, std::string_view what) {
  if (!fault_) {
    fault_ = Error{
        ErrorKind::bad_input,
        std::string(name_).append(":").append(std::to_string(line)).append(": ").append(what)};
  }
  text_ = {};
  at_ = 0;
}

}  // namespace clay::solid::inline formats
