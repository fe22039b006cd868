#include "engine/tick/heave.hpp"

#include "engine/clay/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kSteepest = 0.5;  // of a ring's growth over its height
constexpr std::size_t kRows = 64;
constexpr std::size_t kLanes = 8;  // of floats

/// Some neighbouring rings and one more at either end, which has no share. Loops take whole lanes: the
/// rows after the last ring repeat it, and have no share. Lengths for which single precision is
/// enough are floats, of which a machine takes twice as many.
struct Block {
  static constexpr std::size_t kAll = kRows + kLanes;
  double outer2[kAll], inner2[kAll];         ///< [quanta]
  float outer[kAll], inner[kAll];            ///< [mm]
  float per_outer[kAll], per_inner[kAll];    ///< 1 / R, 1 / r [1/mm]
  double wall[kAll];                         ///< [mm]
  double outside_to[kAll], inside_to[kAll];  ///< whole quanta that lie up to a ring's lower face
  Quanta outside[kAll], inside[kAll];        ///< a ring's share
  double clear[kAll];                        ///< of the tool [mm]
  double lack[kAll];                         ///< above 0: does not take its share
};

CLAYSTACK_INLINE inline void measure(Block& b, std::size_t rows) noexcept {
  for (std::size_t k = 0; k < rows; ++k) {
    b.outer[k] = static_cast<float>(b.outer2[k] * kMm2PerQuantum);
    b.inner[k] = static_cast<float>(b.inner2[k] * kMm2PerQuantum);
  }
  for (std::size_t k = 0; k < rows; ++k) {
    b.outer[k] = std::sqrt(b.outer[k]);
    b.inner[k] = std::sqrt(b.inner[k]);
    b.per_outer[k] = 1.0f / b.outer[k];
    b.per_inner[k] = 1.0f / (b.inner[k] + 1e-30f);
  }
  for (std::size_t k = 0; k < rows; ++k)
    b.wall[k] = static_cast<double>(b.outer[k]) - static_cast<double>(b.inner[k]);
}

/// What of a heap lies up to each face of a ring, as parts of it: up to a distance t of the reach,
/// from 0 to 1, t^3 (10 - 15 t + 6 t^2). Each half from its own end, so that rounding cannot make
/// it fall. `start` and `step`: of the faces, in parts of the reach; below 0 downward.
///
/// In small loops: where a loop asks for the same condition twice, GCC does all of it twice.
CLAYSTACK_INLINE inline void share_out(double* part, std::size_t count, std::size_t faces,
                                       double start, double step) noexcept {
  const double last = kLevels[count];
  double of_half[Block::kAll];
  for (std::size_t k = 0; k < faces; ++k)
    part[k] = greater(start + lesser(kLevels[k], last) * step, 0.0);
  for (std::size_t k = 0; k < faces; ++k) part[k] = lesser(part[k], 1.0);
  for (std::size_t k = 0; k < faces; ++k) {
    const double s = lesser(part[k], 1.0 - part[k]);
    of_half[k] = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  }
  for (std::size_t k = 0; k < faces; ++k)
    part[k] = part[k] < 1.0 - part[k] ? of_half[k] : 1.0 - of_half[k];
}

/// In whole quanta. What a ring gets is the difference of its two faces.
CLAYSTACK_INLINE inline void divide(Block& b, const double* part, std::size_t faces, double outside,
                                    double inside) noexcept {
  for (std::size_t k = 0; k < faces; ++k) {
    b.inside_to[k] = lane_nearest(inside * part[k]);
    b.outside_to[k] = lane_nearest(outside * part[k]);
  }
}

