#include "engine/clay/ring_sums.hpp"

#include "engine/clay/lanes.hpp"
#include "tests/engine/clay/stack_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace clay {
namespace {

Ring random_ring(std::mt19937_64& random) {
  const Quanta outer2 = quanta_from_radius(1.0 + 4999.0 * samples::uniform(random));
  return {outer2, static_cast<Quanta>(samples::uniform(random) * static_cast<double>(outer2))};
}

std::vector<Ring> random_rings(std::mt19937_64& random, std::size_t count) {
  std::vector<Ring> rings;
  while (rings.size() < count) rings.push_back(random_ring(random));
  return rings;
}

std::size_t index_below(std::mt19937_64& random, std::size_t end) {
  return std::min(end - 1,
                  static_cast<std::size_t>(samples::uniform(random) * static_cast<double>(end)));
}

/// One ring, the block sizes of every level and their neighbours, and sizes between them.
const auto kCounts = rc::gen::element<std::size_t>(1, 2, 63, 64, 65, 200, 4095, 4096, 4097, 9000);

RC_GTEST_PROP(RingSums, EqualTheSumsOfTheRings, ()) {
  auto random = *samples::random_engine();
  auto rings = random_rings(random, *kCounts);
  const std::size_t max_rings = rings.size() + 150;
  RingSums sums(ClayStack::from_rings(1.0, rings, 0, max_rings).value());
  for (int round = 0; round < 4; ++round) {
    const std::size_t first = index_below(random, rings.size());
    const std::size_t last = std::min(first + index_below(random, 200), rings.size() - 1);
    for (std::size_t i = first; i <= last; ++i) rings[i] = random_ring(random);
    sums.refresh(rings, first, last);
    const std::size_t old_size = rings.size();
    while (rings.size() < max_rings && samples::uniform(random) < 0.97)
      rings.push_back(random_ring(random));
    if (rings.size() > old_size) sums.refresh(rings, old_size, rings.size() - 1);

    WideQuanta above = 0;
    for (std::size_t i = rings.size(); i-- > 0; above += rings[i].volume())
      RC_ASSERT(sums.above(rings, i) == above);
  }
}

/// Volumes that 64 bits cannot add up.
TEST(RingSums, AddUpTheLargestRings) {
  const std::vector<Ring> rings(200, Ring{quanta_from_radius(kMaxRadiusMm), 1});
  for (const bool two : {true, false}) {
    const TwoLanesScope lanes(two);
    EXPECT_TRUE(block_of(rings).volume == 200 * WideQuanta{rings[0].volume()});
    EXPECT_EQ(block_of(rings).least, rings[0].volume());
  }
}

/// A predicate that is always true visits every ring once, from the top, with its load.
RC_GTEST_PROP(RingSums, SearchVisitsEverySuspectRing, ()) {
  auto random = *samples::random_engine();
  const auto rings = random_rings(random, *kCounts);
  const RingSums sums(ClayStack::from_rings(1.0, rings, 0, rings.size() + 100).value());
  const WideQuanta crown = 12345;
  const Quanta thin = rings[index_below(random, rings.size())].volume();
  std::size_t next = rings.size(), scanned = 0;
  WideQuanta above = crown;
  std::vector<bool> seen(rings.size());
  sums.search(
      rings.size(), crown, [&](WideQuanta, Quanta least) { return least <= thin; },
      [&](std::size_t first, std::size_t last, WideQuanta weight) {
        for (; next > last + 1; --next) above += rings[next - 1].volume();
        RC_ASSERT(last + 1 == next && last - first < RingSums::kFan);
        RC_ASSERT(weight == above);
        for (std::size_t i = first; i <= last; ++i) seen[i] = true;
        scanned += last - first + 1;
      });
  for (std::size_t i = 0; i < rings.size(); ++i)
    if (rings[i].volume() <= thin) RC_ASSERT(seen[i]);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const std::size_t from = i / RingSums::kFan * RingSums::kFan;
    const std::size_t end = std::min(from + RingSums::kFan, rings.size());
    if (std::none_of(rings.begin() + static_cast<std::ptrdiff_t>(from),
                     rings.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const Ring& ring) { return ring.volume() <= thin; }))
      RC_ASSERT(!seen[i]);
  }
  RC_ASSERT(static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true)) == scanned);
}

}  // namespace
}  // namespace clay
