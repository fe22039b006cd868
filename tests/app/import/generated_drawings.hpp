#pragma once
// Random sections of pots as SVG, DXF and CSV files, and the comparison of the results of `import`
// with the pictures of librsvg.

#include <random>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace clay::importing::generated {

/// A piece of an outline: a line, an arc by its bulge, or a cubic.
struct Piece {
  glm::dvec2 to{0.0};
  double bulge = 0.0;
  bool cubic = false;
  glm::dvec2 steer_1{0.0}, steer_2{0.0};
};

/// The right half of a section, from (0, 0) around to (0, floor): x from the axis, y up [mm].
struct Outline {
  std::vector<Piece> pieces;
  double width_mm = 0.0, height_mm = 0.0;
};

/// `curves`: arcs and cubics too, otherwise lines alone.
Outline outline(std::mt19937& random, bool curves);

/// Files of one outline. Those of SVG and DXF differ in elements, transforms, blocks and direction.
std::string svg_file(const Outline& outline, std::mt19937& random);
std::string dxf_file(const Outline& outline, std::mt19937& random);
std::string csv_file(const Outline& outline, std::mt19937& random);
/// The outline alone, to be painted.
std::string plain_svg(const Outline& outline);

/// Imports drawing number `number` of its format and compares it. Returns the difference; empty:
/// none.
std::string difference(const std::string& format, unsigned number);

}  // namespace clay::importing::generated
