#pragma once
// The style sheets of an SVG drawing, as far as they show or hide shapes.

#include "claystack/core/result.hpp"

#include <libxml/tree.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::importing {

enum class SvgProperty {
  display,
  visibility,
  fill,
  fill_opacity,
  stroke,
  stroke_opacity,
  transform,
  transform_origin,
  opacity,
  clip_path,
  mask,
};
inline constexpr std::size_t kSvgProperties = 11;

/// White space of style sheets and lists.
inline constexpr std::string_view kSvgBlank = " \t\r\n\f";

/// The values of one element, where they are set.
using SvgValues = std::array<std::optional<std::string>, kSvgProperties>;

/// Values set by a rule or a style attribute; values that are !important apply last.
struct SvgDeclarations {
  SvgValues normal, important;
};

/// The text of an attribute's or element's children. Entities are replaced only if their content is
/// short and names no others: nested ones can grow without bound.
[[nodiscard]] std::string svg_text(xmlDoc* document, const xmlNode* children);

/// An attribute of the element without namespace, or of xlink; empty if there is none.
[[nodiscard]] std::string svg_attribute(xmlNode* node, const char* name);

/// All style elements of a document. Selectors may combine a type, classes and an id, by descent
/// (blank) or as a child (>). Rules with other selectors, and rules within @media, are ignored.
class SvgStyles {
 public:
  /// Adds the rules of a style element.
  void add(std::string_view css);

  /// The values that presentation attributes, rules and the style attribute of `node` set, each
  /// before the next, and after them the important ones of rules and style attribute. Refuses
  /// drawings that need too many comparisons.
  Result<SvgValues> of(xmlNode* node);

 private:
  /// type.class#id; `child`: of the part before it, otherwise anywhere within.
  struct Part {
    std::string type, id;
    std::vector<std::string> classes;
    bool child = false;
  };
  struct Rule {
    std::vector<Part> parts;
    SvgDeclarations values;
    int rank = 0;  ///< specificity
  };

  static std::optional<std::vector<Part>> parts_of(std::string_view selector);
  bool matches(const Part& part, xmlNode* node);
  bool matches(const Rule& rule, xmlNode* node);
  /// Of an element: sorted, each once. Valid until the next call.
  const std::vector<std::string>& classes_of(xmlNode* node);
  /// The rules that apply to an element, by their rank; incomplete after too many comparisons.
  std::vector<std::pair<int, std::size_t>> rules_of(xmlNode* node);

  std::vector<Rule> rules_;
  std::map<std::string, std::vector<std::size_t>> by_key_;  ///< of the last part: #id, .class, type
  std::map<const xmlNode*, std::vector<std::string>> classes_;  ///< as classes_of found them
  std::size_t kept_bytes_ = 0;                                  ///< of their attributes
  std::size_t comparisons_ = 0;
};

}  // namespace clay::importing
