#pragma once
// The document that svg_shapes fills: elements with their geometry alone.

#include <libxml/tree.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace clay::importing {

using XmlDocument = std::unique_ptr<xmlDoc, decltype(&xmlFreeDoc)>;

inline constexpr std::string_view kSvgSpace = "http://www.w3.org/2000/svg";

/// Keeps the line of an element that the parser reads, which `xmlNode::line` does up to 65535 only.
void note_svg_line(xmlNode& element, int line);
[[nodiscard]] long svg_line(const xmlNode* element);

/// Throws std::bad_alloc. The values of all attributes together are limited, because a short
/// drawing may use a long path very often.
class SvgCopy {
 public:
  SvgCopy() : document_(xmlNewDoc(nullptr), &xmlFreeDoc) {}

  /// Messages about the new element name the line of `source`. Without a parent: the page.
  xmlNode* add(const xmlNode* source, xmlNode* parent, std::string_view kind);
  xmlNode* add_group(const xmlNode* source, xmlNode* parent, const std::string& transform);
  void set(xmlNode* node, const char* attribute, const std::string& value);
  /// Copies the attribute if it has a value.
  void copy_attribute(xmlNode* from, xmlNode* to, const char* attribute);
  /// Takes a missing width or height of the page, or both, from its view box. A size in percent is
  /// not absolute, so it counts as missing.
  void size_page(xmlNode* page);

  /// The first element that lacks an attribute because of kMostBytesOfAttributes; null: none does.
  [[nodiscard]] const xmlNode* left_out_of() const { return left_out_of_; }
  /// A copied length has a unit such as mm.
  [[nodiscard]] bool unit_stated() const { return unit_stated_; }
  [[nodiscard]] XmlDocument take() { return std::move(document_); }

  static const std::size_t kMostBytesOfAttributes;

 private:
  XmlDocument document_;
  xmlNs* space_ = nullptr;
  std::size_t bytes_ = 0;  ///< of attributes
  const xmlNode* left_out_of_ = nullptr;
  bool unit_stated_ = false;
};

}  // namespace clay::importing
