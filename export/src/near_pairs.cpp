#include "near_pairs.hpp"

#include "cancel.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

namespace clay::solid {
namespace {

/// Few enough to compare each with each.
constexpr std::size_t kFew = 12;
/// Hubs are looked for in so many bodies of a set, and worth parting where an eighth has one.
constexpr std::size_t kSample = 32;

template <class Box>
bool apart(const Box& a, const Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y ||
         a.low.z > b.high.z || b.low.z > a.high.z;
}

glm::dvec3 longest_side(const Body& body) {
  glm::dvec3 longest{0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 side = body.corners[(i + 1) % 3] - body.corners[i];
    if (glm::dot(side, side) > glm::dot(longest, longest)) longest = side;
  }
  return longest;
}

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

}  // namespace

NearPairs::NearPairs(std::vector<Body> bodies) : bodies_(std::move(bodies)) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low{kInfinity}, high{-kInfinity};
  for (const Body& body : bodies_) {
    for (const glm::dvec3& corner : body.corners) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  const glm::dvec3 middle = 0.5 * low + 0.5 * high;
  boxes_.reserve(bodies_.size());
  middles_.reserve(bodies_.size());
  double reach = 0.0;
  for (Body& body : bodies_) {
    Box box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (glm::dvec3& corner : body.corners) {
      // Rounding keeps the order of coordinates, so that boxes stay apart only if they were.
      corner -= middle;
      box.low = glm::min(box.low, corner);
      box.high = glm::max(box.high, corner);
    }
    reach = std::max(reach, glm::length(glm::max(glm::abs(box.low), glm::abs(box.high))));
    // By corners: bodies may have one box and yet lie side by side.
    middles_.push_back(body.corners[0] / 3.0 + body.corners[1] / 3.0 + body.corners[2] / 3.0);
    boxes_.push_back({box.low - body.slack, box.high + body.slack});
    any_hub_ = any_hub_ || *std::min_element(body.hubs.begin(), body.hubs.end()) != kNoHub;
  }
  // A subtraction, three products and two sums: less than 8 * 2^-53 of the reach on either side.
  rounding_ = std::ldexp(reach, -48) + std::numeric_limits<double>::min();
  arrange();
}

void NearPairs::search(const Visitor& visitor) {
  stop_if_cancelled();
  visitor_ = &visitor;
  ended_ = false;
  within(0, bodies_.size());
}

/// Brings the bodies into the order of the halves, so that neighbours in space are so in memory.
void NearPairs::arrange() {
  Positions order(bodies_.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  const auto split = [&](const auto& self, std::span<std::uint32_t> all) -> void {
    if (all.size() <= kFew) return;
    step_of_loop();
    const std::size_t half = halve(all);
    self(self, all.first(half));
    self(self, all.subspan(half));
  };
  split(split, order);
  const auto ordered = [&](auto& all) {
    std::decay_t<decltype(all)> result;
    result.reserve(all.size());
    for (const std::uint32_t i : order) result.push_back(all[i]);
    all = std::move(result);
  };
  ordered(bodies_);
  ordered(boxes_);
  ordered(middles_);
}

/// The bodies at `begin` to before `end`, which is a node of the tree of halves.
void NearPairs::within(std::size_t begin, std::size_t end) {
  if (ended_) return;
  if (end - begin <= kFew) {
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = begin; j < i; ++j)
        offer(static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(i));
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  within(begin, middle);
  within(middle, end);
  Positions all(end - begin);
  std::iota(all.begin(), all.end(), static_cast<std::uint32_t>(begin));
  const std::span<const std::uint32_t> positions(all);
  between(positions.first(middle - begin), positions.subspan(middle - begin));
}

void NearPairs::between(std::span<const std::uint32_t> first,
                        std::span<const std::uint32_t> second) {
  if (ended_) return;
  step_of_loop();
  Positions a(first.begin(), first.end()), b(second.begin(), second.end());
  sieve_by_boxes(a, b);
  const auto few = [&] { return a.size() * b.size() <= kFew * kFew; };
  const auto stuck = [&] { return 4 * (a.size() + b.size()) > 3 * (first.size() + second.size()); };
  if (!few() && stuck()) {
    if (any_hub_ && without_hub(a, b)) return;
    sieve_by_planes(a, b);
  }
  if (few()) {
    for (const std::uint32_t i : a)
      for (const std::uint32_t j : b) offer(i, j);
  } else if (a.size() > b.size()) {
    halves_between(a, b);
  } else {
    halves_between(b, a);
  }
}

void NearPairs::halves_between(Positions& cut, const Positions& whole) {
  const std::span<std::uint32_t> all(cut);
  const std::size_t half = halve(all);
  between(all.first(half), whole);
  between(all.subspan(half), whole);
}

/// Where many of both hang from one hub, goes on with the pairs that do not; false elsewhere.
bool NearPairs::without_hub(const Positions& a, const Positions& b) {
  const std::uint32_t hub = common_hub(a, b);
  if (hub == kNoHub) return false;
  const auto parted = [&](const Positions& all) {
    std::pair<Positions, Positions> parts;
    for (const std::uint32_t i : all)
      (hangs_from(i, hub) ? parts.first : parts.second).push_back(i);
    return parts;
  };
  const auto [a_on, a_off] = parted(a);
  const auto [b_on, b_off] = parted(b);
  between(a_on, b_off);
  between(a_off, b_on);
  between(a_off, b_off);
  return true;
}

void NearPairs::sieve_by_boxes(Positions& a, Positions& b) const {
  const auto keep_near = [&](Positions& kept, const Positions& others) {
    const Box box = box_of(others);
    std::erase_if(kept, [&](std::uint32_t i) { return apart(boxes_[i], box); });
  };
  keep_near(b, a);
  keep_near(a, b);
}

/// Planes along the grain of both sets, where bundles of long bodies lie side by side.
void NearPairs::sieve_by_planes(Positions& a, Positions& b) const {
  if (a.empty() || b.empty()) return;
  const glm::dvec3 across = middle_of(b) - middle_of(a);
  const glm::dvec3 like = longest_side(bodies_[a.front()]);
  const glm::dvec3 grain_a = grain_of(a, like), grain_b = grain_of(b, like);
  const glm::dvec3 grain = grain_a + grain_b;
  const double square = glm::dot(grain, grain);
  const std::size_t enough = (a.size() + b.size()) / 2;
  const auto left = [&] { return a.size() + b.size() > enough; };
  if (square > 0.0) sieve_along(across - glm::dot(across, grain) / square * grain, a, b);
  if (left()) sieve_along(glm::cross(grain_a, grain_b), a, b);
  if (left()) sieve_along(across, a, b);
}

void NearPairs::sieve_along(const glm::dvec3& direction, Positions& a, Positions& b) const {
  const double length = glm::length(direction);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  const glm::dvec3 unit = direction / length;
  const auto reach = [&](std::uint32_t i) {
    Interval interval;
    for (const glm::dvec3& corner : bodies_[i].corners) {
      const double distance = glm::dot(corner, unit);
      interval.low = std::min(interval.low, distance);
      interval.high = std::max(interval.high, distance);
    }
    const double margin = rounding_ + 2.0 * bodies_[i].slack;
    return Interval{interval.low - margin, interval.high + margin};
  };
  const auto keep_near = [&](Positions& kept, const Positions& others) {
    Interval all;
    for (const std::uint32_t i : others) {
      const Interval one = reach(i);
      all = {std::min(all.low, one.low), std::max(all.high, one.high)};
    }
    std::erase_if(kept, [&](std::uint32_t i) {
      const Interval one = reach(i);
      return one.low > all.high || one.high < all.low;
    });
  };
  keep_near(b, a);
  keep_near(a, b);
}

void NearPairs::offer(std::uint32_t a, std::uint32_t b) {
  step_of_loop();
  if (ended_ || apart(boxes_[a], boxes_[b])) return;
  if (any_hub_ && share_hub(a, b)) return;
  ended_ = !visitor_->call(visitor_->visit, a, b);
}

NearPairs::Box NearPairs::box_of(std::span<const std::uint32_t> all) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
  for (const std::uint32_t i : all) {
    box.low = glm::min(box.low, boxes_[i].low);
    box.high = glm::max(box.high, boxes_[i].high);
  }
  return box;
}

glm::dvec3 NearPairs::middle_of(const Positions& all) const {
  glm::dvec3 sum{0.0};
  for (const std::uint32_t i : all) sum += middles_[i];
  return sum / static_cast<double>(all.size());
}

/// The sum of their longest sides, each turned to the same end.
glm::dvec3 NearPairs::grain_of(const Positions& all, const glm::dvec3& like) const {
  glm::dvec3 sum{0.0};
  for (const std::uint32_t i : all) {
    const glm::dvec3 side = longest_side(bodies_[i]);
    sum += glm::dot(side, like) < 0.0 ? -side : side;
  }
  return sum / glm::length(sum);
}

/// Of many bodies on both sides, or kNoHub.
std::uint32_t NearPairs::common_hub(const Positions& a, const Positions& b) const {
  const auto sample = [&](const Positions& all) {
    std::vector<std::uint32_t> hubs;
    const std::size_t step = std::max<std::size_t>(all.size() / kSample, 1);
    for (std::size_t i = 0; i < all.size(); i += step)
      for (const std::uint32_t hub : bodies_[all[i]].hubs)
        if (hub != kNoHub) hubs.push_back(hub);
    std::sort(hubs.begin(), hubs.end());
    return std::pair(std::move(hubs), (all.size() / step + 7) / 8);
  };
  const auto [of_a, many_in_a] = sample(a);
  const auto [of_b, many_in_b] = sample(b);
  std::uint32_t best = kNoHub;
  std::size_t most = 0;
  for (auto begin = of_a.begin(); begin != of_a.end();) {
    const auto end = std::upper_bound(begin, of_a.end(), *begin);
    const auto [b_begin, b_end] = std::equal_range(of_b.begin(), of_b.end(), *begin);
    const auto in_a = static_cast<std::size_t>(end - begin);
    const auto in_b = static_cast<std::size_t>(b_end - b_begin);
    if (in_a >= many_in_a && in_b >= many_in_b && in_a * in_b > most) {
      most = in_a * in_b;
      best = *begin;
    }
    begin = end;
  }
  return best;
}

/// Lower half and upper, along the axis that fewest bodies reach across; how many are lower.
std::size_t NearPairs::halve(std::span<std::uint32_t> all) const {
  glm::dvec3 low = middles_[all.front()], high = low, sides{0.0};
  for (const std::uint32_t i : all) {
    low = glm::min(low, middles_[i]);
    high = glm::max(high, middles_[i]);
    sides += boxes_[i].high - boxes_[i].low;
  }
  int axis = 0;
  const glm::dvec3 spread = high - low;
  for (int other = 1; other < 3; ++other)
    if (spread[other] * sides[axis] > spread[axis] * sides[other]) axis = other;
  const std::size_t half = all.size() / 2;
  std::nth_element(
      all.begin(), all.begin() + static_cast<std::ptrdiff_t>(half), all.end(),
      [&](std::uint32_t i, std::uint32_t j) { return middles_[i][axis] < middles_[j][axis]; });
  return half;
}

bool NearPairs::share_hub(std::uint32_t a, std::uint32_t b) const {
  const std::array<std::uint32_t, 3>& hubs = bodies_[a].hubs;
  return std::any_of(hubs.begin(), hubs.end(),
                     [&](std::uint32_t hub) { return hub != kNoHub && hangs_from(b, hub); });
}

bool NearPairs::hangs_from(std::uint32_t body, std::uint32_t hub) const {
  const std::array<std::uint32_t, 3>& hubs = bodies_[body].hubs;
  return std::find(hubs.begin(), hubs.end(), hub) != hubs.end();
}

}  // namespace clay::solid
