#pragma once
// Plots and maps as data, and as SVG: for `throw --error-plot` and for the report of `bench`.

#include <string>
#include <string_view>
#include <vector>

namespace clay::chart {

struct Axis {
  std::string label;  ///< with its unit
  bool logarithmic = false;
};

struct Curve {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> low, high;  ///< spread of y, where measured
  bool line = true;               ///< joined by a line, or points alone
  bool dashed = false;            ///< for theory and bounds
};

struct Plot {
  std::string id;  ///< unique in the report
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
  std::string note;
};

/// A map over two parameters: the servo's stable cells, for one. cells[row][column].
struct Map {
  std::string id;
  std::string title;
  Axis x, y;
  std::vector<double> x_values, y_values;
  std::vector<std::vector<double>> cells;  ///< 0 = good .. 1 = bad; NaN = not measured
  std::vector<Curve> curves;               ///< drawn over it
  std::string note;
};

/// A drawing that stands alone brings its title and its style; one inside a page uses the page's.
enum class Place { alone, page };

/// What is not finite is not drawn, nor is what a logarithmic axis cannot show, save for zero: that
/// stands on the axis, as an open triangle. Curves of thousands of points are thinned to the
/// extremes of each half pixel. Names may hold anything; they are escaped.
[[nodiscard]] std::string svg_of(const Plot& plot, Place place);
/// Colour and the size of a dot both tell how bad a cell is.
[[nodiscard]] std::string svg_of(const Map& map, Place place);

/// CSS of the drawings, for light and dark, for a page that holds some.
[[nodiscard]] std::string_view style();

}  // namespace clay::chart
