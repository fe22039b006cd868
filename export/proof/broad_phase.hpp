#pragma once
// Bodies with the data that a search for intersecting pairs uses repeatedly.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::solid::inline proof {

inline constexpr std::uint32_t kNoHub = UINT32_MAX;

/// Encloses a triangle or an arc: the convex hull of its corners, expanded by the slack.
struct BoundingHull {
  std::array<glm::dvec3, 4> corners;                          ///< finite, any unit
  double slack = 0.0;                                         ///< at least 0, unit of the corners
  std::array<std::uint32_t, 3> hubs{kNoHub, kNoHub, kNoHub};  ///< its vertices of high valence
  std::uint32_t number = 0;                                   ///< number set by the caller
  bool early = false;                                         ///< flag set by the caller
};

/// The longest side of its triangle (the first three corners).
[[nodiscard]] glm::dvec3 longest_side(const BoundingHull& body);

/// Bodies are sorted by repeated halving, so that neighbours in space are neighbours in memory:
/// where more than kFew are left, the lower half comes first.
class BroadPhase {
 public:
  /// Few enough for comparing all pairs.
  static constexpr std::size_t kFew = 12;

  struct Box {
    glm::dvec3 low, high;
  };

  explicit BroadPhase(std::vector<BoundingHull> bodies);

  [[nodiscard]] std::size_t size() const { return bodies_.size(); }
  [[nodiscard]] const BoundingHull& operator[](std::uint32_t i) const { return bodies_[i]; }
  [[nodiscard]] const Box& box(std::uint32_t i) const { return boxes_[i]; }

  [[nodiscard]] Box box_of(std::span<const std::uint32_t> all) const;
  [[nodiscard]] glm::dvec3 middle_of(std::span<const std::uint32_t> all) const;
  /// The sum of their longest sides, all oriented the same way.
  [[nodiscard]] glm::dvec3 grain_of(std::span<const std::uint32_t> all,
                                    const glm::dvec3& like) const;
  /// Partitions the lower half before the upper one, along the axis that the fewest bodies cross.
  /// Returns the size of the lower half.
  [[nodiscard]] std::size_t halve(std::span<std::uint32_t> all) const;
  /// Upper bound of the rounding error of a corner's distance along a direction.
  [[nodiscard]] double rounding() const { return rounding_; }

  [[nodiscard]] bool any_hub() const { return any_hub_; }
  /// A hub of many bodies on both sides, or kNoHub.
  [[nodiscard]] std::uint32_t common_hub(std::span<const std::uint32_t> a,
                                         std::span<const std::uint32_t> b) const;
  [[nodiscard]] bool share_hub(std::uint32_t a, std::uint32_t b) const {
    const std::array<std::uint32_t, 3>& hubs = bodies_[a].hubs;
    return std::any_of(hubs.begin(), hubs.end(),
                       [&](std::uint32_t hub) { return hub != kNoHub && hangs_from(b, hub); });
  }
  [[nodiscard]] bool hangs_from(std::uint32_t body, std::uint32_t hub) const {
    const std::array<std::uint32_t, 3>& hubs = bodies_[body].hubs;
    return std::find(hubs.begin(), hubs.end(), hub) != hubs.end();
  }

 private:
  void arrange();

  std::vector<BoundingHull> bodies_;  ///< corners relative to the middle of all
  std::vector<Box> boxes_;            ///< of the bodies
  std::vector<glm::dvec3> middles_;
  double rounding_ = 0.0;
  bool any_hub_ = false;
};

/// True if the boxes are disjoint along some axis.
[[nodiscard]] inline bool apart(const BroadPhase::Box& a, const BroadPhase::Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y ||
         a.low.z > b.high.z || b.low.z > a.high.z;
}

}  // namespace clay::solid::inline proof
