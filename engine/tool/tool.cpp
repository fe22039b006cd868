#include "claystack/engine/tool.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace clay {
namespace {

constexpr double kMaxSizeMm = 5000.0;

bool is_size(double mm) { return mm > 0.0 && mm <= kMaxSizeMm; }

tl::unexpected<Error> bad_size(const std::string& what, double found) {
  return failure(
      ErrorKind::bad_input,
      "tool: expected " + what + " above 0 and at most 5000 mm, found " + number_text(found));
}

struct Built {
  Tool::Profile profile;
  double low, high, widest;
};

Result<Built> build_profile(const SphereSpec& s) {
  if (!is_size(s.radius_mm)) return bad_size("a radius", s.radius_mm);
  return Built{EllipseProfile{s.radius_mm, s.radius_mm, 1.0 / s.radius_mm}, -s.radius_mm,
               s.radius_mm, s.radius_mm};
}

Result<Built> build_profile(const EllipseSpec& s) {
  if (!is_size(s.half_height_mm)) return bad_size("a half height", s.half_height_mm);
  if (!is_size(s.half_width_mm)) return bad_size("a half width", s.half_width_mm);
  return Built{EllipseProfile{s.half_height_mm, s.half_width_mm, 1.0 / s.half_height_mm},
               -s.half_height_mm, s.half_height_mm, s.half_width_mm};
}

Result<Built> build_profile(const RibSpec& s) {
  if (!is_size(s.height_mm)) return bad_size("a height", s.height_mm);
  if (!is_size(s.radius_mm)) return bad_size("a radius", s.radius_mm);
  return Built{RibProfile{s.radius_mm}, -0.5 * s.height_mm, 0.5 * s.height_mm, s.radius_mm};
}

/// End slope of a monotone cubic: three-point formula, limited to keep the shape.
double end_slope(double h0, double h1, double d0, double d1) {
  const double m = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (m * d0 <= 0.0) return 0.0;
  if (d0 * d1 < 0.0 && std::abs(m) > 3.0 * std::abs(d0)) return 3.0 * d0;
  return m;
}

std::vector<double> monotone_slopes(const std::vector<double>& t, const std::vector<double>& f) {
  const std::size_t n = t.size();
  std::vector<double> h(n - 1), d(n - 1), m(n);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    h[k] = t[k + 1] - t[k];
    d[k] = (f[k + 1] - f[k]) / h[k];
  }
  if (n == 2) return {d[0], d[0]};
  m.front() = end_slope(h[0], h[1], d[0], d[1]);
  m.back() = end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (d[k - 1] * d[k] <= 0.0) continue;  // keeps extrema of the samples
    const double w1 = 2.0 * h[k] + h[k - 1], w2 = h[k] + 2.0 * h[k - 1];
    m[k] = (w1 + w2) / (w1 / d[k - 1] + w2 / d[k]);
  }
  return m;
}

Result<Built> build_profile(const SampledSpec& s) {
  if (s.t_mm.size() < 2 || s.t_mm.size() != s.f_mm.size())
    return failure(ErrorKind::bad_input,
                   "tool: expected as many t_mm as f_mm, two at least, found " +
                       std::to_string(s.t_mm.size()) + " and " + std::to_string(s.f_mm.size()));
  for (std::size_t k = 0; k < s.t_mm.size(); ++k) {
    if (!(std::abs(s.t_mm[k]) <= kMaxSizeMm) || (k > 0 && !(s.t_mm[k] > s.t_mm[k - 1])))
      return failure(ErrorKind::bad_input, "tool: expected t_mm to rise within 5000 mm, found " +
                                               number_text(s.t_mm[k]) + " at sample " +
                                               std::to_string(k));
    if (!(s.f_mm[k] >= 0.0 && s.f_mm[k] <= kMaxSizeMm))
      return failure(ErrorKind::bad_input, "tool: expected f_mm from 0 to 5000, found " +
                                               number_text(s.f_mm[k]) + " at sample " +
                                               std::to_string(k));
  }
  return Built{SampledProfile{s.t_mm, s.f_mm, monotone_slopes(s.t_mm, s.f_mm)}, s.t_mm.front(),
               s.t_mm.back(), *std::ranges::max_element(s.f_mm)};
}

/// The interval of `at` in an increasing table; the first or last one if `at` lies outside.
std::size_t interval_of(const std::vector<double>& t, double at) {
  const auto above = std::upper_bound(t.begin() + 1, t.end() - 1, at);
  return static_cast<std::size_t>(above - t.begin()) - 1;
}

}  // namespace

double SampledProfile::radius(double at) const noexcept {
  const std::size_t k = interval_of(t, at);
  const double h = t[k + 1] - t[k], s = (at - t[k]) / h, r = 1.0 - s;
  return f[k] * (1.0 + 2.0 * s) * r * r + slopes[k] * h * s * r * r +
         f[k + 1] * s * s * (3.0 - 2.0 * s) - slopes[k + 1] * h * s * s * r;
}

double SampledProfile::slope(double at) const noexcept {
  const std::size_t k = interval_of(t, at);
  const double h = t[k + 1] - t[k], s = (at - t[k]) / h, r = 1.0 - s;
  return 6.0 * s * r * (f[k + 1] - f[k]) / h + slopes[k] * r * (r - 2.0 * s) +
         slopes[k + 1] * s * (s - 2.0 * r);
}

Surface SampledProfile::surface(double at, double height) const noexcept {
  // 1 / (1 + f'^2) and f' / (1 + f'^2), also where f' overflows.
  const auto normal2 = [](double rise) { return 1.0 / (1.0 + rise * rise); };
  const double rise = slope(at), steep = std::abs(rise);
  const double lean =
      steep > 1.0 ? (rise > 0.0 ? 1.0 : -1.0) / (steep + 1.0 / steep) : rise * normal2(rise);
  const double above = normal2(slope(at + 0.5 * height)), below = normal2(slope(at - 0.5 * height));
  return {radius(at), {normal2(rise), lean, (above - below) / height}};
}

Result<Tool> Tool::build(const ToolShapeSpec& spec) {
  return std::visit([](const auto& s) { return build_profile(s); }, spec).map([](Built built) {
    Tool tool;
    tool.profile_ = std::move(built.profile);
    tool.low_ = built.low;
    tool.high_ = built.high;
    tool.widest_ = built.widest;
    return tool;
  });
}

double Tool::radius(double t) const noexcept {
  if (!(t >= low_ && t <= high_)) return 0.0;
  return std::visit([t](const auto& p) { return p.radius(t); }, profile_);
}

double Tool::slope(double t) const noexcept {
  if (!(t >= low_ && t <= high_)) return 0.0;
  return std::visit([t](const auto& p) { return p.slope(t); }, profile_);
}

}  // namespace clay
