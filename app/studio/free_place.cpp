#include "app/studio/free_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::studio {
namespace {

/// Rows within the height of the tool at this height, and the radius of the tool in each.
class Reach {
 public:
  Reach(const render::PotView& pot, const Tool& tool, double y_mm) : tool_(tool), y_mm_(y_mm) {
    row_mm_ = pot.rows.empty() ? 1.0 : pot.height_mm / static_cast<double>(pot.rows.size());
    const double rows = static_cast<double>(pot.rows.size());
    const auto row = [&](double at_mm) {
      return static_cast<std::size_t>(std::clamp(std::floor(at_mm / row_mm_), 0.0, rows));
    };
    first_ = row(y_mm + tool.low());
    last_ = std::min(row(y_mm + tool.high()) + 1, pot.rows.size());
  }
  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t last() const { return last_; }
  /// The largest radius of the tool between the lower and the upper edge of a row.
  [[nodiscard]] double width_mm(std::size_t row) const {
    const double low = std::max(static_cast<double>(row) * row_mm_ - y_mm_, tool_.low());
    const double high = std::min(static_cast<double>(row + 1) * row_mm_ - y_mm_, tool_.high());
    if (low > high) return 0.0;
    const double nearest = std::clamp(0.0, low, high);  // a sphere is widest at its centre
    return std::max({tool_.radius(low), tool_.radius(high), tool_.radius(nearest),
                     tool_.radius(0.5 * (low + high))});
  }

 private:
  const Tool& tool_;
  double y_mm_, row_mm_ = 1.0;
  std::size_t first_ = 0, last_ = 0;
};

struct Sides {
  double outside_mm = 0.0;  ///< the tool is clear of the clay from this rho on
  double inside_mm = std::numeric_limits<double>::infinity();  ///< and up to this rho in the bore;
                                                               ///< negative: nowhere in the bore
};

Sides sides_at(const render::PotView& pot, const Tool& tool, double y_mm, Bore bore = Bore::open) {
  Sides sides;
  const Reach reach(pot, tool, y_mm);
  for (std::size_t row = reach.first(); row < reach.last(); ++row) {
    const double width = reach.width_mm(row);
    if (width <= 0.0) continue;
    sides.outside_mm = std::max(sides.outside_mm, pot.rows[row].outer_mm + width + kClearanceMm);
    sides.inside_mm = std::min(sides.inside_mm, pot.rows[row].inner_mm - width - kClearanceMm);
  }
  if (bore == Bore::covered) sides.inside_mm = -1.0;
  return sides;
}

bool is_free(const Sides& sides, double rho) {
  return rho >= sides.outside_mm || rho <= sides.inside_mm;
}

/// Moves straight up in steps of one row until the tool is clear.
double free_height(const render::PotView& pot, const Tool& tool, double rho, double y_mm,
                   Bore bore) {
  const double step =
      pot.rows.empty() ? 1.0 : std::max(0.1, pot.height_mm / static_cast<double>(pot.rows.size()));
  const double top = pot.height_mm - tool.low() + kClearanceMm;
  while (y_mm < top && !is_free(sides_at(pot, tool, y_mm, bore), rho)) y_mm += step;
  return std::min(y_mm, top);
}

/// Radius over height: the slope of the wall's middle line beside the tool, by least squares, up to
/// 60 degrees. Bumps of the wall's thickness, which a pinch is to thin, do not count.
double lean_at(const render::PotView& pot, const Tool& tool, double y_mm) {
  constexpr double kMostLean = 1.732;  // tan 60 degrees
  const Reach reach(pot, tool, y_mm);
  double count = 0.0, sum_row = 0.0, sum_middle = 0.0, sum_rows = 0.0, sum_both = 0.0;
  for (std::size_t row = reach.first(); row < reach.last(); ++row) {
    if (!(pot.rows[row].inner_mm > 0.0f)) continue;
    const auto up = static_cast<double>(row - reach.first());
    const double middle =
        0.5 * static_cast<double>(pot.rows[row].outer_mm + pot.rows[row].inner_mm);
    count += 1.0;
    sum_row += up;
    sum_middle += middle;
    sum_rows += up * up;
    sum_both += up * middle;
  }
  if (count < 3.0) return 0.0;
  const double per_row =
      (count * sum_both - sum_row * sum_middle) / (count * sum_rows - sum_row * sum_row);
  const double rows_per_mm = static_cast<double>(pot.rows.size()) / pot.height_mm;
  return std::clamp(per_row * rows_per_mm, -kMostLean, kMostLean);
}

}  // namespace

glm::dvec2 free_place(const render::PotView& pot, const Tool& tool, glm::dvec2 place_mm,
                      Bore bore) {
  place_mm.y = std::max(place_mm.y, 0.0);
  const double side = place_mm.x < 0.0 ? -1.0 : 1.0, rho = std::abs(place_mm.x);
  const Sides sides = sides_at(pot, tool, place_mm.y, bore);
  if (is_free(sides, rho)) return place_mm;
  glm::dvec2 nearest(side * sides.outside_mm, place_mm.y);
  double least = sides.outside_mm - rho;
  if (sides.inside_mm >= 0.0 && rho - sides.inside_mm < least) {
    nearest.x = side * sides.inside_mm;
    least = rho - sides.inside_mm;
  }
  const double above = free_height(pot, tool, rho, place_mm.y, bore);
  if (above - place_mm.y < least) nearest = {place_mm.x, above};
  return nearest;
}

std::optional<WallPlace> wall_at(const render::PotView& pot, const Tool& tool, double y_mm) {
  const render::Row* row = row_at(pot, y_mm);
  if (row == nullptr || row->inner_mm <= 0.0f) return std::nullopt;
  const Sides sides = sides_at(pot, tool, y_mm);
  if (sides.inside_mm < 0.0) return std::nullopt;
  // The gap of a pinch is measured between the widest points of the two tools.
  const double outer = sides.outside_mm - tool.widest(), inner = sides.inside_mm + tool.widest();
  return WallPlace{0.5 * (outer + inner), std::max(0.0, outer - inner), y_mm};
}

std::optional<WallPlace> wall_above(const render::PotView& pot, const Tool& tool, double y_mm) {
  constexpr double kStepMm = 0.5;
  std::optional<WallPlace> wall;
  for (double y = std::max(0.0, y_mm); y < pot.height_mm && !wall; y += kStepMm)
    wall = wall_at(pot, tool, y);
  return wall;
}

double stand_off_mm(const render::PotView& pot, const Tool& tool, double y_mm) {
  constexpr int kSamples = 64;
  const double lean = lean_at(pot, tool, y_mm), step = (tool.high() - tool.low()) / kSamples;
  double outer = tool.widest(), inner = tool.widest();
  for (int k = 0; k <= kSamples; ++k) {
    const double t = tool.low() + k * step, f = tool.radius(t);
    outer = std::max(outer, f + lean * t);
    inner = std::max(inner, f - lean * t);
  }
  return outer + inner - 2.0 * tool.widest();
}

bool inside(const render::PotView& pot, const glm::dvec3& place_mm) {
  const render::Row* row =
      row_at(pot, std::clamp(place_mm.y, 0.0, std::nextafter(pot.height_mm, 0.0)));
  if (row == nullptr) return false;
  const double middle = 0.5 * static_cast<double>(row->outer_mm + row->inner_mm);
  return row->inner_mm > 0.0f && std::hypot(place_mm.x, place_mm.z) < middle;
}

}  // namespace clay::studio
