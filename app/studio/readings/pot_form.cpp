#include "app/studio/readings/pot_form.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace clay::studio {
namespace {

bool has_bore(const Ring& ring) { return ring.inner2 > 0; }

void find_parts(std::span<const Ring> rings, double ring_mm, PotForm& form) {
  for (std::size_t i = 1; i < rings.size(); ++i) {
    if (std::max(rings[i - 1].inner2, rings[i].inner2) <
        std::min(rings[i - 1].outer2, rings[i].outer2))
      continue;
    ++form.parts;
    if (!form.parting_mm) form.parting_mm = static_cast<double>(i) * ring_mm;
  }
}

/// A turned foot is a bore below the floor.
void find_floor(std::span<const Ring> rings, double ring_mm, PotForm& form) {
  const auto floor = std::ranges::find_if_not(rings, has_bore);
  form.floorless = !rings.empty() && floor == rings.end();
  const auto bore = std::find_if(floor, rings.end(), has_bore);
  if (bore != rings.end()) form.floor_mm = static_cast<double>(bore - rings.begin()) * ring_mm;
}

/// From the rim down to the floor; without a bore in the rim there is no mouth.
void find_throttle(std::span<const Ring> rings, double ring_mm, PotForm& form) {
  double narrowest_mm = INFINITY;
  for (std::size_t i = rings.size(); i-- > 0 && has_bore(rings[i]);) {
    const double bore_mm = 2.0 * rings[i].inner_mm();
    if (narrowest_mm < kLeastMouthMm && bore_mm >= kLeastMouthMm) return;
    if (bore_mm >= narrowest_mm) continue;
    narrowest_mm = bore_mm;
    form.throttle_mm = (static_cast<double>(i) + 0.5) * ring_mm;
  }
  form.throttle_mm.reset();  // no bore is wider below it
}

}  // namespace

PotForm form_of(const ClayStack& stack) {
  PotForm form;
  const auto rings = stack.rings();
  form.hollow = std::ranges::any_of(rings, has_bore);
  find_parts(rings, stack.ring_height_mm(), form);
  find_floor(rings, stack.ring_height_mm(), form);
  find_throttle(rings, stack.ring_height_mm(), form);
  return form;
}

bool in_floor(const PotForm& form, glm::dvec2 from_mm, glm::dvec2 to_mm) {
  constexpr double kRoundedMm = 1.0;  // smoothing rounds the corner of the bore
  const bool upright = std::abs(to_mm.y - from_mm.y) > std::abs(to_mm.x - from_mm.x);
  if (!form.floor_mm || !upright) return false;
  // From below the upper face to that face: a flange beside it is no floor.
  const auto [low, high] = std::minmax(from_mm.y, to_mm.y);
  return low < *form.floor_mm && std::abs(high - *form.floor_mm) <= kRoundedMm;
}

}  // namespace clay::studio
