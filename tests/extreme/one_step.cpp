#include "extreme/one_step.hpp"

#include "claystack/engine/wheel.hpp"
#include "extreme/hand.hpp"
#include "extreme/overlap_energy.hpp"
#include "extreme/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace clay::extreme {
namespace {

constexpr double kUlp = 0x1p-53;
constexpr double kQuantum = 0x1p-36;  // mm^2

/// A ring as it should be, R^2 and r^2 [mm^2], and how far rounding may take each from that.
struct Expected {
  Fifty outer2 = 0, inner2 = 0;
  double outer_slack = 0.0, inner_slack = 0.0;
};

/// One tick in 50 digits. All indices count from 0.
class Recomputed {
 public:
  Recomputed(Who who, const SceneSpec& scene, Section before, const glm::dvec3& hip,
             const glm::dvec3& moved)
      : counted_(who == Who::conserving),
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
    take();
    if (removed_ == 0) return;
    Fifty rest = removed_;
    double slack = slack_;
    if (!upward) rest -= give(rest, slack, -1);
    // As printed, clay goes on upward only where the kernel was cut at the base.
    if (upward || counted_ || bottom_ < reach()) rest -= give(rest, slack, +1);
    to_height_ = rest;
  }

  [[nodiscard]] const std::vector<Expected>& rings() const { return rings_; }
  [[nodiscard]] bool pressed() const { return removed_ > 0; }
  [[nodiscard]] const Fifty& to_height() const { return to_height_; }
  [[nodiscard]] double slack() const { return slack_; }

 private:
  /// Radii of the engine are roots of counts; the counts are what is exact.
  void use_counts() {
    for (Expected& ring : rings_) {
      ring.outer2 = round(Fifty(ring.outer2 / kQuantum)) * kQuantum;
      ring.inner2 = round(Fifty(ring.inner2 / kQuantum)) * kQuantum;
    }
  }
  [[nodiscard]] std::size_t reach() const {
    return static_cast<std::size_t>(std::lround(scene_.flow.reach_mm / scene_.lump.ring_height_mm));
  }

