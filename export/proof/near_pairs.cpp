#include "export/proof/near_pairs.hpp"

#include "core/cancel.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace clay::solid::inline proof {
namespace {

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

}  // namespace

void NearPairs::search(const Visitor& visitor) {
  stop_if_cancelled();
  visitor_ = &visitor;
  ended_ = false;
  within(0, crowd_.size());
}

/// The bodies from `begin` to before `end`, which form a node of the halving tree.
void NearPairs::within(std::size_t begin, std::size_t end) {
  if (ended_) return;
  if (end - begin <= BroadPhase::kFew) {
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
  const auto few = [&] { return a.size() * b.size() <= BroadPhase::kFew * BroadPhase::kFew; };
  const auto stuck = [&] { return 4 * (a.size() + b.size()) > 3 * (first.size() + second.size()); };
  if (!few() && stuck()) {
    if (crowd_.any_hub() && without_hub(a, b)) return;
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
  const std::size_t half = crowd_.halve(all);
  between(all.first(half), whole);
  between(all.subspan(half), whole);
}

/// If many bodies of both sets share one hub, continues with the other pairs; otherwise returns
/// false.
bool NearPairs::without_hub(const Positions& a, const Positions& b) {
  const std::uint32_t hub = crowd_.common_hub(a, b);
  if (hub == kNoHub) return false;
  const auto parted = [&](const Positions& all) {
    std::pair<Positions, Positions> parts;
    for (const std::uint32_t i : all)
      (crowd_.hangs_from(i, hub) ? parts.first : parts.second).push_back(i);
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
    const BroadPhase::Box box = crowd_.box_of(others);
    std::erase_if(kept, [&](std::uint32_t i) { return apart(crowd_.box(i), box); });
  };
  keep_near(b, a);
  keep_near(a, b);
}

/// Tests separating planes along the common direction of both sets, for bundles of long bodies.
void NearPairs::sieve_by_planes(Positions& a, Positions& b) const {
  if (a.empty() || b.empty()) return;
  const glm::dvec3 across = crowd_.middle_of(b) - crowd_.middle_of(a);
  const glm::dvec3 like = longest_side(crowd_[a.front()]);
  const glm::dvec3 grain_a = crowd_.grain_of(a, like), grain_b = crowd_.grain_of(b, like);
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
    Span interval;
    for (const glm::dvec3& corner : crowd_[i].corners) {
      const double distance = glm::dot(corner, unit);
      interval.low = std::min(interval.low, distance);
      interval.high = std::max(interval.high, distance);
    }
    const double margin = crowd_.rounding() + 2.0 * crowd_[i].slack;
    return Span{interval.low - margin, interval.high + margin};
  };
  const auto keep_near = [&](Positions& kept, const Positions& others) {
    Span all;
    for (const std::uint32_t i : others) {
      const Span one = reach(i);
      all = {std::min(all.low, one.low), std::max(all.high, one.high)};
    }
    std::erase_if(kept, [&](std::uint32_t i) {
      const Span one = reach(i);
      return one.low > all.high || one.high < all.low;
    });
  };
  keep_near(b, a);
  keep_near(a, b);
}

void NearPairs::offer(std::uint32_t a, std::uint32_t b) {
  step_of_loop();
  if (ended_ || apart(crowd_.box(a), crowd_.box(b))) return;
  if (crowd_.any_hub() && crowd_.share_hub(a, b)) return;
  ended_ = !visitor_->call(visitor_->visit, a, b);
}

}  // namespace clay::solid::inline proof
