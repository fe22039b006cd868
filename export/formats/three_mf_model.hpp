#pragma once
// The model part of a 3MF package: read by the events of its XML, then built into one mesh.

#include "claystack/core/result.hpp"
#include "claystack/export/formats.hpp"
#include "export/formats/three_mf_grammar.hpp"
#include "export/formats/three_mf_volumes.hpp"
#include "export/formats/xml_reader.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clay::solid::inline formats::three_mf {

/// A matrix of 4 x 3: (x, y, z, 1) times it is the new place.
using Transform = std::array<double, 12>;
inline constexpr Transform kStill{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

struct Placed {
  std::uint32_t object = 0;  ///< index
  Transform transform = kStill;
};

struct Object {
  std::string type = "model";
  std::vector<glm::vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Placed> components;
  // With all components:
  std::uint64_t all_points = 0, all_triangles = 0;
  std::size_t depth = 0;
};

/// Below 0 where the matrix mirrors.
[[nodiscard]] double determinant(const Transform& matrix);

/// Reads the start part of a package, after the other parts whose objects it names by their path.
class ModelReader final : public XmlReader::Events {
 public:
  /// `volumes`: those that are not clay.
  explicit ModelReader(const ReadOptions& options, SlicerVolumes volumes = {})
      : options_(options), volumes_(std::move(volumes)) {}

  /// Before and after a part that is not the start part.
  void begin_other(std::string_view path);
  void end_other();

  void begin(XmlReader& reader, const XmlElement& element) override;
  void end(XmlReader& reader) override;
  void text(XmlReader& reader, std::string_view piece) override;

  /// After the end of the start part: all its items in one mesh, in mm.
  [[nodiscard]] Result<TriangleMesh> build(std::string_view name) const;
  /// The text of the metadata `claystack:pot`; empty: there is none.
  [[nodiscard]] const std::string& pot_text() const noexcept { return pot_text_; }

 private:
  void enter(XmlReader& reader, Place place, const XmlElement& element);
  void begin_model(XmlReader& reader, const XmlElement& element);
  void begin_metadata(XmlReader& reader, const XmlElement& element);
  void begin_object(XmlReader& reader, const XmlElement& element);
  void end_object(XmlReader& reader);
  void add_vertex(XmlReader& reader, const XmlElement& element);
  void add_triangle(XmlReader& reader, const XmlElement& element);
  /// Whether the next triangle of the object belongs to a volume that is not clay.
  [[nodiscard]] bool next_is_no_clay();
  void add_placed(XmlReader& reader, const XmlElement& element, std::vector<Placed>& list);
  void add_resource(XmlReader& reader, const XmlElement& element);
  void check_property(XmlReader& reader, const XmlElement& element);

  /// Meaning of the ids and of the unit of one part.
  struct Part {
    double unit_mm = 1.0;
    std::set<std::uint32_t> resources;  ///< ids of all kinds
    std::set<std::uint32_t> properties;
    std::map<std::uint32_t, std::uint32_t> object_of;  ///< index by id
    std::set<std::string, std::less<>> metadata;
    bool has_resources = false, has_build = false;
  };
  /// The part of the object that a component or an item names; null after a fault.
  [[nodiscard]] const Part* part_of(XmlReader& reader, const XmlElement& element) const;

  struct Counts {
    std::uint64_t points = 0, triangles = 0;
  };
  [[nodiscard]] Result<Counts> counted_build(std::string_view name) const;
  /// The items that are not read, for a message; empty: all are.
  [[nodiscard]] std::string left_out() const;

  ReadOptions options_;
  SlicerVolumes volumes_;
  std::vector<Place> places_{Place::outside};
  std::size_t foreign_depth_ = 0;       ///< within an element of another namespace
  Part part_;                           ///< the one that is read
  std::string other_;                   ///< the key of its path; empty: it is the start part
  std::map<std::string, Part> others_;  ///< those that were read before, by the keys of their paths
  std::vector<Object> objects_;         ///< of all parts
  std::uint32_t id_ = 0;                ///< of the object that is read
  bool has_mesh_ = false, has_components_ = false;
  const SlicerVolumes::Ranges* no_clay_ranges_ = nullptr;  ///< of the object that is read
  std::uint32_t triangle_ = 0;    ///< the next one of the object that is read
  SlicerVolumes::Count dropped_;  ///< volumes of that object
  SlicerVolumes::Count no_clay_;  ///< volumes of all objects that are not read
  std::vector<Placed> items_;
  std::size_t not_printed_ = 0;  ///< items with printable="0"
  std::size_t twice_ = 0;        ///< triangles that use a vertex twice, left out for repairs
  bool reads_pot_ = false;
  std::string pot_text_;
  std::uint64_t stored_points_ = 0, stored_triangles_ = 0;
};

}  // namespace clay::solid::inline formats::three_mf
