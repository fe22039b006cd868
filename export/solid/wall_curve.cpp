#include "export/solid/wall_curve.hpp"

#include "core/cancel.hpp"
#include "core/compensated_sum.hpp"
#include "export/solid/banded_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace clay::solid {
namespace {

constexpr double kShortestSpan = 0x1p-20;

/// A new knot changes a cubic least-squares spline only near it: the change falls by a factor of
/// 0.535 per span, the largest root of the Gram matrix of uniform cubic B-splines. After 40 spans
/// it is below 2e-11 of its size at the knot.
constexpr std::size_t kReachOfKnot = 40;
constexpr double kNearly = 1.0 - 1e-9;  ///< margin for the change beyond the reach of a knot

/// Spans of a curve, `end` excluded.
struct Window {
  std::size_t first = 0, end = 0;
};

ProfilePoint mix(const ProfilePoint& a, const ProfilePoint& b, double t) {
  return {(1.0 - t) * a.rho + t * b.rho, (1.0 - t) * a.y + t * b.y};
}

double distance(const ProfilePoint& a, const ProfilePoint& b) {
  return std::hypot(a.rho - b.rho, a.y - b.y);
}

/// The knot of index `i` with the ends fourfold.
double knot_at(const std::vector<double>& knots, std::size_t i) {
  return i < 3 ? knots.front() : knots[std::min(i - 3, knots.size() - 1)];
}

/// The points of a line at shares of its length.
class LineByLength {
 public:
  explicit LineByLength(const Polygon& line) : line_(line), shares_(line.size(), 0.0) {
    for (std::size_t i = 1; i < line.size(); ++i)
      shares_[i] = shares_[i - 1] + distance(line[i - 1], line[i]);
    for (double& share : shares_) share /= shares_.back();
    shares_.back() = 1.0;
  }

  /// Calls part(span, a, b, from, to): the curve from `a` to `b` belongs to one span of the window
  /// and to the straight line between two points.
  template <class Part>
  void for_each_part(const std::vector<double>& knots, const Window& window, Part part) const {
    std::size_t span = window.first;
    double a = knots[span];
    auto edge =
        static_cast<std::size_t>(std::ranges::upper_bound(shares_, a) - shares_.begin()) - 1;
    while (span < window.end && edge + 1 < line_.size()) {
      const double b = std::min(knots[span + 1], shares_[edge + 1]);
      if (b > a) part(span, a, b, at(edge, a), at(edge, b));
      a = b;
      if (b == knots[span + 1]) ++span;
      if (b == shares_[edge + 1]) ++edge;
    }
  }

 private:
  [[nodiscard]] ProfilePoint at(std::size_t edge, double share) const {
    const double low = shares_[edge], high = shares_[edge + 1];
    return mix(line_[edge], line_[edge + 1], (share - low) / (high - low));
  }

