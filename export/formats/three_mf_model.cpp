#include "export/formats/three_mf_model.hpp"

#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/mesh_limits.hpp"
#include "export/formats/text_scanner.hpp"
#include "export/formats/three_mf.hpp"
#include "export/formats/three_mf_grammar.hpp"
#include "export/formats/zip_package.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace clay::solid::inline formats::three_mf {
namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxPlaced = 1'000'000;
constexpr std::size_t kMaxMetadata = 1000, kMaxPotText = std::size_t{8} << 20;
constexpr std::uint32_t kMaxId = 0x7FFFFFFF;

// Its ids need no support; its paths name other model parts.
constexpr std::string_view kProduction =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";

template <class Number>
std::optional<Number> whole(std::optional<std::string_view> text, Number least, Number most) {
  if (!text) return std::nullopt;
  Number value{};
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || end != text->data() + text->size()) return std::nullopt;
  return value >= least && value <= most ? std::optional(value) : std::nullopt;
}

std::string found(std::optional<std::string_view> text) {
  return ", found " + (text ? quoted(*text) : std::string("none"));
}

std::optional<Transform> transform_from(std::string_view text) {
  Transform matrix{};
  for (double& value : matrix) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    const std::string_view word = text.substr(0, text.find(' '));
    const auto number = parse_float(word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    value = double{*number};
    text.remove_prefix(word.size());
  }
  if (text.find_first_not_of(' ') != text.npos) return std::nullopt;
  return matrix;
}

/// Of volumes that are left out: otherwise they would count for the size of the mesh.
void drop_unused_points(Object& object) {
  std::vector<std::uint32_t> number(object.points.size(), 0);  // first: 1 where it is used
  for (const auto& triangle : object.triangles)
    for (const std::uint32_t corner : triangle) number[corner] = 1;
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) continue;
    object.points[kept] = object.points[i];
    number[i] = kept++;
  }
  object.points.resize(kept);
  for (auto& triangle : object.triangles)
    for (std::uint32_t& corner : triangle) corner = number[corner];
}

std::uint64_t bounded(std::uint64_t count) { return std::min<std::uint64_t>(count, 1ULL << 40); }

}  // namespace

void ModelReader::begin(XmlReader& reader, const XmlElement& element) {
  step_of_loop();
  if (foreign_depth_ > 0 || element.space != kCore) {
    if (foreign_depth_++ == 0 && places_.back() == Place::outside)
      return reader.fail("expected a 3MF model, found the element " + quoted(element.name));
    // Property groups of other namespaces have ids, too.
    if (foreign_depth_ == 1 && places_.back() == Place::resources && element.value_of("id"))
      add_resource(reader, element);
    return;
  }
  const auto place = place_of(element.name, places_.back());
  if (!place) return reader.fail(misplaced(element.name, places_.back()));
  places_.push_back(*place);
  enter(reader, *place, element);
}

void ModelReader::enter(XmlReader& reader, Place place, const XmlElement& element) {
  switch (place) {
    case Place::model:
      return begin_model(reader, element);
    case Place::metadata:
      return begin_metadata(reader, element);
    case Place::resources:
      if (part_.has_resources || part_.has_build)
        reader.fail("expected resources once, before build");
      part_.has_resources = true;
      return;
    case Place::build:
      if (part_.has_build || !part_.has_resources)
        reader.fail("expected build once, after resources");
      part_.has_build = true;
      return;
    case Place::materials:
      return add_resource(reader, element);
    case Place::object:
      return begin_object(reader, element);
    case Place::mesh:
    case Place::components:
      if (has_mesh_ || has_components_)
        reader.fail("expected one mesh or one list of components in an object");
      (place == Place::mesh ? has_mesh_ : has_components_) = true;
      return;
    case Place::vertex:
      return add_vertex(reader, element);
    case Place::triangle:
      return add_triangle(reader, element);
    case Place::component:
      return add_placed(reader, element, objects_.back().components);
    case Place::item:
      return add_placed(reader, element, items_);
    default:
      return;
  }
}

void ModelReader::end(XmlReader& reader) {
  if (foreign_depth_ > 0) {
    --foreign_depth_;
    return;
  }
  if (places_.back() == Place::object) end_object(reader);
  reads_pot_ = false;
  places_.pop_back();
}

void ModelReader::begin_other(std::string_view path) { other_ = part_key(path); }

void ModelReader::end_other() {
  others_.insert_or_assign(std::exchange(other_, {}), std::exchange(part_, {}));
}

void ModelReader::text(XmlReader& reader, std::string_view piece) {
  if (!reads_pot_ || foreign_depth_ > 0) return;
  if (pot_text_.size() + piece.size() > kMaxPotText)
    return reader.fail("expected a pot of at most 8 MiB in the metadata, found more");
  pot_text_ += piece;
}

