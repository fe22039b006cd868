#pragma once
// The permitted nesting of the elements of a 3MF model.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace clay::solid::inline formats::three_mf {

/// Position of a reader: in an element of the core specification, or outside the model.
enum class Place : std::uint8_t {
  outside,
  model,
  metadata,
  metadata_group,
  resources,
  materials,
  base,
  object,
  mesh,
  vertices,
  vertex,
  triangles,
  triangle,
  components,
  component,
  build,
  item,
};

/// The place of an element in its parent; none where the specification does not allow it.
[[nodiscard]] std::optional<Place> place_of(std::string_view name, Place parent);

/// The message about an element that is not allowed at its place.
[[nodiscard]] std::string misplaced(std::string_view name, Place parent);

}  // namespace clay::solid::inline formats::three_mf
