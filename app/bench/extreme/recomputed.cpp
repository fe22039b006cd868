#include "app/bench/extreme/recomputed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::extreme {

Recomputed::Recomputed(Model model, const SceneSpec& scene, Section before, const glm::dvec3& hip,
                       const glm::dvec3& moved)
    : counted_(model == Model::conserving),
      scene_(scene),
      section_(std::move(before)),
      hip_(hip),
      moved_(moved),
      rise_(Fifty(moved.y) / scene.lump.ring_height_mm) {
  const bool upward = moved.y > 0.0;
  for (const Radii& ring : section_.rings)
    rings_.push_back(
        {Fifty(ring.outer_mm) * ring.outer_mm, Fifty(ring.inner_mm) * ring.inner_mm, 0.0, 0.0});
  if (counted_) use_counts();
  find_range();
  if (none_) return;
  remove();
  if (removed_ == 0) return;
  Fifty rest = removed_;
  double slack = slack_;
  if (!upward) rest -= distribute(rest, slack, -1);
  // As printed, clay continues upward only if the kernel was cut at the base.
  if (upward || counted_ || bottom_ < reach()) distribute(rest, slack, +1);
}

/// Radii of the engine are roots of counts; only the counts are exact.
void Recomputed::use_counts() {
  for (Expected& ring : rings_) {
    ring.outer2 = round(Fifty(ring.outer2 / kQuantum)) * kQuantum;
    ring.inner2 = round(Fifty(ring.inner2 / kQuantum)) * kQuantum;
  }
}

std::size_t Recomputed::reach() const {
  return static_cast<std::size_t>(std::lround(scene_.flow.reach_mm / scene_.lump.ring_height_mm));
}

/// Equations (1), (2).
void Recomputed::find_range() {
  const Fifty h = scene_.lump.ring_height_mm, half = half_height_mm(scene_.tool.shape);
  const Fifty top = ceil(Fifty((Fifty(hip_.y) + half) / h)),
              bottom = floor(Fifty((Fifty(hip_.y) - half) / h));
  const auto count = static_cast<double>(rings_.size());
  none_ = counted_ ? top <= 0 || (Fifty(hip_.y) - half) / h >= count : top < 1 || bottom > count;
  if (none_) return;
  const Fifty low = (Fifty(hip_.y) - half) / h, high = (Fifty(hip_.y) + half) / h;
  top_ = static_cast<std::size_t>(std::min(count, top.convert_to<double>())) - 1;
  if (!counted_) {
    bottom_ = static_cast<std::size_t>(std::max(1.0, bottom.convert_to<double>())) - 1;
    return;
  }
  bottom_ = static_cast<std::size_t>(std::max(0.0, bottom.convert_to<double>()));
  up_offset_ = top_ + Fifty(0.5) - std::min(high, Fifty(count)) + std::max(rise_, Fifty(0)) / 2;
  down_offset_ =
      std::max(low, Fifty(0)) - bottom_ - Fifty(0.5) + std::max(Fifty(-rise_), Fifty(0)) / 2;
}

std::size_t Recomputed::ring_at_centre() const {
  const double level = hip_.y / scene_.lump.ring_height_mm;
  const double at = counted_ ? std::floor(level) : std::round(level);
  const double low = counted_ ? 0.0 : static_cast<double>(bottom_);
  const double high = counted_ ? static_cast<double>(rings_.size() - 1) : static_cast<double>(top_);
  return static_cast<std::size_t>(std::clamp(at, low, high));
}

/// Equations (3), (4), with the additions of docs/model.md.
void Recomputed::remove() {
  const Fifty d = sqrt(Fifty(Fifty(hip_.x) * hip_.x + Fifty(hip_.z) * hip_.z));
  const Expected& middle = rings_[ring_at_centre()];
  outside_ = d > (sqrt(middle.outer2) + sqrt(middle.inner2)) / 2;
  hollow_ = !outside_;
  for (const Expected& ring : rings_) hollow_ = hollow_ || ring.inner2 > 0;
  const Fifty x = Fifty(hip_.x) - moved_.x, z = Fifty(hip_.z) - moved_.z;
  const Fifty radial_motion = sqrt(Fifty(x * x + z * z)) - d;
  for (std::size_t i = bottom_; i <= top_; ++i)
    remove_from(i, d, outside_ ? radial_motion : Fifty(-radial_motion));
}

