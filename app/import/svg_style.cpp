#include "app/import/svg_style.hpp"

#include "app/import/readers.hpp"
#include "core/lower_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace clay::importing {
namespace {

// The limit bounds the time of a style sheet. Reading attributes and looking up keys takes time
// too: 16 bytes, or 8 keys, count as one comparison.
constexpr std::size_t kMostComparisons = 20'000'000;
constexpr std::size_t kBytesPerComparison = 16, kKeysPerComparison = 8;
constexpr std::size_t kMostKeptBytes = 16u << 20;  // of the classes of elements
constexpr std::string_view kXlink = "http://www.w3.org/1999/xlink";
constexpr std::array<std::string_view, kSvgProperties> kNames = {
    "display",   "visibility",       "fill",    "fill-opacity", "stroke", "stroke-opacity",
    "transform", "transform-origin", "opacity", "clip-path",    "mask"};

std::string_view stripped(std::string_view text) { return trimmed(text, kSvgBlank); }

/// Removes everything up to `end` from the front, and returns what was before it.
std::string_view take_until(std::string_view& text, char end) {
  const std::size_t at = std::min(text.find(end), text.size());
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(std::min(at + 1, text.size()));
  return taken;
}

std::string without_comments(std::string_view css) {
  std::string result;
  while (true) {
    const std::size_t begin = css.find("/*");
    result += css.substr(0, begin);
    if (begin == std::string_view::npos) return result;
    const std::size_t end = css.find("*/", begin + 2);
    if (end == std::string_view::npos) return result;
    css.remove_prefix(end + 2);
  }
}

/// Takes "{ ... }" with everything nested in it.
void skip_block(std::string_view& css) {
  int depth = 0;
  while (!css.empty()) {
    const char c = css.front();
    css.remove_prefix(1);
    if (c == '{') ++depth;
    if (c == '}' && --depth <= 0) return;
    if (c == ';' && depth == 0) return;
  }
}

SvgDeclarations declarations_of(std::string_view text) {
  SvgDeclarations found;
  while (!text.empty()) {
    std::string_view rest = take_until(text, ';');
    const std::string name = lower_case(stripped(take_until(rest, ':')));
    const auto known = std::find(kNames.begin(), kNames.end(), name);
    if (known == kNames.end()) continue;
    const std::string_view value = stripped(take_until(rest, '!'));
    SvgValues& values = lower_case(stripped(rest)) == "important" ? found.important : found.normal;
    if (!value.empty()) values[static_cast<std::size_t>(known - kNames.begin())] = value;
  }
  return found;
}

bool sets_nothing(const SvgValues& values) {
  return std::ranges::none_of(values, [](const auto& value) { return value.has_value(); });
}

void lay_over(SvgValues& values, const SvgValues& above) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (above[i]) values[i] = above[i];
}

