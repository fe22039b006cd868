#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

namespace clay::solid {

/// Assigns one number to each position: points are equal if their float32 coordinates are equal (-0
/// equals 0), and are numbered by first use. Does not accept NaN.
///
/// Open addressing with multilinear hashing under random 64-bit factors, of which the upper 32 bits
/// of a sum are strongly universal (Thorup, "High speed hashing for integers and strings", section
/// 3.3): a file cannot force collisions. The numbers do not depend on the factors.
class VertexWelder {
 public:
  /// Appends to `points`, which must outlive the welder. `expected` sizes the first table.
  VertexWelder(std::vector<glm::dvec3>& points, std::size_t expected) : points_(points) {
    std::random_device random;
    for (std::uint64_t& factor : factors_) {
      factor = (std::uint64_t{random()} << 32) | random();
    }
    resize(std::bit_ceil(std::max<std::size_t>(2 * expected, 16)));
  }

  std::uint32_t index_of(const glm::vec3& corner) {
    const glm::vec3 place = corner + 0.0F;  // -0 + 0 is 0
    if (2 * points_.size() >= slots_.size()) resize(2 * slots_.size());
    std::uint32_t& slot = slots_[find(place)];
    if (slot == kEmpty) {
      slot = static_cast<std::uint32_t>(points_.size());
      points_.emplace_back(place);
    }
    return slot;
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xFFFFFFFF;

  /// The slot of `place`, or the empty slot for it.
  [[nodiscard]] std::size_t find(const glm::vec3& place) const noexcept {
    std::uint64_t sum = factors_[3];
    for (int axis = 0; axis < 3; ++axis) {
      sum += factors_[static_cast<std::size_t>(axis)] * std::bit_cast<std::uint32_t>(place[axis]);
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = sum >> shift_;
    while (slots_[at] != kEmpty && points_[slots_[at]] != glm::dvec3(place)) at = (at + 1) & mask;
    return at;
  }

  void resize(std::size_t slots) {
    slots_.assign(slots, kEmpty);
    shift_ = 64 - std::countr_zero(slots);
    for (std::uint32_t i = 0; i < points_.size(); ++i) slots_[find(glm::vec3(points_[i]))] = i;
  }

  std::vector<glm::dvec3>& points_;
  std::vector<std::uint32_t> slots_;
  std::uint64_t factors_[4] = {};
  int shift_ = 0;
};

}  // namespace clay::solid