/// f at a height, clamped to the ends of the tool.
Fifty Recomputed::profile_at(const Fifty& t) const {
  const Fifty half = half_height_mm(scene_.tool.shape);
  return half_profile(scene_.tool.shape, std::clamp(t, Fifty(-half), half));
}

/// docs/model.md, "How clay yields", for a tool at `depth` in a wall after advancing by `advance`
/// in `part` of the tick; `whole` is the tick times kappa.
Fifty Recomputed::depth_left(const Fifty& wall, const Fifty& depth, Fifty advance, Fifty part,
                             const Fifty& whole) {
  const Fifty knee = scene_.removal.yield_depth_mm, thinnest = scene_.removal.min_wall_mm;
  if (advance > depth) {
    part *= depth / advance;
    advance = depth;
  }
  const Fifty kappa_dt = whole * part, start = depth - advance;
  const Fifty at_most = wall * (1 - exp(Fifty(-whole))) * part * (1 + whole * (1 - part) / 2);
  Fifty rest = 1;
  if (start > knee) {
    const Fifty over = start - knee, middle = wall - over / 2;
    const Fifty closing = kappa_dt * (middle - over * over / (12 * middle)) - advance;
    rest = closing > over ? Fifty(1 - over / closing) : Fifty(0);
  }
  const Fifty behind = std::max(Fifty(wall - depth + advance / 2), thinnest);
  const Fifty pace = std::max(Fifty(advance * knee / kappa_dt), Fifty(-behind * behind / 4));
  const Fifty steady = pace / (behind + pace / behind);
  const Fifty spread = behind + 2 * steady;
  const Fifty off = std::min(start, knee) - steady;
  const Fifty left = exp(Fifty(-kappa_dt * rest * spread / knee));
  const Fifty relaxed = steady + off * left / (1 + off / spread * (1 - left));
  // The accuracy of the engine's exponential is 1e-11.
  exp_slack_ = 1e-11 * abs(off).convert_to<double>();
  return std::clamp(std::max(relaxed, Fifty(depth - at_most)), Fifty(0), depth);
}

void Recomputed::remove_from(std::size_t i, const Fifty& d, const Fifty& radial_motion) {
  Fifty t = section_.centres_mm[i] - Fifty(hip_.y);
  const Fifty middle = t, moved = moved_.y;
  const Fifty half = half_height_mm(scene_.tool.shape), half_ring = scene_.lump.ring_height_mm / 2;
  const bool ellipse = !std::holds_alternative<RibSpec>(scene_.tool.shape);
  if (abs(t) > half && (counted_ || ellipse)) return;
  // A partly covered ring is evaluated in the middle of the covered part.
  if (counted_)
    t = (std::max(Fifty(t - half_ring), Fifty(-half)) + std::min(Fifty(t + half_ring), half)) / 2;
  Expected& ring = rings_[i];
  const Fifty outer = sqrt(ring.outer2), inner = sqrt(ring.inner2);
  const Fifty f = half_profile(scene_.tool.shape, t);
  const Fifty depth = outside_ ? Fifty(outer + f - d) : Fifty(d + f - inner);
  if (depth <= 0) return;
  Fifty eps = (outer - inner) * Fifty(scene_.removal.rate_per_s / 1000.0);
  if (counted_) {
    const Fifty before = std::clamp(Fifty(middle + moved), Fifty(-half), half);
    const Fifty since = before != middle + moved ? Fifty((before - middle) / moved) : Fifty(1);
    const Fifty advance = since * radial_motion + f - profile_at(t + since * moved);
    const Fifty kappa_dt = Fifty(scene_.removal.rate_per_s) / 2500;  // 0.4 ms
    const Fifty spare = outer - inner - scene_.removal.min_wall_mm;
    eps = std::min(Fifty(depth - depth_left(outer - inner, depth, advance, since, kappa_dt)),
                   std::max(spare, Fifty(0)));
  }
  const Fifty amount = outside_ ? Fifty(eps * (2 * outer - eps)) : Fifty(eps * (2 * inner + eps));
  removed_ += amount;
  (outside_ ? ring.outer2 : ring.inner2) += outside_ ? Fifty(-amount) : amount;
  double slack = slack_of(outer, f, d);
  if (counted_) slack += 2.0 * outer.convert_to<double>() * exp_slack_;
  (outside_ ? ring.outer_slack : ring.inner_slack) += slack;
  slack_ += slack;
}

