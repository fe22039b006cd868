#include "app/import/svg_copy.hpp"

#include "app/import/readers.hpp"
#include "app/import/svg_style.hpp"
#include "app/import/svg_transform.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>

namespace clay::importing {
namespace {

/// A number with a unit of a length on paper. Programs differ in the length of a px.
bool has_unit(std::string_view length) {
  constexpr std::array<std::string_view, 6> kUnits = {"mm", "cm", "in", "pt", "pc", "q"};
  return !length.empty() && length.find_first_of("+-.0123456789") == 0 &&
         std::ranges::any_of(kUnits, [&](auto unit) { return ends_ignoring_case(length, unit); });
}

}  // namespace

void note_svg_line(xmlNode& element, int line) {
  element._private = reinterpret_cast<void*>(static_cast<std::intptr_t>(line));
}

long svg_line(const xmlNode* element) {
  return static_cast<long>(reinterpret_cast<std::intptr_t>(element->_private));
}

const std::size_t SvgCopy::kMostBytesOfAttributes = 2 * kMostBytes;

xmlNode* SvgCopy::add(const xmlNode* source, xmlNode* parent, std::string_view kind) {
  xmlNode* node =
      xmlNewDocNode(document_.get(), nullptr,
                    reinterpret_cast<const xmlChar*>(std::string(kind).c_str()), nullptr);
  if (node == nullptr) throw std::bad_alloc();
  node->_private = source->_private;  // see svg_line
  if (parent == nullptr) {
    xmlDocSetRootElement(document_.get(), node);
    space_ = xmlNewNs(node, reinterpret_cast<const xmlChar*>(kSvgSpace.data()), nullptr);
  } else {
    xmlAddChild(parent, node);
  }
  xmlSetNs(node, space_);
  return node;
}

xmlNode* SvgCopy::add_group(const xmlNode* source, xmlNode* parent, const std::string& transform) {
  xmlNode* group = add(source, parent, "g");
  set(group, "transform", transform);
  return group;
}

void SvgCopy::set(xmlNode* node, const char* attribute, const std::string& value) {
  if ((bytes_ += value.size()) > kMostBytesOfAttributes) {
    if (left_out_of_ == nullptr) left_out_of_ = node;
    return;
  }
  const xmlAttr* added = xmlSetProp(node, reinterpret_cast<const xmlChar*>(attribute),
                                    reinterpret_cast<const xmlChar*>(value.c_str()));
  if (added == nullptr || (added->children == nullptr && !value.empty())) throw std::bad_alloc();
}

void SvgCopy::copy_attribute(xmlNode* from, xmlNode* to, const char* attribute) {
  const std::string value = svg_attribute(from, attribute);
  if (!value.empty() && value != "auto") set(to, attribute, value);
  unit_stated_ = unit_stated_ || has_unit(value);
}

void SvgCopy::size_page(xmlNode* page) {
  for (const char* attribute : {"width", "height"})
    if (svg_attribute(page, attribute).ends_with('%'))
      xmlUnsetProp(page, reinterpret_cast<const xmlChar*>(attribute));
  const std::string width = svg_attribute(page, "width"), height = svg_attribute(page, "height");
  const auto box = svg_numbers(svg_attribute(page, "viewBox"));
  if (box.size() != 4 || !(box[2] > 0.0 && box[3] > 0.0)) return;
  if (width.empty() && height.empty()) {
    set(page, "width", number_text(box[2]));
    set(page, "height", number_text(box[3]));
  }
  if (width.empty() && !height.empty()) set(page, "width", svg_scaled(height, box[2] / box[3]));
  if (height.empty() && !width.empty()) set(page, "height", svg_scaled(width, box[3] / box[2]));
}

}  // namespace clay::importing
