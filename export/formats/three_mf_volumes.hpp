#pragma once
// The volumes of a slicer's project that are not printed as they are: modifiers, supports, and
// volumes that are subtracted. The model does not distinguish them; a part beside it does.

#include "export/formats/xml_reader.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace clay::solid::inline formats::three_mf {

class SlicerVolumes {
 public:
  /// Triangles of one mesh, counted from 0.
  struct Range {
    std::uint32_t first = 0, last = 0;
    bool negative = false;  ///< the slicer subtracts it
  };
  using Ranges = std::map<std::uint32_t, Range>;  ///< by their first triangle
  /// Numbers of volumes.
  struct Count {
    std::size_t other = 0, negative = 0;
    void add(bool is_negative) { ++(is_negative ? negative : other); }
    [[nodiscard]] bool any() const noexcept { return other > 0 || negative > 0; }
    /// "2 modifier or support volumes and 1 negative volume"
    [[nodiscard]] std::string text() const;
  };

  /// An element of one of these parts, in the order of the file.
  void visit(XmlReader& reader, const XmlElement& element);

  /// Triangles that are left out of the mesh of an object of the start part; null: none.
  [[nodiscard]] const Ranges* ranges_of(std::uint32_t object) const;
  /// Whether a component that is left out is negative; null: it is printed.
  [[nodiscard]] const bool* component(std::uint32_t object, std::uint32_t id) const;

 private:
  void begin_volume(XmlReader& reader, const XmlElement& element);
  void begin_part(XmlReader& reader, const XmlElement& element);

  std::uint32_t object_ = 0;  ///< id of the one that is read
  Range volume_;              ///< of PrusaSlicer, that is read
  bool in_volume_ = false;
  std::map<std::uint32_t, Ranges> ranges_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> components_;
};

}  // namespace clay::solid::inline formats::three_mf
