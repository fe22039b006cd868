#include "app/history/split.hpp"

#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace clay::history {
namespace {

constexpr std::int64_t kFreeAirUs = 300'000;
static_assert(kFreeAirUs == static_cast<std::int64_t>(1e6 * kFreeAirS));

/// Index of a pose in free air, between `first` and `touch`, at which a separate stroke may begin:
/// in the middle, or before the last vertical motion ahead of the contact. 0: there is none.
std::size_t place_in(std::span<const Pose> poses, std::size_t first, std::size_t touch) {
  if (poses[touch - 1].time_us - poses[first].time_us < kFreeAirUs) return 0;
  std::size_t move = touch;
  while (move > first && poses[move].position_mm.y == poses[move - 1].position_mm.y) --move;
  const std::int64_t half_way = (poses[first].time_us + poses[touch - 1].time_us) / 2;
  std::size_t place = first + 1;
  while (place + 1 < move && poses[place].time_us < half_way) ++place;
  return place < move ? place : 0;
}

std::vector<std::size_t> places(std::span<const Pose> poses, const std::vector<bool>& touching) {
  std::vector<std::size_t> begins;
  std::size_t free_since = 0;  // 0: no contact yet
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!touching[i]) continue;
    if (free_since > 0 && free_since < i)
      if (const std::size_t place = place_in(poses, free_since, i); place > 0)
        begins.push_back(place);
    free_since = i + 1;
  }
  return begins;
}

Result<std::vector<Pot>> throw_parts(const SceneSpec& scene, const Pot& before,
                                     std::span<const Pose> poses,
                                     const std::vector<std::size_t>& begins) {
  std::vector<Pot> pots;
  for (std::size_t part = 0; part <= begins.size(); ++part) {
    const std::size_t begin = part == 0 ? 0 : begins[part - 1];
    const std::size_t end = part < begins.size() ? begins[part] : poses.size();
    auto wheel = Wheel::build(scene, pots.empty() ? before : pots.back());
    if (!wheel) return tl::make_unexpected(wheel.error());
    for (const Pose& pose : from_zero(poses.subspan(begin, end - begin))) wheel->step(pose);
    pots.push_back(wheel->pot());
  }
  return pots;
}

}  // namespace

Split as_one(Thrown whole) {
  Split one;
  one.pots.push_back(std::move(whole.pot));
  return one;
}

Split split(const SceneSpec& scene, const Pot& before, std::span<const Pose> poses, Thrown whole) {
  if (auto begins = places(poses, whole.touching); !begins.empty()) {
    auto pots = throw_parts(scene, before, poses, begins);
    if (pots && pots->back() == whole.pot) return {std::move(begins), std::move(*pots)};
  }
  return as_one(std::move(whole));
}

}  // namespace clay::history
