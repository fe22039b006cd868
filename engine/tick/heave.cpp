#include "engine/tick/heave.hpp"

#include "engine/tick/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kSteepest = 0.5;  // of a ring's growth over its height
constexpr std::size_t kRows = 32;

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

  Quanta run() noexcept {
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
    Quanta inside = 0, outside = 0;
  };

  [[nodiscard]] Quanta carried() const noexcept { return carry_.inside + carry_.outside; }
  /// Rings to the end of the reach; where something is carried, to that of twice the reach.
  [[nodiscard]] std::size_t rings_to_end(std::size_t ring) const noexcept {
    const double x = way_to(ring), most = (carried() > 0 ? 2.0 : 1.0) / per_reach_;
    return x < most ? static_cast<std::size_t>((most - x) / h_) + 1 : 0;
  }
  /// From the band's end to the near face of a ring.
  [[nodiscard]] double way_to(std::size_t ring) const noexcept {
    const double face = static_cast<double>(heap_.up ? ring : ring + 1) * h_;
    return heap_.up ? face - from_mm_ : from_mm_ - face;
  }

  static Quanta part_of(Quanta amount, std::int64_t part) noexcept {
    return static_cast<Quanta>((WideQuanta{amount} * part) >> 40);
  }

  void lay(std::size_t first, std::size_t count) noexcept {
    load(stack_.rings(), first, count, walls_);
    divide(first, count);
    const bool fits = clear_of_tool(first, count) && carried() == 0 && there_is_room(count);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t k = heap_.up ? n : count - 1 - n;
      const auto part = std::max(part_, static_cast<std::int64_t>(parts_[k]));
      Portion share;
      if (part > part_) {
        share = {part_of(heap_.inside, part) - dealt_.inside,
                 part_of(heap_.outside, part) - dealt_.outside};
        dealt_.inside += share.inside;
        dealt_.outside += share.outside;
        part_ = part;
      }
      if (fits) {
        const Quanta inside = share.inside > 0 ? writer_.put_inside(first + k, share.inside) : 0;
        share.outside += share.inside - inside;
        const Quanta outside = writer_.put_outside(first + k, share.outside);
        placed_ += inside + outside;
        carry_.outside += share.outside - outside;
        continue;
      }
      carry_.inside += share.inside;
      carry_.outside += share.outside;
      if (carried() > 0) place(first + k, k + 1);
    }
  }

  /// What of the heap lies as far as each ring's far face, in 2^-40.
  void divide(std::size_t first, std::size_t count) noexcept {
    const double near = way_to(heap_.up ? first : first + count - 1) * per_reach_;
    const double step = h_ * per_reach_;
    const double start = heap_.up ? near + step : near + static_cast<double>(count) * step;
    const double by = heap_.up ? step : -step;
    in_lanes([&]() CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count; ++k) {
        const double x = start + static_cast<double>(static_cast<int>(k)) * by;
        const double low = x > 0.0 ? x : 0.0, t = low < 1.0 ? low : 1.0;
        parts_[k] = t * t * t * (10.0 - 15.0 * t + 6.0 * t * t) * 0x1p40;
      }
    });
  }

  /// Whether no ring stands beside the tool, where it could grow into it.
  [[nodiscard]] bool clear_of_tool(std::size_t first, std::size_t count) const noexcept {
    const double low = (static_cast<double>(first) + 0.5) * h_ - hip_y_;
    const double high = low + static_cast<double>(count - 1) * h_;
    return low > tool_.high() || high < tool_.low();
  }

  /// Whether every ring of the block takes its share: without a root, by what is more than each
  /// surface moves.
  [[nodiscard]] bool there_is_room(std::size_t count) const noexcept {
    const double out2 = static_cast<double>(heap_.outside) * (kMm2PerQuantum * 0x1p-40);
    const double in2 = static_cast<double>(heap_.inside) * (kMm2PerQuantum * 0x1p-40);
    double worst = 0.0;
    const double spare = kSteepest * h_;
    const bool hollow = in2 > 0.0;
    double before = static_cast<double>(part_);
    double shares[kRows];
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t k = heap_.up ? n : count - 1 - n;
      shares[k] = parts_[k] - before;
      before = parts_[k];
    }
    in_lanes([&]() CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count; ++k) {
        const double w = walls_.wall[k + 1], below = walls_.wall[k], above = walls_.wall[k + 2];
        const double least = below < above ? below : above;
        const double inner = walls_.inner[k + 1];
        const double inside = in2 * shares[k], outside = 0.5 * out2 * shares[k];
        // A bore without room counts as no room.
        const double in = hollow ? inside / (inner + 1e-300) : 0.0;
        const double over = outside / walls_.outer[k + 1] + in - (least + spare - w);
        const double full = inside - inner * inner;
        const double bad = over > full ? over : full;
        worst = bad > worst ? bad : worst;
      }
    });
    return !(worst > 0.0);
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
    if (!(room > 0.0)) return;
    const double R = walls_.outer[k], r = walls_.inner[k];
    double out = 0.0, in = 0.0;
    const Portion taken = fitting(i, room, R, r, out, in);
    const Quanta inside = writer_.put_inside(i, taken.inside);
    const Quanta outside = writer_.put_outside(i, taken.outside);
    carry_.inside -= inside;
    carry_.outside -= outside;
    placed_ += inside + outside;
    walls_.wall[k] += out + in;
  }

  /// The part of what is carried for which there is room, in the same proportion.
  [[nodiscard]] Portion fitting(std::size_t i, double room, double R, double r, double& out,
                                double& in) const noexcept {
    const double outside2 = static_cast<double>(carry_.outside) * kMm2PerQuantum;
    const double inside2 = static_cast<double>(carry_.inside) * kMm2PerQuantum;
    const double t = (static_cast<double>(i) + 0.5) * h_ - hip_y_;
    const bool beside_tool = t >= tool_.low() && t <= tool_.high();
    // No root where there is plenty of room.
    out = 0.5 * outside2 / R;
    in = inside2 > 0.0 ? inside2 / r : 0.0;
    if (out + in <= room && !beside_tool) return carry_;
    out = std::sqrt(R * R + outside2) - R;
    in = inside2 > 0.0 ? r - std::sqrt(std::max(r * r - inside2, 0.0)) : 0.0;
    double most_out = out, most_in = in;
    if (beside_tool) {
      const double f = tool_.radius(t), d = contact_.axis_distance_mm;
      if (contact_.side == Side::compressive)
        most_out = std::max(d - f - R, 0.0);
      else
        most_in = std::max(r - (d + f), 0.0);
    }
    if (out + in <= room && out <= most_out && in <= most_in) return carry_;
    const double part = out + in > room ? room / (out + in) : 1.0;
    out = std::min(out * part, most_out);
    in = std::min(in * part, most_in);
    const auto least = [](double mm2, Quanta most) {
      return std::min(quanta_from_mm2(std::max(mm2, 0.0)), most);
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
  Quanta placed_ = 0;
  Walls walls_{};
  double parts_[kRows];
};

}  // namespace

double heave_reach(const Tool& tool, const ClayStack& stack, const Band& band) noexcept {
  const Ring& ring = stack.rings()[std::min(band.ring, stack.size() - 1)];
  const double wall = ring.outer_mm() - ring.inner_mm(), width = 2.0 * tool.widest();
  const double reach = 0.8 * (band.height_mm() + std::min(wall, width));
  return std::clamp(reach, stack.ring_height_mm(), kLongestShellMm);
}

Quanta heave(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
             const Band& band, const Heap& heap, StackWriter& writer) noexcept {
  return Heaving(tool, stack, hip_y, contact, band, heap, writer).run();
}

}  // namespace clay