  const Polygon& line_;
  std::vector<double> shares_;
};

/// The four basis functions that are not zero in a span, at `t` (de Boor, Cox).
std::array<double, 4> basis(const std::vector<double>& knots, std::size_t span, double t) {
  std::array<double, 4> value{1.0, 0.0, 0.0, 0.0};
  const std::size_t k = span + 3;
  for (std::size_t degree = 1; degree <= 3; ++degree) {
    double carried = 0.0;
    for (std::size_t j = 0; j < degree; ++j) {
      const double right = knot_at(knots, k + j + 1), left = knot_at(knots, k + 1 + j - degree);
      const double part = value[j] / (right - left);
      value[j] = carried + (right - t) * part;
      carried = (t - left) * part;
    }
    value[degree] = carried;
  }
  return value;
}

/// Nodes and weights of Gauss' rule on [0, 1]; exact up to degree 9.
struct GaussPoint {
  double at = 0.0, weight = 0.0;
};
constexpr std::array<GaussPoint, 5> kGauss{{{0.046910077030668004, 0.11846344252809454},
                                            {0.23076534494715845, 0.23931433524968324},
                                            {0.5, 0.28444444444444444},
                                            {0.76923465505284155, 0.23931433524968324},
                                            {0.95308992296933200, 0.11846344252809454}}};

/// Moves the control points that lie within the window: those whose spans all do. The first and
/// the last one of the curve stay.
void fit_within(WallCurve& curve, const LineByLength& line, const Window& window) {
  const std::size_t first_free = window.first == 0 ? 1 : window.first + 3;
  const std::size_t free_end = window.end == curve.spans() ? window.end + 2 : window.end;
  const auto is_free = [&](std::size_t i) { return i >= first_free && i < free_end; };
  const std::size_t unknowns = window.end - window.first + 3;
  BandedSystem<3, 2> system(unknowns);
  const auto add = [&](std::size_t span, std::array<double, 4> factors, double weight,
                       ProfilePoint value) {
    for (std::size_t k = 0; k < factors.size(); ++k) {
      if (is_free(span + k)) continue;
      const ProfilePoint& given = curve.control[span + k];
      value = {value.rho - factors[k] * given.rho, value.y - factors[k] * given.y};
      factors[k] = 0.0;
    }
    system.add(span - window.first, factors, weight, {value.rho, value.y});
  };
  line.for_each_part(
      curve.knots, window,
      [&](std::size_t span, double a, double b, const ProfilePoint& from, const ProfilePoint& to) {
        for (const GaussPoint& node : kGauss)
          add(span, basis(curve.knots, span, a + node.at * (b - a)), node.weight * (b - a),
              mix(from, to, node.at));
      });
  for (std::size_t i = 0; i < unknowns; ++i) {
    if (is_free(window.first + i)) continue;
    const ProfilePoint& given = curve.control[window.first + i];
    const std::size_t from = std::min(i, unknowns - 4);
    std::array<double, 4> factors{};
    factors.at(i - from) = 1.0;
    system.add(from, factors, 1.0, {given.rho, given.y});
  }
  std::size_t i = window.first;
  for (const auto& [rho, y] : std::move(system).solved()) curve.control[i++] = {rho, y};
}

Window whole(const WallCurve& curve) { return {0, curve.spans()}; }

/// The bound in each span of the window.
std::vector<double> bounds_by_span(const WallCurve& curve, const LineByLength& line,
                                   const Window& window) {
  std::vector<double> bounds(window.end - window.first, 0.0);
  line.for_each_part(
      curve.knots, window,
      [&](std::size_t span, double a, double b, const ProfilePoint& from, const ProfilePoint& to) {
        const auto points = curve.bezier(span, a, b);
        double& bound = bounds[span - window.first];
        for (std::size_t i = 0; i < points.size(); ++i)
          bound = std::max(bound, distance(points[i], mix(from, to, static_cast<double>(i) / 3.0)));
      });
  return bounds;
}

/// Fits a line with as few knots as it finds.
class Fitting {
 public:
  Fitting(const Polygon& line, double tolerance_mm)
      : line_(line), by_length_(line), tolerance_mm_(tolerance_mm) {}

  WallCurve run() {
    halve_spans();
    const std::vector<double> halved = curve_.knots;
    drop_knots();
    merge_knots();
    fit(std::exchange(curve_.knots, {}));
    if (farthest(curve_, whole(curve_)) > tolerance_mm_) fit(halved);
    return std::move(curve_);
  }

 private:
  void fit(std::vector<double> knots) {
    stop_if_cancelled();
    curve_.knots = std::move(knots);
    curve_.control.assign(curve_.spans() + 3, line_.front());
    curve_.control.back() = line_.back();
    fit_within(curve_, by_length_, whole(curve_));
  }

  [[nodiscard]] double farthest(const WallCurve& curve, const Window& window) const {
    return std::ranges::max(bounds_by_span(curve, by_length_, window));
  }

  void halve_spans() {
    fit({0.0, 1.0});
    while (true) {
      const std::vector<double> bounds = bounds_by_span(curve_, by_length_, whole(curve_));
      std::vector<double> knots{0.0};
      for (std::size_t i = 0; i < curve_.spans(); ++i) {
        const double low = curve_.knots[i], high = curve_.knots[i + 1];
        if (bounds[i] > tolerance_mm_ && high - low > kShortestSpan)
          knots.push_back(0.5 * (low + high));
        knots.push_back(high);
      }
      if (knots.size() == curve_.knots.size()) return;
      fit(std::move(knots));
    }
  }

  /// Halving leaves knots on the way to each bend that are not needed in the end.
  void drop_knots() {
    for (std::size_t i = 1; i + 1 < curve_.knots.size();)
      if (!keep_without(i)) ++i;
  }

  /// One knot in the middle may replace two.
  void merge_knots() {
    for (std::size_t i = 1; i + 2 < curve_.knots.size(); ++i)
      keep_without(i + 1, 0.5 * (curve_.knots[i] + curve_.knots[i + 1]));
  }