  /// Equations (1), (2).
  void find_range() {
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

  [[nodiscard]] std::size_t ring_at_centre() const {
    const double level = hip_.y / scene_.lump.ring_height_mm;
    const double at = counted_ ? std::floor(level) : std::round(level);
    const double low = counted_ ? 0.0 : static_cast<double>(bottom_);
    const double high =
        counted_ ? static_cast<double>(rings_.size() - 1) : static_cast<double>(top_);
    return static_cast<std::size_t>(std::clamp(at, low, high));
  }

  /// Equations (3), (4), with what docs/model.md adds to them.
  void take() {
    const Fifty d = sqrt(Fifty(Fifty(hip_.x) * hip_.x + Fifty(hip_.z) * hip_.z));
    const Expected& middle = rings_[ring_at_centre()];
    outside_ = d > (sqrt(middle.outer2) + sqrt(middle.inner2)) / 2;
    hollow_ = !outside_;
    for (const Expected& ring : rings_) hollow_ = hollow_ || ring.inner2 > 0;
    const Fifty x = Fifty(hip_.x) - moved_.x, z = Fifty(hip_.z) - moved_.z;
    const Fifty way = sqrt(Fifty(x * x + z * z)) - d;
    for (std::size_t i = bottom_; i <= top_; ++i) take_from(i, d, outside_ ? way : Fifty(-way));
  }

  /// f at a height, or at the tool's end where that is nearer.
  [[nodiscard]] Fifty profile_at(const Fifty& t) const {
    const Fifty half = half_height_mm(scene_.tool.shape);
    return half_profile(scene_.tool.shape, std::clamp(t, Fifty(-half), half));
  }

  /// docs/model.md, "How clay gives way", for a tool that is now `depth` in a wall, after it has
  /// come `advance` nearer in a part of the time `whole`, times kappa.
  Fifty depth_left(const Fifty& wall, const Fifty& depth, Fifty advance, Fifty part,
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
    // The engine's exponential is good to 1e-11.
    exp_slack_ = 1e-11 * abs(off).convert_to<double>();
    return std::clamp(std::max(relaxed, Fifty(depth - at_most)), Fifty(0), depth);
  }

  void take_from(std::size_t i, const Fifty& d, const Fifty& way) {
    Fifty t = section_.centres_mm[i] - Fifty(hip_.y);
    const Fifty middle = t, moved = moved_.y;
    const Fifty half = half_height_mm(scene_.tool.shape),
                half_ring = scene_.lump.ring_height_mm / 2;
    const bool ellipse = !std::holds_alternative<RibSpec>(scene_.tool.shape);
    if (abs(t) > half && (counted_ || ellipse)) return;
    // A ring that the tool covers in part is met in the middle of that part.
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
      const Fifty advance = since * way + f - profile_at(t + since * moved);
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

  /// eps comes of sums of R, r, d and f, some of them roots: 16 half ulps of their sum cover them.
  /// f itself loses digits toward a pole, where df = b^2 / f du, u = t / a.
  double slack_of(const Fifty& outer, const Fifty& f, const Fifty& d) const {
    const auto big = Fifty(outer + f + d).convert_to<double>();
    const auto width = half_profile(scene_.tool.shape, 0).convert_to<double>();
    const double pole = 8.0 * kUlp * width * width / std::max(f.convert_to<double>(), 1e-7 * width);
    return 2.0 * big * (16.0 * kUlp * big + pole) + kQuantum;
  }

  /// C(x): the sum of P_d(1) .. P_d(x), in between on straight lines.
  [[nodiscard]] Fifty dealt(const std::vector<Fifty>& sums, const Fifty& x) const {
    if (x <= 0) return 0;
    if (x >= sums.size() - 1) return 1;
    const auto below = static_cast<std::size_t>(floor(x).convert_to<double>());
    return sums[below] + (x - below) * (sums[below + 1] - sums[below]);
  }

  [[nodiscard]] std::vector<Fifty> sums_of_weights() const {
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

  /// Equations (5)-(8), from the tool's end. Returns what was given.
  Fifty give(const Fifty& amount, double slack, int direction) {
    const std::vector<Fifty> sums = sums_of_weights();
    const Fifty offset = direction > 0 ? up_offset_ : down_offset_;
    const Fifty alpha = hollow_ ? Fifty(scene_.flow.inside_share) : Fifty(0);
    // The engine's table has 40 bits of fraction, and a share is cut to a whole quantum.
    const double grain = counted_ ? 0x1p-38 * amount.convert_to<double>() + 4.0 * kQuantum : 0.0;
    Fifty given = 0, before = 0;
    for (std::size_t j = 1; j <= reach() + (counted_ ? 1 : 0); ++j) {
      const std::size_t from = direction > 0 ? top_ : bottom_;
      if (direction > 0 ? from + j >= rings_.size() : j > from) break;
      Expected& ring = rings_[direction > 0 ? from + j : from - j];
      const Fifty part = dealt(sums, j + offset) - before;
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

  bool counted_;
  const SceneSpec& scene_;
  Section section_;
  glm::dvec3 hip_, moved_;
  Fifty rise_;  ///< since the last pose, in rings
  Fifty up_offset_ = 0, down_offset_ = 0;
  std::vector<Expected> rings_;
  bool none_ = false, outside_ = true, hollow_ = false;
  std::size_t bottom_ = 0, top_ = 0;
  Fifty removed_ = 0, to_height_ = 0;
  double slack_ = 0.0;
  double exp_slack_ = 0.0;  ///< of the last depth_left [mm]
};

/// On a grid of 1/256 mm, so that no offset of the kernel is rounded (it has 20 bits of fraction).
double on_grid(double mm) { return std::round(256.0 * mm) / 256.0; }

SceneSpec random_scene(Hand& hand) {
  SceneSpec scene = small_pot();
  const double shape = hand.uniform();
  if (shape < 0.3)
    scene.tool.shape = EllipseSpec{on_grid(4.0 + 8.0 * hand.uniform()), 3.0 + 6.0 * hand.uniform()};
  else if (shape < 0.6)
    scene.tool.shape =
        RibSpec{2.0 * on_grid(2.0 + 10.0 * hand.uniform()), 3.0 + 6.0 * hand.uniform()};
  scene.removal.rate_per_s = 1.0 + 60.0 * hand.uniform();
  scene.flow.sigma_mm = 1.0 + 6.0 * hand.uniform();
  scene.flow.reach_mm = std::floor(1.0 + 16.0 * hand.uniform());
  scene.flow.inside_share = std::floor(17.0 * hand.uniform()) / 16.0;  // no rounding of alpha
  if (hand.uniform() < 0.5) scene.lump.inner_radius_mm = 8.0 + 12.0 * hand.uniform();
  return scene;
}

/// R^2 or r^2 of a double, or of a count.
double miss(const Fifty& expected, double found_mm, bool counted) {
  Fifty found = Fifty(found_mm) * found_mm;
  if (counted) found = round(Fifty(found / kQuantum)) * kQuantum;
  return abs(Fifty(found - expected)).convert_to<double>();
}

/// How many times the bound the worst ring is off.
double worst_of(const Recomputed& step, const Subject& subject, Who who) {
  const bool counted = who == Who::conserving;
  double worst = 0.0;
  for (std::size_t i = 0; i < step.rings().size(); ++i) {
    const Expected& ring = step.rings()[i];
    const Radii found = subject.ring(i);
    // Doubles hold radii: their squares are within 4 half ulps of what is stored.
    const auto stored = [&](double mm) { return counted ? 0.0 : 4.0 * kUlp * mm * mm; };
    worst = std::max(worst, miss(ring.outer2, found.outer_mm, counted) /
                                (ring.outer_slack + stored(found.outer_mm) + 1e-30));
    worst = std::max(worst, miss(ring.inner2, found.inner_mm, counted) /
                                (ring.inner_slack + stored(found.inner_mm) + 1e-30));
  }
  return worst;
}

}  // namespace

Outcome one_step_again(Who who) {
  Hand hand(2026);
  double worst = 0.0;
  int compared = 0;
  for (int pot = 0; pot < 40; ++pot) {
    const SceneSpec scene = random_scene(hand);
    const auto subject = std::move(put_on_wheel(who, scene).value());
    Pose pose = hand.next();
    subject->step(pose);
    for (int k = 0; k < 20; ++k) {
      for (int wild = 0; wild < 8; ++wild) subject->step(pose = hand.next());
      // Less than 0.2 mm from here on, which is a tick in one part; first to the grid.
      pose = {pose.time_us + 400, pose.position_mm, false};
      pose.position_mm.y = on_grid(pose.position_mm.y);
      subject->step(pose);
      const double rise = std::floor(17.0 * hand.uniform() - 8.0) / 256.0;
      if (rise == 0.0) continue;
      const glm::dvec3 from = pose.position_mm;
      pose = {pose.time_us + 400, from + glm::dvec3(0.04 * hand.uniform() - 0.02, rise, 0.0),
              false};
      const glm::dvec3 moved = pose.position_mm - from;
      const std::size_t rings = subject->rings();
      const Recomputed step(who, scene, section_of(*subject), pose.position_mm, moved);
      subject->step(pose);
      if (!step.pressed() || subject->rings() != rings) continue;
      if (!subject->fault().empty()) break;  // the paper's own, in other cases of the suite
      ++compared;
      worst = std::max(worst, worst_of(step, *subject, who));
      if (!(worst <= 1.0))
        return {Verdict::failed,
                fmt::format("{:.3g} times the bound, pot {}, tick {}", worst, pot, k)};
    }
  }
  if (compared < 100) return {Verdict::failed, fmt::format("only {} ticks compared", compared)};
  return {Verdict::passed, fmt::format("{} ticks, within {:.2g} of the bound", compared, worst)};
}

}  // namespace clay::extreme
