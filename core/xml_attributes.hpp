#pragma once
// A limit on the attributes of a tag, for XML that libxml2 reads: it compares each of them with all
// others, so that one tag of a megabyte would take half a minute. The tags are counted before
// libxml2 gets them, because it calls no handler within a tag.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace clay {

class XmlAttributeLimit {
 public:
  static constexpr std::size_t kMost = 1000;  ///< attributes of one tag

  struct Fault {
    std::size_t line = 1;
    std::string what;  ///< "expected ..., found ..."
  };

  /// The next bytes of a file. An attribute is an `=` outside quotation marks; `<` begins a new tag
  /// anywhere, because XML forbids it in values. Refuses encodings in which other bytes than those
  /// of ASCII mean `<` and `=`, except UTF-16.
  [[nodiscard]] std::optional<Fault> take(std::string_view piece);

  /// Whether characters have two bytes each, or more.
  [[nodiscard]] bool wide() const noexcept { return width_ > 1; }

 private:
  [[nodiscard]] bool begin();
  void take_narrow(std::string_view piece);
  void take_wide(std::string_view piece);
  void take_character(char c);
  void take_declaration(char c);
  void expect_encoding();

  std::string head_;         ///< the first bytes, until they show the width of characters
  std::size_t width_ = 0;    ///< bytes of a character; 0: unknown yet
  bool high_first_ = false;  ///< the byte order of wide characters
  std::optional<char> odd_;  ///< the first byte of a wide character
  std::string declaration_;  ///< from the beginning of the file
  bool declared_ = false;    ///< `declaration_` is complete, or there is none
  std::size_t line_ = 1, attributes_ = 0;
  bool opened_ = false, in_tag_ = false;
  char quote_ = '\0';  ///< of the value that the tag is in
  std::optional<Fault> fault_;
};

}  // namespace clay