/// Which rings do not take their share: without a root, by what is more than each surface moves. A
/// share leaves a bore open.
CLAYSTACK_INLINE inline void find_lacks(Block& b, std::size_t rows, double sign, double spare,
                                        double largest2) noexcept {
  for (std::size_t k = 0; k < rows; ++k) {
    const double outside = sign * (b.outside_to[k + 1] - b.outside_to[k]);
    const double inside = sign * (b.inside_to[k + 1] - b.inside_to[k]);
    b.outside[k] = lane_quanta(outside);
    b.inside[k] = lane_quanta(inside);
    const double moved = kMm2PerQuantum * (0.5 * outside * static_cast<double>(b.per_outer[k + 1]) +
                                           inside * static_cast<double>(b.per_inner[k + 1]));
    const double slope = lesser(b.wall[k], b.wall[k + 2]) + spare - b.wall[k + 1];
    const double over = moved - lesser(slope, b.clear[k]);
    const double bore = inside > 0.0 ? inside + 1.0 - b.inner2[k + 1] : 0.0;
    const double wide = b.outer2[k + 1] + outside - largest2;
    const double lacks = greater(over, greater(bore, wide));
    b.lack[k] = moved > 0.0 ? lacks : 0.0;
  }
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
    prepare(first, count);
    for (std::size_t n = 0; n < count;) {
      const std::size_t even = carried() == 0 ? rings_that_take(n, count) : 0;
      if (even > 0) {
        give_shares(first, heap_.up ? n : count - n - even, even);
        n += even;
        continue;
      }
      const std::size_t k = heap_.up ? n : count - 1 - n;
      carry_.inside += block_.inside[k];
      carry_.outside += block_.outside[k];
      if (carried() > 0) place(first + k, k + 1);
      ++n;
    }
  }

  /// From the n-th ring of the block on its way: how many take their share.
  [[nodiscard]] std::size_t rings_that_take(std::size_t n, std::size_t count) const noexcept {
    const std::size_t begin = n;
    while (n < count && !(block_.lack[heap_.up ? n : count - 1 - n] > 0.0)) ++n;
    return n - begin;
  }

  void give_shares(std::size_t first, std::size_t k, std::size_t count) noexcept {
    const Block& b = block_;
    writer_.thicken(first + k, {b.outside + k, count}, {b.inside + k, count});
    const double total =
        b.inside_to[k + count] - b.inside_to[k] + (b.outside_to[k + count] - b.outside_to[k]);
    placed_ += static_cast<Quanta>(heap_.up ? total : -total);
  }

  void prepare(std::size_t first, std::size_t count) noexcept {
    static const double largest2 = static_cast<double>(quanta_from_radius(kMaxRadiusMm));
    const std::size_t rows = (count + kLanes - 1) / kLanes * kLanes;
    const double away = heap_.up ? per_reach_ : -per_reach_, step = away * h_;
    const double start = away * (static_cast<double>(first) * h_ - from_mm_);
    const double end = start + (heap_.up ? static_cast<double>(count) * step : 0.0);
    reached_end_ = end >= 1.0;
    load(first, count, rows + kLanes);
    in_lanes([=, b = &block_]() CLAYSTACK_INLINE { measure(*b, rows + kLanes); });
    find_clearance(first, count, rows);
    in_lanes([=, b = &block_, outside = static_cast<double>(heap_.outside),
              inside = static_cast<double>(heap_.inside), sign = heap_.up ? 1.0 : -1.0,
              spare = kSteepest * h_, most = largest2]() CLAYSTACK_INLINE {
      double part[Block::kAll];
      share_out(part, count, rows + kLanes, start, step);
      divide(*b, part, rows + kLanes, outside, inside);
      find_lacks(*b, rows, sign, spare, most);
    });
  }

  void load(std::size_t first, std::size_t count, std::size_t rows) noexcept {
    // Beyond an end of the stack there is nothing to be compared with: the end ring itself.
    const std::size_t begin = first == 0 ? 1 : 0;
    const std::size_t end = first + count == stack_.size() ? count + 1 : count + 2;
    Block& b = block_;
    in_lanes([=, to = &b, rings = &stack_.rings()[first + begin - 1]]() CLAYSTACK_INLINE {
      for (std::size_t k = begin; k < end; ++k) {
        to->outer2[k] = lane_double(rings[k - begin].outer2);
        to->inner2[k] = lane_double(rings[k - begin].inner2);
      }
    });
    if (begin > 0) {
      b.outer2[0] = b.outer2[1];
      b.inner2[0] = b.inner2[1];
    }
    for (std::size_t k = end; k < rows; ++k) {
      b.outer2[k] = b.outer2[end - 1];
      b.inner2[k] = b.inner2[end - 1];
    }
  }

  /// How far ring i may grow before it stands in the tool [mm]; of one that is not beside it: a
  /// long way.
  [[nodiscard]] double clear_of_tool(std::size_t i, double R, double r) const noexcept {
    const double t = (static_cast<double>(i) + 0.5) * h_ - hip_y_;
    if (!(t >= tool_.low() && t <= tool_.high())) return kFar;
    const double f = tool_.radius(t), d = contact_.axis_distance_mm;
    return std::max(contact_.side == Side::compressive ? d - f - R : r - (d + f), 0.0);
  }

  void find_clearance(std::size_t first, std::size_t count, std::size_t rows) noexcept {
    Block& b = block_;
    std::fill_n(b.clear, rows, kFar);
    const double low = (hip_y_ + tool_.low()) / h_, high = (hip_y_ + tool_.high()) / h_;
    const double from = std::max(low - 1.0, static_cast<double>(first));
    const double to = std::min(high + 1.0, static_cast<double>(first + count));
    if (from < to)
      for (std::size_t k = static_cast<std::size_t>(from) - first;
           k < static_cast<std::size_t>(to) - first; ++k)
        b.clear[k] = clear_of_tool(first + k, static_cast<double>(b.outer[k + 1]),
                                   static_cast<double>(b.inner[k + 1]));
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
    const double R = static_cast<double>(block_.outer[k]);
    const double r = static_cast<double>(block_.inner[k]);
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
