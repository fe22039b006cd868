#include "export/proof/broad_phase.hpp"

#include "core/cancel.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

namespace clay::solid::inline proof {
namespace {

/// Number of bodies sampled for vertices of high valence. If one in eight has such a vertex, the
/// set is split by it.
constexpr std::size_t kSample = 32;

}  // namespace

glm::dvec3 longest_side(const BoundingHull& body) {
  glm::dvec3 longest{0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 side = body.corners[(i + 1) % 3] - body.corners[i];
    if (glm::dot(side, side) > glm::dot(longest, longest)) longest = side;
  }
  return longest;
}

BroadPhase::BroadPhase(std::vector<BoundingHull> bodies) : bodies_(std::move(bodies)) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low{kInfinity}, high{-kInfinity};
  for (const BoundingHull& body : bodies_) {
    for (const glm::dvec3& corner : body.corners) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  const glm::dvec3 middle = 0.5 * low + 0.5 * high;
  boxes_.reserve(bodies_.size());
  middles_.reserve(bodies_.size());
  double reach = 0.0;
  for (BoundingHull& body : bodies_) {
    Box box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
    for (glm::dvec3& corner : body.corners) {
      // Rounding preserves the order of coordinates, so disjoint boxes stay disjoint.
      corner -= middle;
      box.low = glm::min(box.low, corner);
      box.high = glm::max(box.high, corner);
    }
    reach = std::max(reach, glm::length(glm::max(glm::abs(box.low), glm::abs(box.high))));
    // By corners: bodies may have equal boxes and still lie side by side.
    middles_.push_back(body.corners[0] / 3.0 + body.corners[1] / 3.0 + body.corners[2] / 3.0);
    boxes_.push_back({box.low - body.slack, box.high + body.slack});
    any_hub_ = any_hub_ || *std::min_element(body.hubs.begin(), body.hubs.end()) != kNoHub;
  }
  // One subtraction, three products and two sums: less than 8 * 2^-53 of the reach on either side.
  rounding_ = std::ldexp(reach, -48) + std::numeric_limits<double>::min();
  arrange();
}

void BroadPhase::arrange() {
  std::vector<std::uint32_t> order(bodies_.size());
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

BroadPhase::Box BroadPhase::box_of(std::span<const std::uint32_t> all) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
  for (const std::uint32_t i : all) {
    box.low = glm::min(box.low, boxes_[i].low);
    box.high = glm::max(box.high, boxes_[i].high);
  }
  return box;
}

glm::dvec3 BroadPhase::middle_of(std::span<const std::uint32_t> all) const {
  glm::dvec3 sum{0.0};
  for (const std::uint32_t i : all) sum += middles_[i];
  return sum / static_cast<double>(all.size());
}

glm::dvec3 BroadPhase::grain_of(std::span<const std::uint32_t> all, const glm::dvec3& like) const {
  glm::dvec3 sum{0.0};
  for (const std::uint32_t i : all) {
    const glm::dvec3 side = longest_side(bodies_[i]);
    sum += glm::dot(side, like) < 0.0 ? -side : side;
  }
  return sum / glm::length(sum);
}

std::uint32_t BroadPhase::common_hub(std::span<const std::uint32_t> a,
                                     std::span<const std::uint32_t> b) const {
  const auto sample = [&](std::span<const std::uint32_t> all) {
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

std::size_t BroadPhase::halve(std::span<std::uint32_t> all) const {
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

}  // namespace clay::solid::inline proof