void ModelReader::begin_model(XmlReader& reader, const XmlElement& element) {
  static constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{{{"micron", 0.001},
                                                                              {"millimeter", 1.0},
                                                                              {"centimeter", 10.0},
                                                                              {"inch", 25.4},
                                                                              {"foot", 304.8},
                                                                              {"meter", 1000.0}}};
  const std::string_view unit = element.value_of("unit").value_or("millimeter");
  const auto known = std::ranges::find(kUnits, unit, &std::pair<std::string_view, double>::first);
  if (known == kUnits.end())
    return reader.fail(
        "unit: expected micron, millimeter, centimeter, inch, foot or meter, found " +
        quoted(unit));
  part_.unit_mm = known->second;
  std::string_view required = element.value_of("requiredextensions").value_or("");
  while (!required.empty()) {
    const std::string_view prefix = required.substr(0, required.find(' '));
    required.remove_prefix(std::min(prefix.size() + 1, required.size()));
    if (prefix.empty()) continue;
    const auto space = std::ranges::find(element.namespaces, prefix, &XmlAttribute::name);
    const std::string_view uri = space == element.namespaces.end() ? "" : space->value;
    if (uri != kMaterials && uri != kProduction)
      return reader.fail("expected no required extension but materials and production, found " +
                         quoted(uri.empty() ? prefix : uri));
  }
}

void ModelReader::begin_metadata(XmlReader& reader, const XmlElement& element) {
  const auto name = element.value_of("name");
  if (!name || name->empty()) return reader.fail("metadata: expected a name, found none");
  if (places_[places_.size() - 2] != Place::model) return;
  if (!part_.metadata.emplace(*name).second)
    return reader.fail("metadata: expected the name " + quoted(*name) + " once, found it twice");
  if (part_.metadata.size() > kMaxMetadata)
    return reader.fail("expected at most " + std::to_string(kMaxMetadata) +
                       " metadata, found more");
  reads_pot_ = other_.empty() && *name == kPotMetadata;
}

void ModelReader::add_resource(XmlReader& reader, const XmlElement& element) {
  const auto id = whole<std::uint32_t>(element.value_of("id"), 1, kMaxId);
  if (!id)
    return reader.fail("expected an id from 1 to 2147483647" + found(element.value_of("id")));
  if (!part_.resources.insert(*id).second)
    return reader.fail("expected id " + std::to_string(*id) + " once, found it twice");
  if (places_.back() != Place::object) part_.properties.insert(*id);
}

void ModelReader::check_property(XmlReader& reader, const XmlElement& element) {
  const auto text = element.value_of("pid");
  if (!text) return;
  const auto pid = whole<std::uint32_t>(text, 1, kMaxId);
  if (!pid || !part_.properties.contains(*pid))
    reader.fail("pid: expected the id of a property group before it" + found(text));
}

void ModelReader::begin_object(XmlReader& reader, const XmlElement& element) {
  add_resource(reader, element);
  check_property(reader, element);
  static constexpr std::array<std::string_view, 5> kObjectTypes{"model", "solidsupport", "support",
                                                                "surface", "other"};
  const std::string_view type = element.value_of("type").value_or("model");
  if (std::ranges::find(kObjectTypes, type) == kObjectTypes.end())
    return reader.fail("type: expected model, solidsupport, support, surface or other, found " +
                       quoted(type));
  id_ = whole<std::uint32_t>(element.value_of("id"), 1, kMaxId).value_or(0);
  has_mesh_ = has_components_ = false;
  no_clay_ranges_ = other_.empty() ? volumes_.ranges_of(id_) : nullptr;
  triangle_ = 0;
  dropped_ = {};
  objects_.emplace_back().type = type;
}

void ModelReader::end_object(XmlReader& reader) {
  Object& object = objects_.back();
  if (dropped_.any())
    drop_unused_points(object);
  else if (has_mesh_ ? object.triangles.empty() : object.components.empty())
    return reader.fail("expected an object with triangles or components, found neither");
  // Components without clay count for nothing in the limits, however often they are nested.
  std::erase_if(object.components,
                [&](const Placed& part) { return objects_[part.object].all_triangles == 0; });
  object.all_points = object.points.size();
  object.all_triangles = object.triangles.size();
  for (const Placed& component : object.components) {
    const Object& part = objects_[component.object];
    object.all_points = bounded(object.all_points + part.all_points);
    object.all_triangles = bounded(object.all_triangles + part.all_triangles);
    object.depth = std::max(object.depth, part.depth + 1);
  }
  if (object.depth > kMaxDepth)
    return reader.fail("expected components nested at most " + std::to_string(kMaxDepth) +
                       " deep, found deeper ones");
  part_.object_of[id_] = static_cast<std::uint32_t>(objects_.size() - 1);
}

