#include "export/formats/step_text.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

namespace clay::solid::inline formats {
namespace {

constexpr int kDeepest = 32;

bool ends_word(char c) {
  switch (c) {
    case '(':
    case ')':
    case ',':
    case ';':
    case '=':
    case ' ':
    case '\n':
    case '\r':
    case '\t':
      return true;
    default:
      return false;
  }
}

class StepParser {
 public:
  StepParser(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  Result<StepEntities> parse() {
    const std::size_t data = text_.find("\nDATA;");
    if (!text_.starts_with("ISO-10303-21;") || data == text_.npos)
      return wrong("a STEP file (ISO-10303-21) with a DATA section");
    at_ = data + 6;
    StepEntities entities;
    while (true) {
      skip_blanks();
      if (text_.substr(at_).starts_with("ENDSEC;")) break;
      const std::string ref = word();
      if (!ref.starts_with('#') || !take('=')) return wrong("#NUMBER=");
      auto value = parse_value(0);
      if (!value || value->items.empty() || !take(';')) return wrong("an entity that ends in ';'");
      if (!entities.emplace(ref, std::move(*value)).second)
        return wrong("a new number, not " + ref);
    }
    if (text_.find("END-ISO-10303-21;", at_) == text_.npos) return wrong("END-ISO-10303-21;");
    return entities;
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
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  /// Everything up to a bracket or separator, or a quoted text.
  std::string word() {
    skip_blanks();
    const std::size_t begin = at_;
    if (at_ < text_.size() && text_[at_] == '\'') {
      for (++at_; at_ < text_.size(); ++at_)
        if (text_[at_] == '\'' && !(at_ + 1 < text_.size() && text_[at_ + 1] == '\'' && ++at_))
          break;
      at_ = std::min(at_ + 1, text_.size());
    } else {
      while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
    }
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::optional<StepValue> parse_value(int depth) {
    if (depth > kDeepest) return std::nullopt;
    StepValue value{word(), {}};
    if (!take('(')) return value.word.empty() ? std::nullopt : std::optional(std::move(value));
    const bool complex = depth == 0 && value.word.empty();
    while (!take(')')) {
      if (!complex && !value.items.empty() && !take(',')) return std::nullopt;
      auto item = parse_value(depth + 1);
      if (!item) return std::nullopt;
      value.items.push_back(std::move(*item));
    }
    return value;
  }

  std::string_view text_, name_;
  std::size_t at_ = 0;
};

}  // namespace

Result<StepEntities> parse_step(std::string_view text, std::string_view name) {
  return StepParser(text, name).parse();
}

}  // namespace clay::solid::inline formats
