#include "app/import/svg_shapes.hpp"

#include "app/import/readers.hpp"
#include "app/import/svg_style.hpp"
#include "app/import/svg_transform.hpp"
#include "core/lower_case.hpp"
#include "core/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace clay::importing {
namespace {

constexpr int kDeepest = 200;                   // elements within elements
constexpr std::size_t kMostElements = 200'000;  // counted again at each use

/// The attributes that are the geometry of a shape. Without a needed one it draws nothing, as a
/// path whose nodes were deleted.
struct Geometry {
  std::vector<const char*> needed, others;
};
const std::map<std::string_view, Geometry> kShapes = {
    {"path", {{"d"}, {}}},
    {"polygon", {{"points"}, {}}},
    {"polyline", {{"points"}, {}}},
    {"line", {{}, {"x1", "y1", "x2", "y2"}}},
    {"rect", {{"width", "height"}, {"x", "y", "rx", "ry"}}},
    {"circle", {{"r"}, {"cx", "cy"}}},
    {"ellipse", {{}, {"cx", "cy", "rx", "ry"}}}};
constexpr std::array<const char*, 6> kViewport = {"x",      "y",       "width",
                                                  "height", "viewBox", "preserveAspectRatio"};

std::string_view name_of(const xmlNode* node) { return reinterpret_cast<const char*>(node->name); }

/// The name of a namespace; Adobe Illustrator writes it as an entity, which the parser does not
/// replace.
std::string_view address_of(const xmlNode* node) {
  const std::string_view address = reinterpret_cast<const char*>(node->ns->href);
  if (!address.starts_with('&') || !address.ends_with(';')) return address;
  const std::string name(address.substr(1, address.size() - 2));
  const xmlEntity* entity =
      xmlGetDocEntity(node->doc, reinterpret_cast<const xmlChar*>(name.c_str()));
  if (entity == nullptr || entity->content == nullptr) return address;
  return reinterpret_cast<const char*>(entity->content);
}

bool of_svg(const xmlNode* node) {
  return node->type == XML_ELEMENT_NODE && (node->ns == nullptr || address_of(node) == kSvgSpace);
}

/// Properties that children inherit from their parents.
struct Inherited {
  bool visible = true;
  bool filled = true, stroked = false;
  bool fill_opaque = true, stroke_opaque = true;
  bool in_layer = true;
  int depth = 0;

  [[nodiscard]] bool shown() const {
    return visible && in_layer && ((filled && fill_opaque) || (stroked && stroke_opaque));
  }
};

/// Walks the drawing, and adds the visible shapes to a new document.
class Copier {
 public:
  Copier(xmlDoc& drawing, const std::string& layer, const std::string& name)
      : name_(name), layer_(layer) {
    index(xmlDocGetRootElement(&drawing));
  }

  Result<SvgShapes> shapes(xmlNode* root) {
    Inherited page;
    page.in_layer = layer_.empty();
    auto done = element(root, nullptr, page);
    if (done) done = check_copied();
    if (!done) return tl::make_unexpected(done.error());
    if (!layer_.empty() && !found_layer_)
      return failure(ErrorKind::bad_input, fmt::format("{}: expected a layer \"{}\", found {}",
                                                       name_, shown(layer_), layer_names()));
    return SvgShapes{copy_.take(), std::move(notes_), copy_.unit_stated()};
  }

 private:
  /// The names that --layer accepts, layers before other groups.
  [[nodiscard]] std::string layer_names() const {
    std::vector<std::string> names(layers_.begin(), layers_.end());
    std::ranges::set_difference(groups_, layers_, std::back_inserter(names));
    return names.empty() ? "no layers and no groups with a name" : list_of(names);
  }

  /// Finds ids and style sheets, without recursion: the depth is not yet limited.
  void index(xmlNode* root) {
    for (xmlNode* node = root; node != nullptr;) {
      if (node->type == XML_ELEMENT_NODE) {
        if (const std::string id = svg_attribute(node, "id"); !id.empty()) ids_.emplace(id, node);
        if (of_svg(node) && name_of(node) == "style")
          styles_.add(svg_text(node->doc, node->children));
      }
      if (node->children != nullptr && node->type == XML_ELEMENT_NODE) {
        node = node->children;
        continue;
      }
      while (node != root && node->next == nullptr) node = node->parent;
      if (node == root) return;
      node = node->next;
    }
  }

  /// Keywords of CSS are case-insensitive.
  static bool is(const std::optional<std::string>& value, std::string_view keyword) {
    return value && lower_case(*value) == keyword;
  }

  /// "0", "0.0" or "0%".
  static bool is_zero(const std::optional<std::string>& opacity) {
    return opacity && opacity->find('0') != std::string::npos &&
           opacity->find_first_not_of("0.%") == std::string::npos;
  }

