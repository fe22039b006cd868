#include "app/bench/literal/literal_paper.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace clay::bench {
namespace {

struct Ellipse {
  double a, b;
  [[nodiscard]] double height() const { return 2.0 * a; }
  [[nodiscard]] double radius(double t) const { return b * std::sqrt(1.0 - t * t / (a * a)); }
  [[nodiscard]] double slope(double t) const {
    return -b * t / (a * a * std::sqrt(1.0 - t * t / (a * a)));
  }
};

struct Rib {
  double h1, b;
  [[nodiscard]] double height() const { return h1; }
  [[nodiscard]] double radius(double) const { return b; }
  [[nodiscard]] double slope(double) const { return 0.0; }
};

/// Q_p(hj) divided by the sum of all L_1 values.
std::vector<double> rayleigh(double sigma, double h, std::size_t count) {
  std::vector<double> weights(count);
  double sum = 0.0;
  for (std::size_t j = 1; j <= count; ++j) {
    const double x = h * static_cast<double>(j);
    weights[j - 1] = x / (sigma * sigma) * std::exp(-(x * x) / (2.0 * sigma * sigma));
    sum += weights[j - 1];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double squared_wall(const LiteralRing& ring) {
  return ring.outer_mm * ring.outer_mm - ring.inner_mm * ring.inner_mm;
}

/// The range in which the conversion to an index is defined.
bool fits_index(double level) {
  return level > std::numeric_limits<int>::min() && level < std::numeric_limits<int>::max();
}

/// sin theta and cos theta of section 6.1.
template <LiteralWriting writing>
std::pair<double, double> normal(double slope) {
  if constexpr (writing == LiteralWriting::as_printed) {
    const double theta = std::atan(slope) + 0.5 * std::numbers::pi;
    return {std::sin(theta), std::cos(theta)};
  } else {
    const double scale = 1.0 / std::sqrt(1.0 + slope * slope);
    return {scale, -slope * scale};
  }
}

}  // namespace

struct LiteralPaper::Contact {
  std::size_t bottom = 1, top = 0;  ///< counted from 1
  bool compressive = true;
  double removed = 0.0;                 ///< Delta v
  double radial = 0.0, vertical = 0.0;  ///< sums of the parts of s_i f_i
  std::size_t rings_touched = 0;
};

LiteralPaper::LiteralPaper(const LiteralScene& scene)
    : LiteralPaper(scene, std::vector<LiteralRing>(
                              scene.rings, {0.0, scene.outer_radius_mm, scene.inner_radius_mm})) {
  for (std::size_t i = 1; i < rings_.size(); ++i)
    rings_[i].y_mm = rings_[i - 1].y_mm + scene.ring_height_mm;
}

LiteralPaper::LiteralPaper(const LiteralScene& scene, std::vector<LiteralRing> rings)
    : scene_(scene),
      rings_(std::move(rings)),
      weights_(rayleigh(scene.sigma_mm, scene.ring_height_mm, scene.kernel_rings)),
      hollow_(std::any_of(rings_.begin(), rings_.end(),
                          [](const LiteralRing& ring) { return ring.inner_mm > 0.0; })) {}

double LiteralPaper::volume() const {
  double sum = 0.0;
  for (const LiteralRing& ring : rings_) sum += squared_wall(ring);
  return sum;
}

/// Section 4 and equations (3), (4): one pass over the selection list L.
template <LiteralWriting writing, class Profile>
void LiteralPaper::touch(const Profile& profile, const glm::dvec3& hip, Contact& contact) {
  // All axes are x = z = 0, so d_i is the same for every ring.
  const double d = std::sqrt(hip.x * hip.x + hip.z * hip.z);
  const auto centre = std::clamp(
      static_cast<std::size_t>(std::max(0.0, std::round(hip.y / scene_.ring_height_mm))) + 1,
      contact.bottom, contact.top);
  const LiteralRing& middle = rings_[centre - 1];
  contact.compressive = d > 0.5 * (middle.outer_mm + middle.inner_mm);

  for (std::size_t i = contact.bottom; i <= contact.top; ++i) {
    LiteralRing& ring = rings_[i - 1];
    const double t = ring.y_mm - hip.y;
    const double f = profile.radius(t);
    const bool touched = contact.compressive ? d < ring.outer_mm + f : d + f > ring.inner_mm;
    if (!touched) continue;
    ++contact.rings_touched;
    const auto [sine, cosine] = normal<writing>(profile.slope(t));
    const double eps = scene_.removal_fraction * (ring.outer_mm - ring.inner_mm);
    if (contact.compressive) {
      const double depth = d - (ring.outer_mm + f);
      contact.radial += depth * sine;
      contact.vertical += depth * cosine;
      contact.removed += eps * (2.0 * ring.outer_mm - eps);
      ring.outer_mm -= eps;
    } else {
      const double depth = d + f - ring.inner_mm;
      contact.radial += depth * sine;
      contact.vertical -= depth * cosine;
      contact.removed += eps * (2.0 * ring.inner_mm + eps);
      ring.inner_mm += eps;
    }
  }
  hollow_ = hollow_ || (!contact.compressive && contact.rings_touched > 0);
}

/// Section 6: K times the sum, and mu |F_d| along the turn, which is counterclockwise.
glm::dvec3 LiteralPaper::force(const Contact& contact, const glm::dvec3& hip) const {
  const double psi = std::atan(hip.z / hip.x);
  const double cos_psi = std::cos(psi), sin_psi = std::sin(psi);
  const glm::dvec3 spring =
      scene_.stiffness_n_per_mm *
      glm::dvec3(contact.radial * cos_psi, contact.vertical, contact.radial * sin_psi);
  const glm::dvec3 tangent(sin_psi, 0.0, -cos_psi);
  return spring + scene_.friction * glm::length(spring) * tangent;
}

/// Equations (5), (6). Returns the distributed amount.
double LiteralPaper::distribute_up(double inside, double outside, std::size_t top) {
  double distributed = 0.0;
  const std::size_t last = std::min(top + weights_.size(), rings_.size());
  for (std::size_t j = top + 1; j <= last; ++j) {
    LiteralRing& ring = rings_[j - 1];
    const double share = weights_[j - top - 1];
    ring.outer_mm = std::sqrt(ring.outer_mm * ring.outer_mm + share * outside);
    if (hollow_) ring.inner_mm = std::sqrt(ring.inner_mm * ring.inner_mm - share * inside);
    distributed += share;
  }
  return distributed * (inside + outside);
}

/// Equations (7), (8). Returns the distributed amount.
double LiteralPaper::distribute_down(double inside, double outside, std::size_t bottom) {
  double distributed = 0.0;
  const std::size_t first = bottom > weights_.size() ? bottom - weights_.size() : 1;
  for (std::size_t j = first; j < bottom; ++j) {
    LiteralRing& ring = rings_[j - 1];
    const double share = weights_[bottom - j - 1];
    ring.outer_mm = std::sqrt(ring.outer_mm * ring.outer_mm + share * outside);
    if (hollow_) ring.inner_mm = std::sqrt(ring.inner_mm * ring.inner_mm - share * inside);
    distributed += share;
  }
  return distributed * (inside + outside);
}

/// Steps (a), (b). The remainder after the loop is not part of the body, as printed.
void LiteralPaper::grow(double excess, LiteralReport& report) {
  double top = squared_wall(rings_.back());
  while (excess > top) {
    if (rings_.size() >= scene_.growth_limit) {
      report.endless = true;
      return;
    }
    excess -= top;
    LiteralRing added = rings_.back();
    added.y_mm += scene_.ring_height_mm;
    rings_.push_back(added);
    top = squared_wall(rings_.back());
  }
}

/// Section 5.1. Before any nonzero velocity the direction is undefined, and nothing is distributed.
void LiteralPaper::redistribute(const Contact& contact, LiteralReport& report) {
  const double alpha = hollow_ ? scene_.inside_share : 0.0;
  if (!(rise_mm_ > 0.0 || rise_mm_ < 0.0)) return;
  double rest = contact.removed;
  const auto inside = [&] { return alpha * rest; };
  const auto outside = [&] { return (1.0 - alpha) * rest; };
  if (rise_mm_ < 0.0) {
    rest -= distribute_down(inside(), outside(), contact.bottom);
    // "max(1, bottom - L_1) = 1": the distribution below is not complete.
    if (contact.bottom > weights_.size() + 1) return;
  }
  rest -= distribute_up(inside(), outside(), contact.top);
  // "top + L_1 greater than N": clay without a ring above becomes height.
  if (contact.top + weights_.size() > rings_.size()) grow(rest, report);
}

double LiteralPaper::stress(std::size_t i) const {
  double mass = 0.0;
  const double scale =
      std::numbers::pi * scene_.ring_height_mm * scene_.density_g_cm3 * 1e-6;  // kg/mm^3
  for (std::size_t j = i + 1; j < rings_.size(); ++j) mass += scale * squared_wall(rings_[j]);
  return mass / (std::numbers::pi * squared_wall(rings_[i]));
}

template <LiteralWriting writing>
bool LiteralPaper::overstressed() const {
  const double limit = scene_.max_stress_kg_per_mm2;
  if constexpr (writing == LiteralWriting::as_printed) {
    for (std::size_t i = 0; i < rings_.size(); ++i)
      if (stress(i) > limit) return true;
  } else {
    const double scale = scene_.ring_height_mm * scene_.density_g_cm3 * 1e-6;
    double above = 0.0;
    for (std::size_t i = rings_.size(); i-- > 0;) {
      const double wall = squared_wall(rings_[i]);
      if (scale * above / wall > limit) return true;
      above += wall;
    }
  }
  return false;
}

template <LiteralWriting writing, class Profile>
LiteralReport LiteralPaper::tick(const Profile& profile, const glm::dvec3& hip) {
  LiteralReport report;
  if (has_last_ && hip.y - last_y_mm_ != 0.0) rise_mm_ = hip.y - last_y_mm_;
  last_y_mm_ = hip.y;
  has_last_ = true;

  const double h = scene_.ring_height_mm;
  const double upper = std::ceil((hip.y + 0.5 * profile.height()) / h);
  const double lower = std::floor((hip.y - 0.5 * profile.height()) / h);
  if (!fits_index(upper) || !fits_index(lower)) {
    report.undefined = true;
    return report;
  }
  const int top = std::min(static_cast<int>(rings_.size()), static_cast<int>(upper));
  const int bottom = std::max(1, static_cast<int>(lower));
  if (bottom > top) return report;

  Contact contact;
  contact.bottom = static_cast<std::size_t>(bottom);
  contact.top = static_cast<std::size_t>(top);
  touch<writing>(profile, hip, contact);
  report.rings_touched = contact.rings_touched;
  if (contact.rings_touched == 0) return report;
  report.force_n = force(contact, hip);
  redistribute(contact, report);
  if (scene_.max_stress_kg_per_mm2 > 0.0) report.collapsed = overstressed<writing>();
  return report;
}

LiteralReport LiteralPaper::step(const glm::dvec3& hip) {
  const auto run = [&](const auto& profile) {
    return scene_.writing == LiteralWriting::as_printed
               ? tick<LiteralWriting::as_printed>(profile, hip)
               : tick<LiteralWriting::eased>(profile, hip);
  };
  if (const auto* rib = std::get_if<LiteralRib>(&scene_.tool))
    return run(Rib{rib->height_mm, rib->radius_mm});
  const auto& ellipse = std::get<LiteralEllipse>(scene_.tool);
  return run(Ellipse{ellipse.half_height_mm, ellipse.half_width_mm});
}

}  // namespace clay::bench
