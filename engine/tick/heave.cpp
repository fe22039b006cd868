#include "engine/tick/heave.hpp"

#include "engine/tick/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kSteepest = 0.5;  // of a ring's growth over its height
constexpr std::size_t kRows = 64;

/// Up to a distance t of the reach, from 0 to 1: t^3 (10 - 15 t + 6 t^2). Each half from its own
/// end, so that rounding cannot make it fall.
CLAYSTACK_INLINE inline double share_up_to(double t) noexcept {
  const double far = 1.0 - t, s = t < far ? t : far;
  const double share = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  return t < far ? share : 1.0 - share;
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
        per_reach_(1.0 / heap.reach_mm) {}

  Quanta run() noexcept {
    const double level = from_mm_ / h_, size = static_cast<double>(stack_.size());
    if (heap_.up ? !(level < size) : !(level > 0.0)) return heap_.inside + heap_.outside;
    std::size_t ring =
        heap_.up ? static_cast<std::size_t>(level) : static_cast<std::size_t>(std::ceil(level)) - 1;
    while (!reached_end_ || carried() > 0) {
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
  static constexpr double kFar = 1e300;
  struct Portion {
    Quanta inside = 0, outside = 0;
  };
  /// Some neighbouring rings and one more at either end, which has no share.
  struct Block {
    double outer2[kRows + 2], inner2[kRows + 2];                 ///< [quanta]
    double per_outer[kRows + 2], per_inner[kRows + 2];           ///< 1 / R, 1 / r [1/mm]
    double outer[kRows + 2], inner[kRows + 2], wall[kRows + 2];  ///< [mm]
    double share_outside[kRows], share_inside[kRows];            ///< whole quanta
    double clear[kRows];                                         ///< of the tool [mm]
    double lack[kRows];  ///< above 0: does not take its share
    Quanta total;        ///< of the shares
    bool any_full;
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

  void lay(std::size_t first, std::size_t count) noexcept {
    load(first, count);
    divide(first, count);
    find_room(first, count);
    const std::span<const double> outside(block_.share_outside, count);
    const std::span<const double> inside(block_.share_inside, count);
    if (carried() == 0 && !block_.any_full) {
      writer_.thicken(first, outside, inside);
      placed_ += block_.total;
      return;
    }
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t k = heap_.up ? n : count - 1 - n;
      if (carried() == 0 && !(block_.lack[k] > 0.0)) {
        writer_.thicken(first + k, outside.subspan(k, 1), inside.subspan(k, 1));
        placed_ += static_cast<Quanta>(outside[k] + inside[k]);
        continue;
      }
      carry_.inside += static_cast<Quanta>(inside[k]);
      carry_.outside += static_cast<Quanta>(outside[k]);
      if (carried() > 0) place(first + k, k + 1);
    }
  }

  /// The block at an end of the stack. Beyond it there is nothing to be compared with: the end ring
  /// itself.
  const Ring* copy_end(std::size_t first, std::size_t count) noexcept {
    const auto rings = stack_.rings();
    for (std::size_t k = 0; k < count + 2; ++k)
      end_[k] = rings[std::min(first + k > 0 ? first + k - 1 : 0, rings.size() - 1)];
    return end_;
  }

  void load(std::size_t first, std::size_t count) noexcept {
    const bool at_end = first == 0 || first + count == stack_.size();
    const Ring* const from = at_end ? copy_end(first, count) : &stack_.rings()[first - 1];
    Block& b = block_;
    in_lanes([&]() CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count + 2; ++k) {
        b.outer2[k] = lane_double(from[k].outer2);
        b.inner2[k] = lane_double(from[k].inner2);
        b.outer[k] = rough_root(b.outer2[k] * kMm2PerQuantum);
        b.inner[k] = rough_root(b.inner2[k] * kMm2PerQuantum);
        b.wall[k] = b.outer[k] - b.inner[k];
        b.per_outer[k] = 1.0f / static_cast<float>(b.outer[k]);
        b.per_inner[k] = 1.0f / static_cast<float>(b.inner[k] + 1e-30);
      }
    });
  }

  /// What of the heap each ring gets: the difference of what lies up to its two faces.
  void divide(std::size_t first, std::size_t count) noexcept {
    const double away = heap_.up ? per_reach_ : -per_reach_, step = away * h_;
    const double start = away * (static_cast<double>(first) * h_ - from_mm_);
    const double inside = static_cast<double>(heap_.inside);
    const double outside = static_cast<double>(heap_.outside), sign = heap_.up ? 1.0 : -1.0;
    double in[kRows + 1], out[kRows + 1];
    Block& b = block_;
    in_lanes([&]() CLAYSTACK_INLINE {
      for (std::size_t k = 0; k < count + 1; ++k) {
        const double x = start + static_cast<double>(static_cast<int>(k)) * step;
        const double low = x > 0.0 ? x : 0.0, t = low < 1.0 ? low : 1.0;
        const double share = share_up_to(t);
        in[k] = lane_nearest(inside * share);
        out[k] = lane_nearest(outside * share);
      }
      for (std::size_t k = 0; k < count; ++k) {
        b.share_inside[k] = sign * (in[k + 1] - in[k]);
        b.share_outside[k] = sign * (out[k + 1] - out[k]);
      }
    });
    block_.total = static_cast<Quanta>(sign * (in[count] - in[0] + (out[count] - out[0])));
    const double end = start + (heap_.up ? static_cast<double>(count) * step : 0.0);
    reached_end_ = end >= 1.0;
  }

  /// How far ring i may grow before it stands in the tool [mm]; of one that is not beside it: a
  /// long way.
  [[nodiscard]] double clear_of_tool(std::size_t i, double R, double r) const noexcept {
    const double t = (static_cast<double>(i) + 0.5) * h_ - hip_y_;
    if (!(t >= tool_.low() && t <= tool_.high())) return kFar;
    const double f = tool_.radius(t), d = contact_.axis_distance_mm;
    return std::max(contact_.side == Side::compressive ? d - f - R : r - (d + f), 0.0);
  }

  /// Which rings of the block do not take their share: without a root, by what is more than each
  /// surface moves. A share leaves a bore open.
  void find_room(std::size_t first, std::size_t count) noexcept {
    static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
    Block& b = block_;
    for (std::size_t k = 0; k < count; ++k) b.clear[k] = kFar;
    const double low = (hip_y_ + tool_.low()) / h_, high = (hip_y_ + tool_.high()) / h_;
    const double from = std::max(low - 1.0, static_cast<double>(first));
    const double to = std::min(high + 1.0, static_cast<double>(first + count));
    if (from < to)
      for (std::size_t k = static_cast<std::size_t>(from) - first;
           k < static_cast<std::size_t>(to) - first; ++k)
        b.clear[k] = clear_of_tool(first + k, b.outer[k + 1], b.inner[k + 1]);
    const double spare = kSteepest * h_;
    in_lanes([&, end = count, most = largest2]() CLAYSTACK_INLINE {
      std::int64_t any = 0;
      for (std::size_t k = 0; k < end; ++k) {
        const double below = b.wall[k], above = b.wall[k + 2];
        const double least = below < above ? below : above;
        const double inside = b.share_inside[k], outside = b.share_outside[k];
        const double moved =
            kMm2PerQuantum * (0.5 * outside * b.per_outer[k + 1] + inside * b.per_inner[k + 1]);
        const double slope = least + spare - b.wall[k + 1];
        const double over = moved - (slope < b.clear[k] ? slope : b.clear[k]);
        const double bore = inside > 0.0 ? inside + 1.0 - b.inner2[k + 1] : 0.0;
        const double wide = b.outer2[k + 1] + outside - most;
        const double worse = bore > wide ? bore : wide;
        const double lacks = over > worse ? over : worse, lack = moved > 0.0 ? lacks : 0.0;
        b.lack[k] = lack;
        any |= lack > 0.0 ? std::int64_t{1} : std::int64_t{0};
      }
      b.any_full = any != 0;
    });
  }

  /// As much of what is carried as ring i takes.
  void place(std::size_t i, std::size_t k) noexcept {
    const Ring& ring = stack_.rings()[i];
    if (carry_.inside > ring.inner2) {  // a bore holds no more than itself
      carry_.outside += carry_.inside - ring.inner2;
      carry_.inside = ring.inner2;
    }
    const double least = std::min(block_.wall[k - 1], block_.wall[k + 1]);
    const double room = least + kSteepest * h_ - block_.wall[k];
    if (!(room > 0.0)) return;
    const double R = block_.outer[k], r = block_.inner[k];
    double out = 0.0, in = 0.0;
    const Portion taken = fitting(i, room, R, r, out, in);
    const Quanta inside = writer_.put_inside(i, taken.inside);
    const Quanta outside = writer_.put_outside(i, taken.outside);
    carry_.inside -= inside;
    carry_.outside -= outside;
    placed_ += inside + outside;
    block_.wall[k] += out + in;
  }

  /// The part of what is carried for which there is room, in the same proportion.
  [[nodiscard]] Portion fitting(std::size_t i, double room, double R, double r, double& out,
                                double& in) const noexcept {
    const double outside2 = static_cast<double>(carry_.outside) * kMm2PerQuantum;
    const double inside2 = static_cast<double>(carry_.inside) * kMm2PerQuantum;
    const double clear = clear_of_tool(i, R, r);
    // No root where there is plenty of room.
    out = 0.5 * outside2 / R;
    in = inside2 > 0.0 ? inside2 / r : 0.0;
    if (out + in <= std::min(room, clear)) return carry_;
    out = std::sqrt(R * R + outside2) - R;
    in = inside2 > 0.0 ? r - std::sqrt(std::max(r * r - inside2, 0.0)) : 0.0;
    const bool presses_outside = contact_.side == Side::compressive;
    const double most_out = presses_outside ? std::min(out, clear) : out;
    const double most_in = presses_outside ? in : std::min(in, clear);
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
  bool reached_end_ = false;  ///< the whole heap is shared out
  Portion carry_;
  Quanta placed_ = 0;
  Block block_;
  Ring end_[kRows + 2];
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