/// eps is computed from sums of R, r, d and f, some of them roots: 16 half ulps of their sum bound
/// the error. f itself loses digits toward a pole, where df = b^2 / f du, u = t / a.
double Recomputed::slack_of(const Fifty& outer, const Fifty& f, const Fifty& d) const {
  const auto big = Fifty(outer + f + d).convert_to<double>();
  const auto width = half_profile(scene_.tool.shape, 0).convert_to<double>();
  const double pole = 8.0 * kUlp * width * width / std::max(f.convert_to<double>(), 1e-7 * width);
  return 2.0 * big * (16.0 * kUlp * big + pole) + kQuantum;
}

/// C(x): the sum of P_d(1) .. P_d(x), linear between integers.
Fifty Recomputed::distributed(const std::vector<Fifty>& sums, const Fifty& x) const {
  if (x <= 0) return 0;
  if (x >= sums.size() - 1) return 1;
  const auto below = static_cast<std::size_t>(floor(x).convert_to<double>());
  return sums[below] + (x - below) * (sums[below + 1] - sums[below]);
}

std::vector<Fifty> Recomputed::sums_of_weights() const {
  const double h = scene_.lump.ring_height_mm, sigma = scene_.flow.sigma_mm;
  std::vector<Fifty> sums{0};
  for (std::size_t j = 1; j <= reach(); ++j) {
    const Fifty x = Fifty(h) * static_cast<unsigned>(j);
    sums.push_back(sums.back() + x * exp(Fifty(-x * x / (2 * Fifty(sigma) * sigma))));
  }
  const Fifty all = sums.back();
  for (Fifty& sum : sums) sum /= all;
  return sums;
}

/// Equations (5)-(8), from the tool's end. Returns the distributed amount.
Fifty Recomputed::distribute(const Fifty& amount, double slack, int direction) {
  const std::vector<Fifty> sums = sums_of_weights();
  const Fifty offset = direction > 0 ? up_offset_ : down_offset_;
  const Fifty alpha = hollow_ ? Fifty(scene_.flow.inside_share) : Fifty(0);
  // The engine's table has 40 fractional bits, and a share is truncated to a whole quantum.
  const double grain = counted_ ? 0x1p-38 * amount.convert_to<double>() + 4.0 * kQuantum : 0.0;
  Fifty given = 0, before = 0;
  for (std::size_t j = 1; j <= reach() + (counted_ ? 1 : 0); ++j) {
    const std::size_t from = direction > 0 ? top_ : bottom_;
    if (direction > 0 ? from + j >= rings_.size() : j > from) break;
    Expected& ring = rings_[direction > 0 ? from + j : from - j];
    const Fifty part = distributed(sums, j + offset) - before;
    before += part;
    const Fifty share = part * amount, inside = std::min(Fifty(alpha * share), ring.inner2);
    ring.inner2 -= inside;
    ring.outer2 += share - inside;
    const double loose = grain + slack * part.convert_to<double>();
    ring.inner_slack += loose;
    ring.outer_slack += loose;
    given += share;
  }
  return given;
}

}  // namespace clay::extreme
