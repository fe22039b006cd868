#pragma once
#include "core/size_text.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace clay {

/// For text and attributes of SVG and HTML. Invalid UTF-8, and characters that XML forbids, become
/// U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// Elements of SVG, one after the other. Values of attributes and text are escaped.
class SvgWriter {
 public:
  /// An attribute with an empty value is left out.
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

  void element(std::string_view name, Attributes attributes, std::string_view text = {});
  /// Begins an element, which ends with close().
  void open(std::string_view name, Attributes attributes);
  void close(std::string_view name);
  /// As it is: elements of another writer, or a style sheet.
  void raw(std::string_view svg) { svg_ += svg; }
  /// Everything so far.
  [[nodiscard]] std::string take() { return std::exchange(svg_, {}); }

 private:
  void begin(std::string_view name, Attributes attributes);

  std::string svg_;
};

}  // namespace clay
