#pragma once
// Shared by plots and maps: frame, axes, curves, legend.

#include "app/chart/axis_scale.hpp"
#include "app/chart/label_placer.hpp"
#include "app/chart/plot.hpp"
#include "core/svg_writer.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace clay::chart {

/// One drawing under construction [px, y down].
class Chart {
 public:
  static constexpr double kWidth = 760.0;

  Chart(std::string_view title, const Axis& x_axis, const Axis& y_axis, AxisScale x, AxisScale y,
        Place place);

  [[nodiscard]] const AxisScale& x() const { return x_; }
  [[nodiscard]] const AxisScale& y() const { return y_; }
  void add(std::string_view svg) { body_.raw(svg); }

  void grid();
  /// In the colour and with the mark of its number; on a map in black on white.
  void curve(const Curve& curve, std::size_t number, bool on_map);
  /// Adds a line to the legend, with a symbol 26 px wide around (0, 0).
  void legend_entry(const std::string& symbol, const std::string& text);
  [[nodiscard]] std::string finish();

 private:
  struct Point {
    double x, y;
    bool zero;  ///< y is 0 on a logarithmic axis: drawn at its lower end
  };
  [[nodiscard]] std::vector<Point> points_of(const std::vector<double>& x,
                                             const std::vector<double>& y) const;
  [[nodiscard]] std::string page(double height);
  void spread(const Curve& curve, std::size_t number);
  void keep_labels(const Curve& curve, const std::vector<Point>& points, std::size_t number);
  /// Call it after all curves are added: the labels avoid them.
  void draw_labels();
  void line(const std::vector<Point>& points, const std::string& classes, bool dashed);
  void marks(const std::vector<Point>& points, std::size_t number, bool on_map);

  AxisScale x_, y_;
  std::string x_label_, y_label_, title_;
  SvgWriter body_;
  std::vector<std::pair<std::string, std::string>> legend_;
  Place place_;
  double top_, left_ = 78.0, right_ = 738.0, bottom_;
  struct Label {
    Spot at;  ///< of its point
    std::string words;
    std::size_t number;  ///< of its curve
  };
  std::vector<Label> labels_;
  LabelPlacer placer_;
  bool zeros_ = false;
};

}  // namespace clay::chart