  /// Adds one note for each kind.
  void note_unapplied(xmlNode* node, std::string_view kind,
                      const std::optional<std::string>& value) {
    if (!value || is(value, "none") || !noted_.insert(kind).second) return;
    notes_.push_back(fmt::format("{}:{}: a {} is not applied: the whole shape was read", name_,
                                 svg_line(node), kind));
  }

  Result<void> element(xmlNode* node, xmlNode* parent, Inherited state) {
    if (!of_svg(node)) return {};
    const std::string_view kind = name_of(node);
    const auto shape = kShapes.find(kind);
    const bool group = kind == "g" || kind == "a" || kind == "switch" || kind == "svg";
    if (shape == kShapes.end() && !group && kind != "use") return {};
    if (++state.depth > kDeepest)
      return refusal(node, fmt::format("expected elements at most {} deep, found more", kDeepest));
    if (auto counted = count(node); !counted) return counted;
    const auto values = styles_.of(node);
    if (!values) return refusal(node, values.error().message);
    const auto value = [&](SvgProperty property) -> const std::optional<std::string>& {
      return (*values)[static_cast<std::size_t>(property)];
    };
    if (is(value(SvgProperty::display), "none") || is_zero(value(SvgProperty::opacity))) return {};
    note_unapplied(node, "clip-path", value(SvgProperty::clip_path));
    note_unapplied(node, "mask", value(SvgProperty::mask));
    inherit(state.visible, value(SvgProperty::visibility), "visible");
    inherit(state.filled, value(SvgProperty::fill), nullptr);
    inherit(state.stroked, value(SvgProperty::stroke), nullptr);
    inherit_opacity(state.fill_opaque, value(SvgProperty::fill_opacity));
    inherit_opacity(state.stroke_opaque, value(SvgProperty::stroke_opacity));
    if (kind == "g" && !enter_layer(node, state)) return {};
    if (const auto& transform = value(SvgProperty::transform);
        transform && !is(transform, "none")) {
      const auto functions = svg_transform(*transform, value(SvgProperty::transform_origin));
      if (!functions) return refusal(node, functions.error().message);
      if (parent == nullptr) return viewport(node, node, parent, state, *functions);
      parent = copy_.add_group(node, parent, *functions);
    }
    if (kind == "use") return use(node, parent, state);
    if (kind == "svg") return viewport(node, node, parent, state);
    if (kind == "switch") return chosen(node, parent, state);
    if (group) return children(node, parent, state);
    if (state.shown()) copy_shape(node, parent, shape->second);
    return {};
  }

  void copy_shape(xmlNode* node, xmlNode* parent, const Geometry& geometry) {
    const bool drawn = std::ranges::all_of(geometry.needed, [&](const char* attribute) {
      const std::string value = svg_attribute(node, attribute);
      return !value.empty() && value != "auto" && value != "none";
    });
    if (!drawn) return;
    xmlNode* copied = copy_.add(node, parent, name_of(node));
    for (const auto* attributes : {&geometry.needed, &geometry.others})
      for (const char* attribute : *attributes) copy_.copy_attribute(node, copied, attribute);
  }

  Result<void> count(xmlNode* node) {
    if (++count_ > kMostElements)
      return refusal(node, fmt::format("expected at most {} elements with all uses, found more",
                                       kMostElements));
    return check_copied();
  }

  /// Refuses the drawing if an attribute was left out because of their limit.
  [[nodiscard]] Result<void> check_copied() const {
    if (copy_.left_out_of() == nullptr) return {};
    return refusal(copy_.left_out_of(),
                   fmt::format("expected attributes of at most {} MiB with all uses, found more",
                               SvgCopy::kMostBytesOfAttributes >> 20));
  }

  /// `on`: the value that switches on; null: every value but "none" does.
  static void inherit(bool& state, const std::optional<std::string>& value, const char* on) {
    if (!value || is(value, "inherit")) return;
    state = on == nullptr ? !is(value, "none") && !is(value, "transparent") : is(value, on);
  }

  static void inherit_opacity(bool& opaque, const std::optional<std::string>& value) {
    if (value && !is(value, "inherit")) opaque = !is_zero(value);
  }

  /// In either case, as in DXF.
  [[nodiscard]] bool is_asked(const std::string& layer) const {
    return lower_case(layer) == lower_case(layer_);
  }

  /// Returns false for layers that are not drawn.
  bool enter_layer(xmlNode* node, Inherited& state) {
    std::string label, mode;
    for (const xmlAttr* at = node->properties; at != nullptr; at = at->next) {
      if (at->ns == nullptr || at->children == nullptr || at->children->content == nullptr)
        continue;
      const std::string_view name = reinterpret_cast<const char*>(at->name);
      const auto* text = reinterpret_cast<const char*>(at->children->content);
      if (name == "label") label = text;
      if (name == "groupmode") mode = text;
    }
    const std::string id = svg_attribute(node, "id");
    if (const std::string& shown = label.empty() ? id : label; !shown.empty())
      (mode == "layer" ? layers_ : groups_).insert(shown);
    if (!layer_.empty() && (is_asked(label) || is_asked(id))) found_layer_ = state.in_layer = true;
    return !for_construction(label.empty() ? id : label) || (!layer_.empty() && state.in_layer);
  }

