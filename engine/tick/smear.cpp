#include "engine/tick/smear.hpp"

#include <algorithm>
#include <cmath>

namespace clay {
namespace {

constexpr double kFilmMm = 0.012;
constexpr double kMostOfStep = 0.25;  // of a difference, for a diffusion that does not oscillate
constexpr std::size_t kMostRings = 4096;

}  // namespace

void smear(const Tool& tool, const ClayStack& stack, double hip_y, double dt_s,
           const Contact& contact, const Band& band, const Smearing& how,
           StackWriter& writer) noexcept {
  const auto rings = stack.rings();
  const double h = stack.ring_height_mm(), c = std::max(band.height_mm(), h);
  if (!(band.deepest_mm > 0.0 && dt_s > 0.0) || rings.size() < 2) return;
  const bool outside = contact.side == Side::compressive;
  const Ring& at = rings[std::min(band.ring, rings.size() - 1)];
  const double radius = outside ? at.outer_mm() : at.inner_mm();
  const double wet = std::min(1.0, 4.0 * band.deepest_mm / how.yield_depth_mm);
  const double spread = kFilmMm * radius * how.surface_per_s * wet * dt_s;  // D dt
  // Far enough apart that a step is stable.
  const double apart = std::max(1.0, std::ceil(std::sqrt(spread / kMostOfStep) / h));
  if (!(apart < static_cast<double>(rings.size()))) return;
  const auto stride = static_cast<std::size_t>(apart);
  const double k0 = spread / (apart * apart * h * h);
  const double middle = 0.5 * (band.low_mm + band.high_mm), per_c = 1.0 / c;
  const double last = static_cast<double>(rings.size() - 1);
  const auto first = static_cast<std::size_t>(std::clamp((middle - c) / h, 1.0, last));
  const auto end = static_cast<std::size_t>(std::clamp((middle + c) / h + 1.0, 1.0, last + 1.0));
  if (end <= first + stride || end - first > kMostRings) return;

  const auto surface2 = [&](const Ring& ring) { return outside ? ring.outer2 : ring.inner2; };
  // How much a ring may get before it stands in the tool's way, and give before it is too thin.
  const auto may_get = [&](std::size_t i) -> double {
    const double depth = signed_depth(tool, stack, hip_y, i, contact);
    if (depth <= -1e299) return 1e300;
    if (depth >= 0.0 || contact.rings.has(i)) return 0.0;
    return -depth * 2.0 * (outside ? rings[i].outer_mm() : rings[i].inner_mm() + depth) *
           kQuantaPerMm2;
  };
  const auto may_give = [&](const Ring& ring) {
    const double spare =
        mm2_from_quanta(ring.volume()) - how.min_wall_mm * (ring.outer_mm() + ring.inner_mm());
    return std::max(spare, 0.0) * kQuantaPerMm2;
  };
  // From the old differences, half of what either end may: so the order of the pairs is nothing.
  for (std::size_t i = first; i + stride < end; ++i) {
    const std::size_t j = i + stride;
    const double z = (0.5 * static_cast<double>(i + j + 1) * h - middle) * per_c;
    const double window = 1.0 - z * z;
    if (!(window > 0.0)) continue;
    if (!outside && (rings[i].inner2 == 0 || rings[j].inner2 == 0)) continue;
    const double difference = static_cast<double>(surface2(rings[i]) - surface2(rings[j]));
    const double size = std::abs(difference) * k0 * window;
    // A higher surface outside is clay; inside it is the lack of it.
    const bool to_j = (difference > 0.0) == outside;
    const std::size_t giver = to_j ? i : j, taker = to_j ? j : i;
    const double most = std::min(0.5 * may_get(taker), 0.5 * may_give(rings[giver]));
    const auto amount = static_cast<Quanta>(std::min(size, most));
    if (amount <= 0) continue;
    writer.smear(giver, taker, amount, outside);
  }
}

}  // namespace clay
