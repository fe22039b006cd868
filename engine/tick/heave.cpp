#include "engine/tick/heave.hpp"

#include "engine/tick/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kSteepest = 0.5;  // of a ring's growth over its height
constexpr std::size_t kRows = 32;

double share_within(double t) noexcept {
  if (!(t < 1.0)) return 1.0;
  if (!(t > 0.0)) return 0.0;
  return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
}

/// Radii of some rings and of one more at either end.
struct Walls {
  double outer[kRows + 2], inner[kRows + 2], wall[kRows + 2];
};

void load(std::span<const Ring> rings, std::size_t first, std::size_t count,
          Walls& walls) noexcept {
  for (std::size_t k = 0; k < count + 2; ++k) {
    // Beyond an end of the stack there is nothing to be compared with: the ring itself.
    const std::size_t i = std::min(first + k > 0 ? first + k - 1 : 0, rings.size() - 1);
    walls.outer[k] = static_cast<double>(rings[i].outer2);
    walls.inner[k] = static_cast<double>(rings[i].inner2);
  }
  in_lanes([&]() CLAYSTACK_INLINE {
    for (std::size_t k = 0; k < count + 2; ++k) {
      walls.outer[k] = std::sqrt(walls.outer[k] * kMm2PerQuantum);
      walls.inner[k] = std::sqrt(walls.inner[k] * kMm2PerQuantum);
      walls.wall[k] = walls.outer[k] - walls.inner[k];
    }
  });
}

/// One end of a band and the way from there.
class Heaving {
 public:
  Heaving(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
          const Band& band, const Heap& heap, StackWriter& writer) noexcept
      : tool_(tool),
        stack_(stack),
        contact_(contact),
        writer_(writer),
        heap_(heap),
        h_(stack.ring_height_mm()),
        hip_y_(hip_y),
        from_mm_(heap.up ? band.high_mm : band.low_mm),
        per_reach_(1.0 / heave_reach(tool, stack, band)) {}

  WideQuanta run() noexcept {
    const double level = from_mm_ / h_, size = static_cast<double>(stack_.size());
    if (heap_.up ? !(level < size) : !(level > 0.0)) return heap_.inside + heap_.outside;
    std::size_t ring =
        heap_.up ? static_cast<std::size_t>(level) : static_cast<std::size_t>(std::ceil(level)) - 1;
    while (part_ < kWhole || carried() > 0) {
      const std::size_t left = heap_.up ? stack_.size() - ring : ring + 1;
      const std::size_t count = std::min({left, kRows, rings_to_end(ring)});
      if (count == 0) break;
      lay(heap_.up ? ring : ring + 1 - count, count);
      if (count == left) break;
      ring = heap_.up ? ring + count : ring - count;
    }
    return heap_.inside + heap_.outside - placed_;
  }

 private:
  static constexpr std::int64_t kWhole = std::int64_t{1} << 40;
  struct Portion {
    WideQuanta inside = 0, outside = 0;
  };

  [[nodiscard]] WideQuanta carried() const noexcept { return carry_.inside + carry_.outside; }
  /// Rings of which some part is within the reach; as many again for what is carried.
  [[nodiscard]] std::size_t rings_to_end(std::size_t ring) const noexcept {
    const double x = way_to(ring), most = 2.0 / per_reach_;
    return x < most ? static_cast<std::size_t>((most - x) / h_) + 1 : 0;
  }
  /// From the band's end to the near face of a ring.
  [[nodiscard]] double way_to(std::size_t ring) const noexcept {
    const double face = static_cast<double>(heap_.up ? ring : ring + 1) * h_;
    return heap_.up ? face - from_mm_ : from_mm_ - face;
  }

  /// The next ring's share.
  Portion next(std::size_t ring) noexcept {
    const double t = (way_to(ring) + h_) * per_reach_;
    part_ = std::max(part_, static_cast<std::int64_t>(share_within(t) * 0x1p40));
    Portion share{((heap_.inside * part_) >> 40) - dealt_.inside,
                  ((heap_.outside * part_) >> 40) - dealt_.outside};
    dealt_.inside += share.inside;
    dealt_.outside += share.outside;
    return share;
  }