  /// Drops a knot, and moves the one before it if that is requested, if the curve stays within the
  /// tolerance. It is fitted again as far as the knots have an influence.
  bool keep_without(std::size_t knot, std::optional<double> before = {}) {
    stop_if_cancelled();
    WallCurve fewer = curve_;
    fewer.knots.erase(fewer.knots.begin() + std::ptrdiff_t(knot));
    fewer.control.erase(fewer.control.begin() + std::ptrdiff_t(knot) + 1);
    if (before) fewer.knots[knot - 1] = *before;
    const Window window{knot - std::min(knot, kReachOfKnot),
                        std::min(fewer.spans(), knot + kReachOfKnot)};
    fit_within(fewer, by_length_, window);
    if (farthest(fewer, window) > kNearly * tolerance_mm_) return false;
    curve_ = std::move(fewer);
    return true;
  }

  const Polygon& line_;
  LineByLength by_length_;
  double tolerance_mm_;
  WallCurve curve_;
};

}  // namespace

/// Control point i is the blossom at i times b and 3 - i times a.
std::array<ProfilePoint, 4> WallCurve::bezier(std::size_t span, double a, double b) const {
  const std::size_t k = span + 3;
  using Points = std::array<ProfilePoint, 4>;
  const auto blossom = [&](Points d, std::size_t r, double t) {
    for (std::size_t j = 3; j >= r; --j) {
      const double left = knot_at(knots, j + k - 3), right = knot_at(knots, j + 1 + k - r);
      d[j] = mix(d[j - 1], d[j], (t - left) / (right - left));
    }
    return d;
  };
  const Points all{control[span], control[span + 1], control[span + 2], control[span + 3]};
  const Points at_a = blossom(all, 1, a), at_aa = blossom(at_a, 2, a);
  const Points at_ab = blossom(at_a, 2, b), at_bb = blossom(blossom(all, 1, b), 2, b);
  return {blossom(at_aa, 3, a)[3], blossom(at_aa, 3, b)[3], blossom(at_ab, 3, b)[3],
          blossom(at_bb, 3, b)[3]};
}

WallCurve fitted(const Polygon& line, double tolerance_mm) {
  return Fitting(line, tolerance_mm).run();
}

double distance_bound(const WallCurve& curve, const Polygon& line) {
  return std::ranges::max(bounds_by_span(curve, LineByLength(line), whole(curve)));
}

double swept_volume(const WallCurve& curve) {
  CompensatedSum sum;
  for (std::size_t span = 0; span < curve.spans(); ++span) {
    const auto p = curve.bezier(span, curve.knots[span], curve.knots[span + 1]);
    for (const GaussPoint& node : kGauss) {
      const double t = node.at, u = 1.0 - t;
      const double rho = u * u * u * p[0].rho + 3.0 * u * u * t * p[1].rho +
                         3.0 * u * t * t * p[2].rho + t * t * t * p[3].rho;
      const double rise = 3.0 * (u * u * (p[1].y - p[0].y) + 2.0 * u * t * (p[2].y - p[1].y) +
                                 t * t * (p[3].y - p[2].y));
      sum.add(node.weight * rho * rho * rise);
    }
  }
  return std::numbers::pi * sum.value();
}

/// A chord of a part 1/n of a span is within |C''| / (8 n^2) of it.
Polygon flattened(const WallCurve& curve, double error_mm) {
  Polygon line{curve.control.front()};
  for (std::size_t span = 0; span < curve.spans(); ++span) {
    const auto p = curve.bezier(span, curve.knots[span], curve.knots[span + 1]);
    const auto bend = [&](std::size_t i) {
      return 6.0 * std::hypot(p[i].rho - 2.0 * p[i + 1].rho + p[i + 2].rho,
                              p[i].y - 2.0 * p[i + 1].y + p[i + 2].y);
    };
    const double parts = std::ceil(std::sqrt(std::max(bend(0), bend(1)) / (8.0 * error_mm)));
    const auto count = static_cast<std::size_t>(std::clamp(parts, 1.0, 1e4));
    for (std::size_t i = 1; i <= count; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(count);
      const ProfilePoint a = mix(p[0], p[1], t), b = mix(p[1], p[2], t), c = mix(p[2], p[3], t);
      line.push_back(i == count ? p[3] : mix(mix(a, b, t), mix(b, c, t), t));
    }
  }
  line.back() = curve.control.back();
  return line;
}

}  // namespace clay::solid
