#pragma once
#include <vector>

namespace clay::chart {

/// A place in a drawing [px, y down].
struct Spot {
  double x = 0.0, y = 0.0;
};

struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

/// Finds places for the labels of points: within the frame, and clear of marks, of other labels and
/// of lines where that is possible.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Box& frame) : frame_(frame) {}

  void avoid_mark(Spot at) { marks_.push_back(at); }
  void avoid_line(Spot from, Spot to) { lines_.push_back({from, to}); }

  struct Label {
    Spot at;                  ///< of the text's baseline
    const char* anchor = "";  ///< the end of the text that is at `at`: SVG's text-anchor
  };
  /// Beside the point `at`. Later labels avoid this one.
  Label place(Spot at, double width_px);

 private:
  struct Line {
    Spot from, to;
  };
  [[nodiscard]] double cost(const Box& box) const;

  Box frame_;
  std::vector<Spot> marks_;
  std::vector<Line> lines_;
  std::vector<Box> labels_;
};

}  // namespace clay::chart
