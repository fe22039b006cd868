#include "app/servo/live_view.hpp"

#include <algorithm>

namespace clay::servo {

void show(const ClayStack& stack, double time_s, LiveProfile& profile) noexcept {
  const auto rings = stack.rings();
  profile.size = std::min(rings.size(), LiveProfile::kRows);
  for (std::size_t row = 0; row < profile.size; ++row) {
    const Ring& ring = rings[row * rings.size() / profile.size];
    profile.rows[row] = {static_cast<float>(ring.outer_mm()), static_cast<float>(ring.inner_mm())};
  }
  profile.height_mm = stack.height_mm();
  profile.crown_mm = stack.crown_height_mm();
  profile.time_s = time_s;
}

}  // namespace clay::servo
