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
  std::vector<double> low, high;                ///< spread of y, if measured
  bool line = true;                             ///< false: points only
  bool dashed = false;                          ///< for theory and bounds
  std::vector<double> x_low = {}, x_high = {};  ///< spread of x, if measured
  std::vector<std::string> labels = {};         ///< beside the points, if any
};

struct Plot {
  std::string id;  ///< unique in the report
  std::string title;
  Axis x, y;
  std::vector<Curve> curves;
  std::string note;
};

/// A map over two parameters, for example the servo's stable cells. cells[row][column].
struct Map {
  std::string id;
  std::string title;
  Axis x, y;
  std::vector<double> x_values, y_values;
  std::vector<std::vector<double>> cells;  ///< 0 = good .. 1 = bad; NaN = not measured
  std::vector<Curve> curves;               ///< drawn over it
  std::string note;
};

/// A standalone drawing includes its title and style; one in a page uses the page's style.
enum class Place { alone, page };

/// Omits values that are not finite or that a logarithmic axis cannot show, except zero, which is
/// drawn on the axis as an open triangle. Curves of thousands of points are thinned to the extremes
/// of each half pixel. Names are escaped.
[[nodiscard]] std::string svg_of(const Plot& plot, Place place);
/// Both the colour and the size of a dot encode the value of a cell.
[[nodiscard]] std::string svg_of(const Map& map, Place place);

/// CSS of the drawings, for light and dark themes, for a page that contains them.
[[nodiscard]] std::string_view style();

}  // namespace clay::chart