  Result<void> children(xmlNode* node, xmlNode* parent, const Inherited& state) {
    for (xmlNode* child = node->children; child != nullptr; child = child->next)
      if (auto done = element(child, parent, state); !done) return done;
    return {};
  }

  /// The first child that this program can draw.
  Result<void> chosen(xmlNode* node, xmlNode* parent, const Inherited& state) {
    for (xmlNode* child = node->children; child != nullptr; child = child->next) {
      if (of_svg(child) && svg_attribute(child, "requiredExtensions").empty())
        return element(child, parent, state);
    }
    return {};
  }

  Result<void> use(xmlNode* node, xmlNode* parent, const Inherited& state) {
    const std::string href = svg_attribute(node, "href");
    const auto target = href.starts_with('#') ? ids_.find(href.substr(1)) : ids_.end();
    if (target == ids_.end())
      return refusal(node, fmt::format("use: expected the id of an element of the drawing, found "
                                       "\"{}\"",
                                       shown(href)));
    const auto again = std::find(used_.begin(), used_.end(), href);
    if (again != used_.end())
      return refusal(node, fmt::format("use: expected an element that does not use itself, found "
                                       "{} -> {}",
                                       shortened(again, used_.end()), shown(href)));
    xmlNode* place = copy_.add(node, parent, "svg");
    for (const char* attribute : {"x", "y"}) copy_.copy_attribute(node, place, attribute);
    const std::string_view kind = name_of(target->second);
    used_.push_back(href);
    auto done = kind != "symbol" && kind != "svg" ? element(target->second, place, state)
                                                  : viewport(target->second, node, place, state);
    used_.pop_back();
    return done;
  }

  /// "#a -> #b" of a chain of uses.
  static std::string shortened(std::vector<std::string>::const_iterator begin,
                               std::vector<std::string>::const_iterator end) {
    constexpr std::ptrdiff_t kMost = 8;
    std::string text;
    for (auto it = begin; it != end && it - begin < kMost; ++it)
      text += (it == begin ? std::string() : " -> ") + shown(*it);
    return end - begin > kMost ? text + " -> ..." : text;
  }

  /// The content of an svg or a symbol; the size is that of `sized`, if it has one. `functions`:
  /// the transform of the page, which applies to all that is on it.
  Result<void> viewport(xmlNode* node, xmlNode* sized, xmlNode* parent, const Inherited& state,
                        const std::string& functions = {}) {
    if (state.depth + 1 > kDeepest)
      return refusal(node, fmt::format("expected elements at most {} deep, found more", kDeepest));
    xmlNode* copied = copy_.add(node, parent, "svg");
    for (const char* attribute : kViewport) copy_.copy_attribute(node, copied, attribute);
    for (const char* attribute : {"width", "height"}) {
      if (sized != node && !svg_attribute(sized, attribute).empty())
        copy_.set(copied, attribute, svg_attribute(sized, attribute));
    }
    if (parent == nullptr) copy_.size_page(copied);
    if (!functions.empty()) copied = copy_.add_group(node, copied, functions);
    Inherited inside = state;
    ++inside.depth;
    return children(node, copied, inside);
  }

  [[nodiscard]] tl::unexpected<Error> refusal(const xmlNode* node,
                                              const std::string& problem) const {
    return failure(ErrorKind::bad_input, fmt::format("{}:{}: {}", name_, svg_line(node), problem));
  }

  const std::string& name_;
  const std::string& layer_;
  SvgCopy copy_;
  SvgStyles styles_;
  std::map<std::string, xmlNode*> ids_;
  std::vector<std::string> used_;          ///< the references that lead to the element
  std::set<std::string> layers_, groups_;  ///< names of layers of Inkscape, and of other groups
  bool found_layer_ = false;
  std::vector<std::string> notes_;
  std::set<std::string_view> noted_;  // kinds that have a note
  std::size_t count_ = 0;
};

}  // namespace

Result<SvgShapes> svg_shapes(xmlDoc& drawing, const std::string& layer, const std::string& name) {
  xmlNode* root = xmlDocGetRootElement(&drawing);
  if (!of_svg(root) || name_of(root) != "svg")
    return failure(ErrorKind::bad_input,
                   fmt::format("{}:{}: expected an SVG drawing, found the element \"{}\"", name,
                               svg_line(root), shown(name_of(root))));
  return Copier(drawing, layer, name).shapes(root);
}

}  // namespace clay::importing
