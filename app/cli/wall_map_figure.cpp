#include "app/cli/wall_map_figure.hpp"

#include "core/colour_scale.hpp"
#include "core/svg_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clay::cli {
namespace {

std::string colour_at(double part) {
  const auto [red, green, blue] = scale_colour(part);
  return fmt::format("rgb({},{},{})", srgb_byte(red), srgb_byte(green), srgb_byte(blue));
}

class WallMapFigure {
 public:
  explicit WallMapFigure(const std::vector<solid::WallSample>& field) : field_(field) {
    std::vector<double> walls;
    for (const solid::WallSample& sample : field) {
      if (std::isfinite(sample.thickness_mm)) walls.push_back(sample.thickness_mm);
      widest_ = std::max(widest_, sample.at.rho);
      top_ = std::max(top_, sample.at.y);
    }
    // A few places in corners, thicker than all walls, would take most of the colours.
    constexpr double kMostWalls = 0.95;
    std::ranges::sort(walls);
    if (!walls.empty()) {
      thin_ = walls.front();
      thick_ = walls[static_cast<std::size_t>(kMostWalls * static_cast<double>(walls.size() - 1))];
    }
    cut_off_ = walls.size() < field.size() || thick_ < walls.back();
    // 2.5 mm on a page if the figure takes half of it; smaller for a low plate, so that the marks
    // of the scale do not overlap.
    text_ = std::min(0.05 * (2.0 * widest_ + 8.0), 0.15 * top_);
  }

  std::string svg() {
    // With room for the bar and the text "100.0 mm or more".
    const double width = 2.0 * widest_ + 8.0 + 12.0 * text_, height = top_ + 8.0;
    writer_.open("svg", {{"xmlns", "http://www.w3.org/2000/svg"},
                         {"viewBox", fmt::format("{:.2f} {:.2f} {:.2f} {:.2f}", -widest_ - 4.0,
                                                 -top_ - 4.0, width, height)}});
    for (const double side : {-1.0, 1.0}) wall(side);
    legend();
    writer_.close("svg");
    return writer_.take();
  }

 private:
  [[nodiscard]] double part(double thickness_mm) const {
    return thick_ > thin_ ? (thickness_mm - thin_) / (thick_ - thin_) : 0.5;
  }

  /// A line between neighbouring samples of a face.
  void wall(double side) {
    const double stroke = 0.012 * (top_ + widest_);
    for (std::size_t i = 1; i < field_.size(); ++i) {
      const solid::WallSample &a = field_[i - 1], &b = field_[i];
      if (std::hypot(b.at.rho - a.at.rho, b.at.y - a.at.y) > 4.0 * solid::kWallTableSpacingMm)
        continue;
      writer_.element("line", {{"x1", fixed(side * a.at.rho, 2)},
                               {"y1", fixed(-a.at.y, 2)},
                               {"x2", fixed(side * b.at.rho, 2)},
                               {"y2", fixed(-b.at.y, 2)},
                               {"stroke", colour_at(part(0.5 * (a.thickness_mm + b.thickness_mm)))},
                               {"stroke-width", fixed(stroke, 2)},
                               {"stroke-linecap", "round"}});
    }
  }

  void legend() {
    constexpr int kSteps = 40, kMarks = 4;
    const double x = widest_ + 4.0 + text_, step = 0.9 * top_ / kSteps;
    for (int i = 0; i < kSteps; ++i)
      writer_.element("rect", {{"x", fixed(x, 2)},
                               {"y", fixed(-0.05 * top_ - (i + 1) * step, 3)},
                               {"width", fixed(text_, 2)},
                               {"height", fixed(1.05 * step, 3)},
                               {"fill", colour_at((i + 0.5) / kSteps)}});
    for (int i = 0; i <= kMarks; ++i) {
      const double share = static_cast<double>(i) / kMarks;
      writer_.element("text",
                      {{"x", fixed(x + 1.4 * text_, 2)},
                       {"y", fixed(-0.05 * top_ - share * 0.9 * top_ + 0.35 * text_, 2)},
                       {"font-size", fixed(text_, 2)}},
                      fmt::format("{:.1f} mm{}", thin_ + share * (thick_ - thin_),
                                  i == kMarks && cut_off_ ? " or more" : ""));
    }
  }

  const std::vector<solid::WallSample>& field_;
  bool cut_off_ = false;              ///< some places are thicker than the scale
  double thin_ = 0.0, thick_ = 10.0;  ///< the scale; for solid clay the initial values
  double widest_ = 0.0, top_ = 0.0;
  double text_ = 0.0;  ///< height of the letters
  SvgWriter writer_;
};

}  // namespace

std::string wall_map_svg(const std::vector<solid::WallSample>& field) {
  return WallMapFigure(field).svg();
}

}  // namespace clay::cli
