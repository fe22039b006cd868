#include "engine/tick/band.hpp"

#include <algorithm>

namespace clay {
namespace {

// The clay that gives way over such a height bends the wall. Clay that the end of a rib has just
// entered gives way fastest, over a height that goes to zero with the ring height.
constexpr double kBendingMm = 4.0;

/// Mean distance by which the surface gives way [mm], over `kBendingMm` about the peak, or over the
/// contact if that is lower. The outermost rings reach to the ends of the band.
double mean_give(const TouchedRings& rings, const Band& band, double h) noexcept {
  const double height = std::max(band.height_mm(), h), length = std::min(kBendingMm, height);
  const double low = std::clamp(band.peak_mm - 0.5 * length, band.low_mm,
                                std::max(band.low_mm, band.high_mm - length));
  const double high = low + length;
  const auto ring_at = [&](double up) {
    return static_cast<std::size_t>(
        std::clamp(up / h, static_cast<double>(rings.from()), static_cast<double>(rings.to() - 1)));
  };
  const std::size_t first = ring_at(low), last = ring_at(high);
  double sum = 0.0;
  rings.each_slice(first, last + 1, [&](const auto& slice) {
    for (std::size_t k = slice.begin; k < slice.end; ++k) sum += slice.rows.give[k];
  });
  const double below = low - static_cast<double>(first) * h,
               above = static_cast<double>(last + 1) * h - high;
  return (h * sum - below * rings.give(first) - above * rings.give(last)) / length;
}

/// Height of the end of the contact beside its last ring [mm]; `next` is the ring beyond it.
double end_beside(const Tool& tool, const ClayStack& stack, double hip_y, const Contact& contact,
                  std::size_t last, bool up) noexcept {
  const double h = stack.ring_height_mm(), middle = (static_cast<double>(last) + 0.5) * h;
  if (up ? last + 1 >= stack.size() : last == 0)
    return up ? std::clamp(hip_y + tool.high(), middle, stack.height_mm())
              : std::clamp(hip_y + tool.low(), 0.0, middle);
  const std::size_t next = up ? last + 1 : last - 1;
  const double inside = contact.rings.get(last).depth_mm;
  const double clear = -signed_depth(tool, stack, hip_y, next, contact);
  const double step = up ? h : -h;
  if (clear > 1e299) {
    const double end = hip_y + (up ? tool.high() : tool.low());
    return up ? std::clamp(end, middle, middle + step) : std::clamp(end, middle + step, middle);
  }
  return middle + step * (clear > 0.0 ? inside / (inside + clear) : 1.0);
}

}  // namespace

double signed_depth(const Tool& tool, const ClayStack& stack, double hip_y, std::size_t ring,
                    const Contact& contact) noexcept {
  const double t = (static_cast<double>(ring) + 0.5) * stack.ring_height_mm() - hip_y;
  if (!(t >= tool.low() && t <= tool.high())) return -1e300;
  return depth_of(stack.rings()[ring], tool.radius(t), contact);
}

void Peak::settle(double h, Band& band) const noexcept {
  const double level = weight > 0.0 ? sum / weight : static_cast<double>(band.ring) + 0.5;
  band.peak_mm = std::clamp(level * h, band.low_mm, std::max(band.low_mm, band.high_mm));
  band.ring = static_cast<std::size_t>(level);
}

Band band_of(const Tool& tool, const ClayStack& stack, double hip_y,
             const Contact& contact) noexcept {
  const TouchedRings& rings = contact.rings;
  Band band;
  band.ring = rings.from();
  Peak peak;
  rings.each_slice([&](const auto& slice) {
    double level = static_cast<double>(slice.ring) + 0.5;
    for (std::size_t k = slice.begin; k < slice.end; ++k, level += 1.0) {
      band.deepest_mm = greater(slice.rows.depth[k], band.deepest_mm);
      peak.add(level, slice.rows.give[k]);
    }
  });
  band.low_mm = end_beside(tool, stack, hip_y, contact, rings.from(), false);
  band.high_mm = end_beside(tool, stack, hip_y, contact, rings.to() - 1, true);
  peak.settle(stack.ring_height_mm(), band);
  band.give_mm = mean_give(rings, band, stack.ring_height_mm());
  return band;
}

}  // namespace clay
