#include "export/formats/three_mf_grammar.hpp"

#include "export/formats/text_scanner.hpp"

#include <algorithm>
#include <array>

namespace clay::solid::inline formats::three_mf {
namespace {

struct Rule {
  std::string_view name;
  Place place, parent;
};
constexpr std::array<Rule, 17> kRules{{{"model", Place::model, Place::outside},
                                       {"metadata", Place::metadata, Place::model},
                                       {"resources", Place::resources, Place::model},
                                       {"build", Place::build, Place::model},
                                       {"basematerials", Place::materials, Place::resources},
                                       {"base", Place::base, Place::materials},
                                       {"object", Place::object, Place::resources},
                                       {"metadatagroup", Place::metadata_group, Place::object},
                                       {"metadatagroup", Place::metadata_group, Place::item},
                                       {"metadata", Place::metadata, Place::metadata_group},
                                       {"mesh", Place::mesh, Place::object},
                                       {"vertices", Place::vertices, Place::mesh},
                                       {"vertex", Place::vertex, Place::vertices},
                                       {"triangles", Place::triangles, Place::mesh},
                                       {"triangle", Place::triangle, Place::triangles},
                                       {"components", Place::components, Place::object},
                                       {"component", Place::component, Place::components}}};
constexpr Rule kItem{"item", Place::item, Place::build};

std::string_view name_of(Place place) {
  if (place == kItem.place) return kItem.name;
  const auto rule = std::ranges::find(kRules, place, &Rule::place);
  return rule == kRules.end() ? "the file" : rule->name;
}

}  // namespace

std::optional<Place> place_of(std::string_view name, Place parent) {
  if (parent == Place::vertices)
    return name == "vertex" ? std::optional(Place::vertex) : std::nullopt;
  if (parent == Place::triangles)
    return name == "triangle" ? std::optional(Place::triangle) : std::nullopt;
  if (parent == kItem.parent && name == kItem.name) return kItem.place;
  for (const Rule& rule : kRules)
    if (rule.parent == parent && rule.name == name) return rule.place;
  return std::nullopt;
}

std::string misplaced(std::string_view name, Place parent) {
  std::string belongs;
  for (const Rule& rule : kRules)
    if (rule.name == name)
      belongs.append(belongs.empty() ? "" : " or ").append(name_of(rule.parent));
  if (name == kItem.name) belongs = name_of(kItem.parent);
  if (belongs.empty())
    return std::string("expected an element of the core specification in ")
        .append(name_of(parent))
        .append(", found ")
        .append(quoted(name));
  return std::string("expected ")
      .append(quoted(name))
      .append(" in ")
      .append(belongs)
      .append(", found it in ")
      .append(name_of(parent));
}

}  // namespace clay::solid::inline formats::three_mf