  void lay(std::size_t first, std::size_t count) noexcept {
    load(stack_.rings(), first, count, walls_);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t k = heap_.up ? n : count - 1 - n;
      Portion want = part_ < kWhole ? next(first + k) : Portion{};
      want.inside += carry_.inside;
      want.outside += carry_.outside;
      carry_ = want;
      if (want.inside + want.outside > 0) place(first + k, k + 1);
    }
  }

  /// As much of what is carried as ring i takes.
  void place(std::size_t i, std::size_t k) noexcept {
    const Ring& ring = stack_.rings()[i];
    if (carry_.inside > ring.inner2) {  // a bore holds no more than itself
      carry_.outside += carry_.inside - ring.inner2;
      carry_.inside = ring.inner2;
    }
    const double least = std::min(walls_.wall[k - 1], walls_.wall[k + 1]);
    const double room = least + kSteepest * h_ - walls_.wall[k];
    const double R = walls_.outer[k], r = walls_.inner[k];
    const double outside2 = static_cast<double>(carry_.outside) * kMm2PerQuantum;
    const double inside2 = static_cast<double>(carry_.inside) * kMm2PerQuantum;
    const double t = (static_cast<double>(i) + 0.5) * h_ - hip_y_;
    const bool beside_tool = t >= tool_.low() && t <= tool_.high();
    // No root where there is plenty of room: 1.0 is more than r / (r + sqrt(r^2 - inside)) needs.
    const double bound = 0.5 * outside2 / R + (inside2 > 0.0 ? inside2 / r : 0.0);
    Portion taken = carry_;
    if (!(bound <= room) || beside_tool)
      taken = fitting(i, room, R, r, outside2, inside2, t, beside_tool);
    const WideQuanta inside = writer_.put_inside(i, taken.inside);
    const WideQuanta outside = writer_.put_outside(i, taken.outside);
    carry_.inside -= inside;
    carry_.outside -= outside;
    placed_ += inside + outside;
    walls_.wall[k] += bound <= room ? bound : room > 0.0 ? room : 0.0;
  }

  /// The part of what is carried for which there is room, in the same proportion.
  [[nodiscard]] Portion fitting(std::size_t, double room, double R, double r, double outside2,
                                double inside2, double t, bool beside_tool) const noexcept {
    if (!(room > 0.0)) return {};
    double out = std::sqrt(R * R + outside2) - R;
    double in = inside2 > 0.0 ? r - std::sqrt(std::max(r * r - inside2, 0.0)) : 0.0;
    const double part = out + in > room ? room / (out + in) : 1.0;
    out *= part;
    in *= part;
    if (beside_tool) {
      const double f = tool_.radius(t), d = contact_.axis_distance_mm;
      if (contact_.side == Side::compressive)
        out = std::min(out, std::max(d - f - R, 0.0));
      else
        in = std::min(in, std::max(r - (d + f), 0.0));
    }
    const auto least = [](double mm2, WideQuanta most) {
      return std::min(static_cast<WideQuanta>(std::max(mm2, 0.0) * kQuantaPerMm2), most);
    };
    return {least(in * (2.0 * r - in), carry_.inside),
            least(out * (2.0 * R + out), carry_.outside)};
  }

  const Tool& tool_;
  const ClayStack& stack_;
  const Contact& contact_;
  StackWriter& writer_;
  const Heap& heap_;
  double h_, hip_y_, from_mm_, per_reach_;
  std::int64_t part_ = 0;  ///< of the heap that was dealt so far, in 2^-40
  Portion dealt_, carry_;
  WideQuanta placed_ = 0;
  Walls walls_{};
};

}  // namespace

double heave_reach(const Tool& tool, const ClayStack& stack, const Band& band) noexcept {
  const Ring& ring = stack.rings()[std::min(band.ring, stack.size() - 1)];
  const double wall = ring.outer_mm() - ring.inner_mm(), width = 2.0 * tool.widest();
  const double reach = 0.8 * (band.height_mm() + std::min(wall, width));
  return std::clamp(reach, stack.ring_height_mm(), kLongestShellMm);
}

WideQuanta heave(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
                 const Band& band, const Heap& heap, StackWriter& writer) noexcept {
  return Heaving(tool, stack, hip_y, contact, band, heap, writer).run();
}

}  // namespace clay
