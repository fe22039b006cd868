#include "core/xml_attributes.hpp"

#include "core/lower_case.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace clay {
namespace {

constexpr std::size_t kHeadBytes = 4, kMostDeclaration = 256;

/// Those in which the bytes of `<`, `=` and quotation marks are no part of another character.
constexpr std::array<std::string_view, 11> kEncodings{"utf-8",  "utf8",   "us-ascii", "ascii",
                                                      "gb2312", "gbk",    "gb18030",  "big5",
                                                      "euc-jp", "euc-kr", "shift_jis"};
constexpr std::array<std::string_view, 3> kFamilies{"iso-8859-", "windows-125", "koi8-"};

bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}

/// In lower case; empty if the declaration names none.
std::string encoding_in(std::string_view declaration) {
  constexpr std::string_view kKey = "encoding", kBlank = " \t\r\n";
  std::size_t at = declaration.find(kKey);
  if (at == declaration.npos) return {};
  at += kKey.size();
  if (declaration.find(kKey, at) != declaration.npos) return "twice";  // in another value
  at = declaration.find_first_not_of(kBlank, at);
  if (at == declaration.npos || declaration[at] != '=') return {};
  at = declaration.find_first_not_of(kBlank, at + 1);
  if (at == declaration.npos) return {};
  return lower_case(declaration.substr(at + 1, declaration.find(declaration[at], at + 1) - at - 1));
}

}  // namespace

std::optional<XmlAttributeLimit::Fault> XmlAttributeLimit::take(std::string_view piece) {
  if (width_ == 0) {
    const std::size_t count = std::min(kHeadBytes - head_.size(), piece.size());
    head_ += piece.substr(0, count);
    piece.remove_prefix(count);
    if (head_.size() < kHeadBytes) return {};
    if (!begin()) return fault_;
    const std::string head = std::move(head_);
    if (auto fault = take(head)) return fault;
  }
  if (width_ == 1)
    take_narrow(piece);
  else
    take_wide(piece);
  return fault_;
}

void XmlAttributeLimit::take_narrow(std::string_view piece) {
  while (!piece.empty() && !fault_) {
    if (declared_ && piece.front() == '<') {
      // Each `<` starts the count again, and a tag of at most kMost bytes has fewer attributes. So
      // only the last `<` within that distance matters.
      const auto last = static_cast<std::ptrdiff_t>(piece.rfind('<', kMost));
      line_ += static_cast<std::size_t>(std::count(piece.begin(), piece.begin() + last, '\n'));
      piece.remove_prefix(static_cast<std::size_t>(last));
    }
    take_character(piece.front());
    piece.remove_prefix(1);
  }
}

void XmlAttributeLimit::take_wide(std::string_view piece) {
  for (const char c : piece) {
    if (fault_) break;
    if (!odd_) {
      odd_ = c;
      continue;
    }
    const char high = high_first_ ? *odd_ : c, low = high_first_ ? c : *odd_;
    take_character(high == '\0' ? low : '\x80');
    odd_.reset();
  }
}

/// Finds the width of characters, as libxml2 does, and passes over a byte order mark.
bool XmlAttributeLimit::begin() {
  using namespace std::string_view_literals;
  const std::string_view head = head_;
  const bool four = head == "\0\0\0<"sv || head == "<\0\0\0"sv || head == "\0\0\xFE\xFF"sv ||
                    head == "\xFF\xFE\0\0"sv || head == "\0\0<\0"sv || head == "\0<\0\0"sv;
  if (four || head == "\x4C\x6F\xA7\x94"sv) {
    fault_ = Fault{1, std::string("expected UTF-8 or UTF-16, found ")
                          .append(four ? "characters of four bytes" : "EBCDIC")};
    return false;
  }
  high_first_ = head.starts_with("\xFE\xFF"sv) || head.starts_with("\0<"sv);
  const bool low_first = head.starts_with("\xFF\xFE"sv) || head.starts_with("<\0"sv);
  width_ = high_first_ || low_first ? 2 : 1;
  if (width_ == 2 && !head.starts_with('<') && !head.starts_with('\0')) head_.erase(0, 2);
  if (head.starts_with("\xEF\xBB\xBF")) head_.erase(0, 3);
  return true;
}

void XmlAttributeLimit::take_character(char c) {
  if (!declared_) take_declaration(c);
  if (c == '\n') ++line_;
  if (c == '<') {
    opened_ = true;
    in_tag_ = false;
    return;
  }
  if (opened_) {
    opened_ = false;
    in_tag_ = begins_name(c);
    quote_ = '\0';
    attributes_ = 0;
  }
  if (!in_tag_) return;
  if (quote_ != '\0') {
    if (c == quote_) quote_ = '\0';
  } else if (c == '"' || c == '\'') {
    quote_ = c;
  } else if (c == '>') {
    in_tag_ = false;
  } else if (c == '=' && ++attributes_ > kMost) {
    fault_ = Fault{
        line_, "expected at most " + std::to_string(kMost) + " attributes of one tag, found more"};
  }
}

void XmlAttributeLimit::take_declaration(char c) {
  constexpr std::string_view kBegin = "<?xml";
  declaration_ += c;
  const std::size_t compared = std::min(declaration_.size(), kBegin.size());
  if (declaration_.compare(0, compared, kBegin, 0, compared) != 0) {
    declared_ = true;
  } else if (c == '>') {
    declared_ = true;
    expect_encoding();
  } else if (declaration_.size() > kMostDeclaration) {
    fault_ = Fault{line_, "expected an XML declaration of at most " +
                              std::to_string(kMostDeclaration) + " characters, found more"};
  }
}

void XmlAttributeLimit::expect_encoding() {
  const std::string name = encoding_in(declaration_);
  const auto begins = [&](std::string_view family) { return name.starts_with(family); };
  // libxml2 applies a declared byte order even if it is not that of the file.
  const bool known = wide() ? name == "utf-16" || name == "utf16" || name == "utf-8" ||
                                  name == (high_first_ ? "utf-16be" : "utf-16le")
                            : std::ranges::find(kEncodings, name) != kEncodings.end() ||
                                  std::ranges::any_of(kFamilies, begins);
  if (name.empty() || known) return;
  fault_ = Fault{line_, "expected the encoding UTF-8 or UTF-16, found '" + shown(name) + "'"};
}

}  // namespace clay