void ModelReader::add_vertex(XmlReader& reader, const XmlElement& element) {
  glm::vec3 point{0.0F};
  for (int axis = 0; axis < 3; ++axis) {
    const char name = static_cast<char>('x' + axis);
    const auto text = element.value_of({&name, 1});
    const auto value = text ? parse_float(*text) : std::optional<float>();
    if (!value || !is_coordinate(*value))
      return reader.fail(std::string(1, name) + ": expected " + std::string(kCoordinateRule) +
                         found(text));
    point[axis] = *value + 0.0F;  // -0 + 0 is 0
  }
  if (++stored_points_ > kMaxPoints) return reader.fail(expected_at_most(kMaxPoints, "vertices"));
  objects_.back().points.push_back(point);
}

void ModelReader::add_triangle(XmlReader& reader, const XmlElement& element) {
  Object& object = objects_.back();
  if (object.points.empty()) return reader.fail("expected vertices before triangles, found none");
  static constexpr std::array<std::string_view, 3> kNames{"v1", "v2", "v3"};
  std::array<std::uint32_t, 3> corners{};
  const auto last = static_cast<std::uint32_t>(object.points.size() - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto text = element.value_of(kNames[i]);
    const auto index = whole<std::uint32_t>(text, 0, last);
    if (!index)
      return reader.fail(std::string(kNames[i]) + ": " +
                         expected_number("a vertex", 0, object.points.size()) + found(text));
    corners[i] = *index;
  }
  if (next_is_no_clay()) return;
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
    if (options_.repair) return void(++twice_);
    return reader.fail(
        std::string("expected a triangle of three vertices, found one that uses a vertex twice; ")
            .append(kByRepair)
            .append(" leaves it out"));
  }
  if (element.attributes.size() > 3) check_property(reader, element);
  if (++stored_triangles_ > kMaxTriangles)
    return reader.fail(expected_at_most(kMaxTriangles, "triangles"));
  object.triangles.push_back(corners);
}

bool ModelReader::next_is_no_clay() {
  const std::uint32_t triangle = triangle_++;
  if (no_clay_ranges_ == nullptr) return false;
  const auto after = no_clay_ranges_->upper_bound(triangle);
  if (after == no_clay_ranges_->begin()) return false;
  const SlicerVolumes::Range& range = std::prev(after)->second;
  if (triangle > range.last) return false;
  if (triangle == range.first) {
    dropped_.add(range.negative);
    no_clay_.add(range.negative);
  }
  return true;
}

const ModelReader::Part* ModelReader::part_of(XmlReader& reader, const XmlElement& element) const {
  const auto path = std::ranges::find_if(element.attributes, [](const XmlAttribute& a) {
    return a.space == kProduction && a.name == "path";
  });
  if (path == element.attributes.end()) return &part_;
  if (!other_.empty()) {
    reader.fail("path: expected it in the start part only, found " + quoted(path->value));
    return nullptr;
  }
  const auto other = others_.find(part_key(path->value));
  if (other == others_.end()) {
    reader.fail("path: expected a model part to which this one has a relationship, found " +
                quoted(path->value));
    return nullptr;
  }
  if (other->second.unit_mm == part_.unit_mm) return &other->second;
  reader.fail("path: expected a model part in the unit of this one, found " + quoted(path->value) +
              " in another");
  return nullptr;
}

void ModelReader::add_placed(XmlReader& reader, const XmlElement& element,
                             std::vector<Placed>& list) {
  // By the specification, the build and the metadata of another part count for nothing.
  if (places_.back() == Place::item && !other_.empty()) return;
  const Part* const part = part_of(reader, element);
  if (part == nullptr) return;
  const auto text = element.value_of("objectid");
  const auto id = whole<std::uint32_t>(text, 1, kMaxId);
  const auto known = id ? part->object_of.find(*id) : part->object_of.end();
  if (known == part->object_of.end())
    return reader.fail("objectid: expected an object defined before it" + found(text));
  Placed placed{known->second, kStill};
  if (const auto matrix = element.value_of("transform")) {
    const auto transform = transform_from(*matrix);
    if (!transform || std::abs(determinant(*transform)) < 1e-30)
      return reader.fail("transform: expected 12 numbers of an invertible matrix, found " +
                         quoted(*matrix));
    placed.transform = *transform;
  }
  if (places_.back() == Place::item && objects_[placed.object].type == "other")
    return reader.fail("expected an object to build, found one of type other");
  if (list.size() == kMaxPlaced)
    return reader.fail("expected at most " + std::to_string(kMaxPlaced) + " components or items");
  if (const bool* negative = volumes_.component(id_, *id);
      negative != nullptr && places_.back() == Place::component && other_.empty()) {
    dropped_.add(*negative);
    return no_clay_.add(*negative);
  }
  // Not in the core specification, but PrusaSlicer and Bambu Studio write and apply it.
  const std::string_view printable = element.value_of("printable").value_or("1");
  if (places_.back() == Place::item && (printable == "0" || printable == "false"))
    ++not_printed_;
  else
    list.push_back(placed);
}

}  // namespace clay::solid::inline formats::three_mf
