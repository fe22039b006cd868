#include "export/formats/step_text.hpp"

#include "core/number_parsing.hpp"
#include "export/formats/character_set.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace clay::solid::inline formats {
namespace {

constexpr int kDeepest = 32;
constexpr CharacterSet kBlank(" \t\n\v\f\r"), kWordEnd(" \t\n\v\f\r(),;=");

class StepParser {
 public:
  StepParser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  Result<StepFile> parse() {
    const std::size_t data = text_.find("\nDATA;");
    if (!text_.starts_with("ISO-10303-21;") || data == text_.npos)
      return wrong("a STEP file (ISO-10303-21) with a DATA section");
    at_ = data + 6;
    while (true) {
      skip_blanks();
      if (text_.substr(at_).starts_with("ENDSEC;")) break;
      const std::size_t number = file_.entities.size() + 1;
      if (step_number(word()) != number || !take('='))
        return wrong("#" + std::to_string(number) + "=");
      const auto value = parse_value(0);
      if (!value || value->size == 0 || !take(';')) return wrong("an entity that ends in ';'");
      file_.entities.push_back(*value);
    }
    if (text_.find("END-ISO-10303-21;", at_) == text_.npos) return wrong("END-ISO-10303-21;");
    return std::move(file_);
  }

 private:
  tl::unexpected<Error> wrong(const std::string& expected) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at_), '\n');
    return failure(ErrorKind::bad_input, std::string(name_)
                                             .append(":")
                                             .append(std::to_string(line))
                                             .append(": expected ")
                                             .append(expected));
  }

  void skip_blanks() {
    while (at_ < text_.size() && kBlank.has(text_[at_])) ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  /// Everything up to a bracket or separator, or a quoted text.
  std::string_view word() {
    skip_blanks();
    const std::size_t begin = at_;
    if (at_ < text_.size() && text_[at_] == '\'') {
      for (++at_; at_ < text_.size(); ++at_)
        if (text_[at_] == '\'' && !(at_ + 1 < text_.size() && text_[at_ + 1] == '\'' && ++at_))
          break;
      at_ = std::min(at_ + 1, text_.size());
    } else {
      at_ = kWordEnd.find_in(text_, at_);
    }
    return text_.substr(begin, at_ - begin);
  }

  std::optional<StepValue> parse_value(int depth) {
    if (depth > kDeepest) return std::nullopt;
    StepValue value{word()};
    if (!take('(')) return value.word.empty() ? std::nullopt : std::optional(value);
    const bool complex = depth == 0 && value.word.empty();
    const std::size_t outside = open_.size();
    while (!take(')')) {
      if (!complex && open_.size() > outside && !take(',')) return std::nullopt;
      const auto item = parse_value(depth + 1);
      if (!item) return std::nullopt;
      open_.push_back(*item);
    }
    value.first = file_.lists.size();
    value.size = open_.size() - outside;
    const auto items = open_.begin() + std::ptrdiff_t(outside);
    file_.lists.insert(file_.lists.end(), items, open_.end());
    open_.erase(items, open_.end());
    return value;
  }

  std::string_view text_, name_;
  std::size_t at_ = 0;
  StepFile file_;
  std::vector<StepValue> open_;  ///< items of the lists whose end is not read yet
};

}  // namespace

std::size_t step_number(std::string_view word) noexcept {
  if (!word.starts_with('#')) return 0;
  return parse_number<std::size_t>(word.substr(1)).value_or(0);
}

Result<StepFile> parse_step(std::string_view text, std::string_view name) {
  return StepParser(text, name).parse();
}

}  // namespace clay::solid::inline formats
