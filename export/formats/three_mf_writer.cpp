// The model part of a 3MF package: the mesh as XML.

#include "claystack/export/formats.hpp"
#include "claystack/version.hpp"
#include "core/base64.hpp"
#include "core/cancel.hpp"
#include "core/colour_scale.hpp"
#include "core/parallel_parts.hpp"
#include "export/formats/file_floats.hpp"
#include "export/formats/three_mf.hpp"
#include "export/formats/three_mf_text.hpp"
#include "export/solid/mesh_bodies.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace clay::solid::inline formats {
namespace {

using namespace three_mf;

constexpr std::size_t kColourSteps = 64;
constexpr std::uint32_t kUnused = 0xFFFFFFFF;  ///< a point of no triangle of the object

/// One short element, joined here because a long string checks its room at every append.
class ElementText {
 public:
  void add(std::string_view words) { end_ = std::ranges::copy(words, end_).out; }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(Number value) { end_ = std::to_chars(end_, text_.data() + text_.size(), value).ptr; }
  void move_to(std::string& text) {
    text.append(text_.data(), end_);
    end_ = text_.data();
  }

 private:
  std::array<char, 256> text_;  // nine numbers of at most 16 bytes, and 80 bytes of names
  char* end_ = text_.data();
};

class ModelWriter {
 public:
  ModelWriter(const TriangleMesh& mesh, const FileContents& contents)
      : mesh_(mesh),
        contents_(contents),
        name_(xml_escaped(contents.name)),
        number_(mesh.points.size(), kUnused) {}

  ModelPart write() {
    text_.reserve(48 * mesh_.points.size() + 44 * mesh_.triangles.size() + 4096);
    text_.append(kDeclaration)
        .append("<model unit=\"millimeter\" xml:lang=\"en-US\" xmlns=\"")
        .append(kCore)
        .append("\" xmlns:claystack=\"")
        .append(kOwn);
    if (coloured()) text_.append("\" xmlns:m=\"").append(kMaterials);
    text_ += "\">\n";
    add_metadata();
    text_ += "<resources>\n";
    const std::vector<std::vector<std::uint32_t>> bodies = bodies_in_order();
    if (coloured()) add_colours(bodies.size() + 2);
    const std::size_t built = add_objects(bodies);
    text_.append("</resources>\n<build>\n<item objectid=\"")
        .append(std::to_string(built))
        .append("\"/>\n</build>\n</model>\n");
    return {std::move(text_), std::move(sizes_)};
  }

 private:
  void add_metadata() {
    add_metadatum("Title", name_);
    add_metadatum("Application", "claystack " CLAYSTACK_VERSION);
    for (const auto& [key, value] : contents_.notes)
      add_metadatum(std::string(kOwnPrefix) + key, xml_escaped(value));
    if (coloured()) {
      std::string range = "0 to ";
      append_number(range, contents_.wall_top_mm);
      add_metadatum(std::string(kOwnPrefix) + "wall_map", range + " mm");
    }
    if (!contents_.pot.empty() && contents_.pot.size() <= kMostCopiedPotBytes)
      add_metadatum(kPotMetadata, to_base64(contents_.pot));
  }

  void add_metadatum(std::string_view key, std::string_view value) {
    text_.append("<metadata name=\"").append(key).append("\"");
    if (key.starts_with(kOwnPrefix)) text_ += " preserve=\"1\"";
    text_.append(">").append(value).append("</metadata>\n");
  }

  [[nodiscard]] bool coloured() const noexcept { return !contents_.wall_mm.empty(); }

  [[nodiscard]] std::vector<std::vector<std::uint32_t>> bodies_in_order() const {
    if (!contents_.one_body) return bodies_of(mesh_);
    std::vector<std::uint32_t> all(mesh_.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    return {std::move(all)};
  }

  /// The scale of the wall map in steps; readers mix the colours of the corners.
  void add_colours(std::size_t id) {
    colour_id_ = std::to_string(id);
    text_ += "<m:colorgroup id=\"" + colour_id_ + "\">\n";
    for (std::size_t step = 0; step <= kColourSteps; ++step) {
      text_ += "<m:color color=\"#";
      for (const float light : scale_colour(static_cast<double>(step) / kColourSteps))
        append_hexadecimal(text_, srgb_byte(light));
      text_ += "FF\"/>\n";
    }
    text_ += "</m:colorgroup>\n";
  }

  [[nodiscard]] std::uint32_t colour_of(std::uint32_t point) const {
    const double part = double{contents_.wall_mm[point]} / contents_.wall_top_mm;
    return static_cast<std::uint32_t>(std::lround(kColourSteps * std::clamp(part, 0.0, 1.0)));
  }

  /// Returns the id of the object to build.
  std::size_t add_objects(const std::vector<std::vector<std::uint32_t>>& bodies) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      add_object(i + 1, body_name(name_, i + 1, bodies.size()), bodies[i]);
    if (bodies.size() == 1) return 1;
    const std::size_t whole = bodies.size() + 1;
    begin_object(whole, name_, false);
    text_ += "<components>\n";
    for (std::size_t i = 1; i < whole; ++i)
      text_ += "<component objectid=\"" + std::to_string(i) + "\"/>\n";
    text_ += "</components>\n</object>\n";
    return whole;
  }

