#pragma once
// One reader for each format; read_drawing chooses.

#include "app/import/drawing.hpp"

#include <span>

namespace clay::importing {

/// Limits that every reader applies to points as soon as it has them, because a small file may
/// contain very many.
class PointLimits {
 public:
  /// "expected ..., found ..." for the first invalid point [mm]; empty if all are valid. Counts
  /// them.
  std::string problem_with(std::span<const glm::dvec2> points_mm);
  /// The same for control points, which are not counted.
  static std::string out_of_bounds(std::span<const glm::dvec2> points_mm);

 private:
  std::size_t count_ = 0;
};

/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");

/// Whether a layer is for construction by its name, which then begins with "construction" in any
/// case. Such layers are drawn only if they are requested by name.
bool for_construction(std::string_view layer_name);

/// Names of layers for a message: "foot", "rim" and 3 more; the first twelve are named.
std::string list_of(std::span<const std::string> names);

/// `layer`: the only layer to read; empty: all that are shown. `scale`: as for read_drawing.
Result<Drawing> read_svg(std::string_view bytes, const std::string& name, const std::string& layer,
                         double scale);
Result<Drawing> read_dxf(std::string_view bytes, const std::string& name, const std::string& layer,
                         double scale);
Result<Drawing> read_csv(std::string_view text, const std::string& name, double scale);

}  // namespace clay::importing
