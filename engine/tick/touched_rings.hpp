#pragma once
#include "claystack/engine/tool.hpp"
#include "engine/clay/packs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace clay {

/// A ring that the tool overlaps.
struct RingContact {
  std::size_t ring = 0;
  double depth_mm = 0.0;    ///< R + f - d outside, d + f - r inside; > 0
  double slope = 0.0;       ///< f'(t); `paper` alone
  double coverage = 1.0;    ///< part of the ring's height that the tool's ends leave to it
  Facing facing = {};       ///< `conserving` alone, as the members below
  double advance_mm = 0.0;  ///< the part of the depth that the tool has gone since the last pose
  double since = 1.0;       ///< part of the time since then in which the tool was at the ring
  double surface_mm = 0.0;  ///< radius of the surface that the tool meets
};

/// The neighbouring rings from() .. to()-1: the tool overlaps the first and the last of them, and
/// of those between, the ones with a depth above 0. Their data are side by side in plain arrays,
/// which loops take two or four at a time.
class TouchedRings {
 public:
  static constexpr std::size_t kBlock = 32;
  /// Loops in lanes may continue past the last ring, to a whole number of fours.
  [[nodiscard]] static constexpr std::size_t with_spare(std::size_t rings) noexcept {
    return (rings + 3) / 4 * 4;
  }
  using Row = std::array<double, kBlock + 4>;
  /// RingContact's members and the yielding distance, each of 32 rings.
  struct Block {
    Row depth, slope, coverage, normal2, lean, turn, advance, since, surface;
    Row give;  ///< distance by which the surface gives way; for the clay rules alone [mm]
  };
  /// Of one block, rows begin..end-1; the first of them is of `ring`.
  template <class Rows>
  struct SliceOf {
    Rows& rows;
    std::size_t begin, end, ring;
    [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
  };
  using Slice = SliceOf<Block>;

  /// Room for this number of rings; nothing is allocated later.
  void reserve(std::size_t rings) { blocks_.resize(blocks_for(rings)); }

  [[nodiscard]] std::size_t from() const noexcept { return from_; }
  [[nodiscard]] std::size_t to() const noexcept { return to_; }
  [[nodiscard]] std::size_t size() const noexcept { return to_ - from_; }
  [[nodiscard]] bool empty() const noexcept { return from_ == to_; }
  [[nodiscard]] bool has(std::size_t ring) const noexcept { return ring - from_ < size(); }
  [[nodiscard]] std::size_t touched() const noexcept { return touched_; }  ///< rings

  /// Rings first..end-1, to be written by slices or by `put` and then trimmed.
  void lay_out(std::size_t first, std::size_t end) {
    origin_ = from_ = first;
    to_ = end;
    touched_ = 0;
    if (blocks_.size() < blocks_for(size())) blocks_.resize(blocks_for(size()));
  }
  void clear() noexcept { from_ = to_ = origin_, touched_ = 0; }

  /// Omits the rings that are not touched at either end, and counts the touched ones.
  void trim() noexcept {
    while (from_ < to_ && !(depth(from_) > 0.0)) ++from_;
    while (from_ < to_ && !(depth(to_ - 1) > 0.0)) --to_;
    touched_ = 0;
    each_slice([this](const Slice& slice) { touched_ += touched_in(slice); });
  }

  /// use(slice) for the rings first..end-1, or for all.
  template <class Use>
  void each_slice(std::size_t first, std::size_t end, Use use) noexcept {
    slices(*this, first, end, use);
  }
  template <class Use>
  void each_slice(std::size_t first, std::size_t end, Use use) const noexcept {
    slices(*this, first, end, use);
  }
  template <class Use>
  void each_slice(Use use) noexcept {
    slices(*this, from_, to_, use);
  }
  template <class Use>
  void each_slice(Use use) const noexcept {
    slices(*this, from_, to_, use);
  }

  [[nodiscard]] double& depth(std::size_t ring) noexcept { return block(ring).depth[row(ring)]; }
  [[nodiscard]] double depth(std::size_t ring) const noexcept {
    return blocks_[(ring - origin_) / kBlock].depth[row(ring)];
  }
  [[nodiscard]] double& coverage(std::size_t ring) noexcept {
    return block(ring).coverage[row(ring)];
  }

  [[nodiscard]] double give(std::size_t ring) const noexcept {
    return blocks_[(ring - origin_) / kBlock].give[row(ring)];
  }

  void put(const RingContact& touch) noexcept {
    Block& b = block(touch.ring);
    const std::size_t k = row(touch.ring);
    b.depth[k] = touch.depth_mm;
    b.slope[k] = touch.slope;
    b.coverage[k] = touch.coverage;
    b.normal2[k] = touch.facing.normal2;
    b.lean[k] = touch.facing.lean;
    b.turn[k] = touch.facing.turn;
    b.advance[k] = touch.advance_mm;
    b.since[k] = touch.since;
    b.surface[k] = touch.surface_mm;
  }
  /// Of a ring that is not touched: no depth.
  [[nodiscard]] RingContact get(std::size_t ring) const noexcept {
    if (!has(ring)) return {.ring = ring};
    const Block& b = blocks_[(ring - origin_) / kBlock];
    const std::size_t k = row(ring);
    return {
        ring,         b.depth[k], b.slope[k],  b.coverage[k], {b.normal2[k], b.lean[k], b.turn[k]},
        b.advance[k], b.since[k], b.surface[k]};
  }

 private:
  [[nodiscard]] static std::size_t touched_in(const Slice& slice) noexcept {
    Quanta touched = 0;
    in_packs([=, depths = &slice.rows.depth[slice.begin], count = slice.size(),
              to = &touched](auto n) CLAYSTACK_INLINE {
      Quantas<n> sum{};
      for (std::size_t k = 0; k < count; k += n)
        sum -= load_doubles<n>(depths + k, count - k) > 0.0;  // true is -1
      *to = sum_of(sum);
    });
    return static_cast<std::size_t>(touched);
  }
  template <class Self, class Use>
  static void slices(Self& self, std::size_t first, std::size_t end, Use& use) noexcept {
    while (first < end) {
      const std::size_t at = first - self.origin_, begin = at % kBlock;
      const std::size_t count = std::min(end - first, kBlock - begin);
      auto& rows = self.blocks_[at / kBlock];
      use(SliceOf<std::remove_reference_t<decltype(rows)>>{rows, begin, begin + count, first});
      first += count;
    }
  }
  [[nodiscard]] static std::size_t blocks_for(std::size_t rings) noexcept {
    return (rings + kBlock - 1) / kBlock;
  }
  [[nodiscard]] Block& block(std::size_t ring) noexcept {
    return blocks_[(ring - origin_) / kBlock];
  }
  [[nodiscard]] std::size_t row(std::size_t ring) const noexcept {
    return (ring - origin_) % kBlock;
  }

  std::vector<Block> blocks_;
  std::size_t origin_ = 0;  ///< ring of the first row
  std::size_t from_ = 0, to_ = 0, touched_ = 0;
};

}  // namespace clay
