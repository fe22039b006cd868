#pragma once
// One reader for each format; read_drawing chooses.

#include "app/import/drawing.hpp"

#include <span>

namespace clay::importing {

/// What every reader asks of the points that it finds, as soon as it has them: a small file may
/// draw very much.
class PointLimits {
 public:
  /// "expected ..., found ..." for the first point [mm] that no drawing has; empty where all are
  /// sound. Counts them.
  std::string problem_with(std::span<const glm::dvec2> points_mm);
  /// The same for points that only steer a curve: those do not count.
  static std::string out_of_bounds(std::span<const glm::dvec2> points_mm);

 private:
  std::size_t count_ = 0;
};

Result<Drawing> read_svg(std::string_view bytes, const std::string& name);
Result<Drawing> read_dxf(std::string_view bytes, const std::string& name);
Result<Drawing> read_csv(std::string_view text, const std::string& name);

}  // namespace clay::importing