/// The words of a list separated by white space.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (!(text = stripped(text)).empty()) {
    const std::size_t end = std::min(text.find_first_of(kSvgBlank), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

bool name_char(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

std::string svg_text(xmlDoc* document, const xmlNode* children) {
  constexpr std::size_t kLongestEntity = 4096, kLongest = 32u << 20;
  std::string text;
  for (; children != nullptr && text.size() < kLongest; children = children->next) {
    const bool reference = children->type == XML_ENTITY_REF_NODE;
    if (!reference && children->type != XML_TEXT_NODE && children->type != XML_CDATA_SECTION_NODE)
      continue;
    const xmlEntity* entity = reference ? xmlGetDocEntity(document, children->name) : nullptr;
    const xmlChar* content = entity == nullptr ? children->content : entity->content;
    if (content == nullptr || (reference && entity == nullptr)) continue;
    const std::string_view part = reinterpret_cast<const char*>(content);
    const bool grows = part.size() > kLongestEntity || part.find('&') != std::string_view::npos;
    if (!reference || !grows) text += part;
  }
  return text;
}

std::string svg_attribute(xmlNode* node, const char* name) {
  for (const xmlAttr* at = node->properties; at != nullptr; at = at->next) {
    const std::string_view own = reinterpret_cast<const char*>(at->name);
    const bool plain = at->ns == nullptr ||
                       std::string_view(reinterpret_cast<const char*>(at->ns->href)) == kXlink;
    // A file that does not declare the prefix has it in the name.
    if (!plain || (own != name && own != std::string("xlink:") + name)) continue;
    return svg_text(node->doc, at->children);
  }
  return {};
}

std::optional<std::vector<SvgStyles::Part>> SvgStyles::parts_of(std::string_view selector) {
  std::vector<Part> parts;
  bool child = false;
  while (!(selector = stripped(selector)).empty()) {
    if (selector.front() == '>') {
      if (parts.empty() || std::exchange(child, true)) return std::nullopt;
      selector.remove_prefix(1);
      continue;
    }
    Part part;
    part.child = std::exchange(child, false);
    while (!selector.empty() && kSvgBlank.find(selector.front()) == std::string_view::npos &&
           selector.front() != '>') {
      const char kind = selector.front();
      const bool marked = kind == '.' || kind == '#';
      if (kind == '*' || marked) selector.remove_prefix(1);
      const auto end = std::find_if_not(selector.begin(), selector.end(), name_char);
      std::string name(selector.begin(), end);
      if (name.empty() && kind != '*') return std::nullopt;  // such as [x] or :hover
      selector.remove_prefix(name.size());
      if (kind == '.')
        part.classes.push_back(std::move(name));
      else
        (kind == '#' ? part.id : part.type) = std::move(name);
    }
    parts.push_back(std::move(part));
  }
  if (parts.empty() || child) return std::nullopt;
  return parts;
}

void SvgStyles::add(std::string_view text) {
  const std::string clean = without_comments(text);
  std::string_view css = clean;
  while (!(css = stripped(css)).empty()) {
    if (css.front() == '@') {
      skip_block(css);
      continue;
    }
    std::string_view selectors = take_until(css, '{');
    const SvgDeclarations values = declarations_of(take_until(css, '}'));
    if (sets_nothing(values.normal) && sets_nothing(values.important)) continue;
    while (!selectors.empty()) {
      auto parts = parts_of(take_until(selectors, ','));
      if (!parts) continue;
      Rule rule{std::move(*parts), values, 0};
      for (const Part& part : rule.parts)
        rule.rank += (part.id.empty() ? 0 : 10'000) + 100 * static_cast<int>(part.classes.size()) +
                     (part.type.empty() ? 0 : 1);
      const Part& last = rule.parts.back();
      const std::string key = !last.id.empty()        ? "#" + last.id
                              : !last.classes.empty() ? "." + last.classes.front()
                                                      : last.type;
      by_key_[key].push_back(rules_.size());
      rules_.push_back(std::move(rule));
    }
  }
}

bool SvgStyles::matches(const Part& part, xmlNode* node) {
  if (node == nullptr || node->type != XML_ELEMENT_NODE) return false;
  if (!part.type.empty() && part.type != reinterpret_cast<const char*>(node->name)) return false;
  if (!part.id.empty()) {
    const std::string id = svg_attribute(node, "id");
    comparisons_ += id.size() / kBytesPerComparison;
    if (part.id != id) return false;
  }
  if (part.classes.empty()) return true;
  const std::vector<std::string>& own = classes_of(node);
  comparisons_ += part.classes.size() - 1;
  return std::all_of(part.classes.begin(), part.classes.end(), [&](const std::string& name) {
    return std::binary_search(own.begin(), own.end(), name);
  });
}

const std::vector<std::string>& SvgStyles::classes_of(xmlNode* node) {
  if (const auto known = classes_.find(node); known != classes_.end()) return known->second;
  const std::string text = svg_attribute(node, "class");
  comparisons_ += text.size() / kBytesPerComparison;
  if ((kept_bytes_ += text.size()) > kMostKeptBytes) {  // entities make them longer than the file
    classes_.clear();
    kept_bytes_ = text.size();
  }
  std::vector<std::string> classes = words_of(text);
  std::sort(classes.begin(), classes.end());
  classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
  classes.shrink_to_fit();
  return classes_[node] = std::move(classes);
}

/// Each part is matched as far in as possible; with > that may miss an ancestor further out.
bool SvgStyles::matches(const Rule& rule, xmlNode* node) {
  ++comparisons_;
  if (!matches(rule.parts.back(), node)) return false;
  for (std::size_t i = rule.parts.size() - 1; i > 0; --i) {
    const bool child = rule.parts[i].child;
    node = node->parent;
    while (!matches(rule.parts[i - 1], node)) {
      ++comparisons_;
      if (child || node == nullptr || node->type != XML_ELEMENT_NODE) return false;
      node = node->parent;
    }
  }
  return true;
}

std::vector<std::pair<int, std::size_t>> SvgStyles::rules_of(xmlNode* node) {
  std::vector<std::pair<int, std::size_t>> applied;
  if (rules_.empty()) return applied;
  std::vector<std::string> keys{"", reinterpret_cast<const char*>(node->name),
                                "#" + svg_attribute(node, "id")};
  for (const std::string& name : classes_of(node)) keys.push_back("." + name);
  comparisons_ += keys.size() / kKeysPerComparison;
  for (const std::string& key : keys) {
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) continue;
    for (const std::size_t rule : found->second) {
      if (comparisons_ > kMostComparisons) return applied;
      if (matches(rules_[rule], node)) applied.emplace_back(rules_[rule].rank, rule);
    }
  }
  std::sort(applied.begin(), applied.end());
  return applied;
}

Result<SvgValues> SvgStyles::of(xmlNode* node) {
  SvgValues values;
  std::size_t bytes = 0;  // read again at each use
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::string set = svg_attribute(node, kNames[i].data());
    if (!set.empty()) values[i] = std::string(stripped(set));
    bytes += set.size();
  }
  const auto applied = rules_of(node);
  for (const auto& [rank, rule] : applied) lay_over(values, rules_[rule].values.normal);
  const std::string style = svg_attribute(node, "style");
  comparisons_ += (bytes + style.size()) / kBytesPerComparison;
  if (comparisons_ > kMostComparisons)
    return failure(ErrorKind::bad_input,
                   fmt::format("expected style sheets that need at most {} comparisons with "
                               "elements, found more",
                               kMostComparisons));
  const SvgDeclarations own = declarations_of(without_comments(style));
  lay_over(values, own.normal);
  for (const auto& [rank, rule] : applied) lay_over(values, rules_[rule].values.important);
  lay_over(values, own.important);
  return values;
}

}  // namespace clay::importing