  void begin_object(std::size_t id, const std::string& name, bool properties) {
    text_ += "<object id=\"" + std::to_string(id) + "\" type=\"model\" name=\"" + name + "\"";
    if (properties) text_ += " pid=\"" + colour_id_ + "\" pindex=\"0\"";
    text_ += ">\n";
  }

  /// The triangles are written on another core beside the vertices.
  void add_object(std::size_t id, const std::string& name,
                  const std::vector<std::uint32_t>& triangles) {
    begin_object(id, name, coloured());
    sizes_.push_back(triangles.size());
    const std::vector<std::uint32_t> points = points_of(triangles);
    for (std::uint32_t i = 0; i < points.size(); ++i) number_[points[i]] = i;
    std::string list;
    // A thread takes longer to begin than a small list.
    constexpr std::size_t kFew = 1000;
    if (triangles.size() < kFew) {
      add_vertices(points);
      list = triangle_list(triangles);
    } else {
      for_each_part(2, [&](std::size_t part) {
        if (part == 0)
          list = triangle_list(triangles);
        else
          add_vertices(points);
      });
    }
    text_.append(list).append("</mesh>\n</object>\n");
    for (const std::uint32_t point : points) number_[point] = kUnused;
  }

  /// The points that the triangles use, in their order in the mesh. Visits no others: a mesh may
  /// have as many bodies as points. Until their numbers are set, the points are marked by 0.
  [[nodiscard]] std::vector<std::uint32_t> points_of(const std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t t : triangles)
      for (const std::uint32_t point : mesh_.triangles[t])
        if (std::exchange(number_[point], 0) == kUnused) points.push_back(point);
    std::ranges::sort(points);
    return points;
  }

  void add_vertices(const std::vector<std::uint32_t>& points) {
    text_ += "<mesh>\n<vertices>\n";
    ElementText element;
    for (const std::uint32_t i : points) {
      step_of_loop();
      const glm::vec3 point = file_point(mesh_.points[i]);
      element.add("<vertex x=\"");
      element.add(point.x);
      element.add("\" y=\"");
      element.add(point.y);
      element.add("\" z=\"");
      element.add(point.z);
      element.add("\"/>\n");
      element.move_to(text_);
    }
    text_ += "</vertices>\n";
  }

  [[nodiscard]] std::string triangle_list(const std::vector<std::uint32_t>& triangles) const {
    constexpr std::size_t kPlainBytes = 44, kColourBytes = 30;
    std::string list;
    list.reserve((kPlainBytes + (coloured() ? kColourBytes : 0)) * triangles.size() + 64);
    list += "<triangles>\n";
    ElementText element;
    for (const std::uint32_t t : triangles) {
      step_of_loop();
      const auto& [a, b, c] = mesh_.triangles[t];
      element.add("<triangle v1=\"");
      element.add(number_[a]);
      element.add("\" v2=\"");
      element.add(number_[b]);
      element.add("\" v3=\"");
      element.add(number_[c]);
      if (coloured()) add_corner_colours(element, mesh_.triangles[t]);
      element.add("\"/>\n");
      element.move_to(list);
    }
    list += "</triangles>\n";
    return list;
  }

  void add_corner_colours(ElementText& element,
                          const std::array<std::uint32_t, 3>& triangle) const {
    element.add("\" pid=\"");
    element.add(colour_id_);
    element.add("\" p1=\"");
    element.add(colour_of(triangle[0]));
    element.add("\" p2=\"");
    element.add(colour_of(triangle[1]));
    element.add("\" p3=\"");
    element.add(colour_of(triangle[2]));
  }

  const TriangleMesh& mesh_;
  const FileContents& contents_;
  std::string name_, text_, colour_id_;
  std::vector<std::size_t> sizes_;
  std::vector<std::uint32_t> number_;  ///< of each point in the object that is written
};

}  // namespace

ModelPart encode_3mf_model(const TriangleMesh& mesh, const FileContents& contents) {
  return ModelWriter(mesh, contents).write();
}

}  // namespace clay::solid::inline formats
