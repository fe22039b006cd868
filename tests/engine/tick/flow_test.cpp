#include "engine/tick/rayleigh_kernel.hpp"
#include "engine/tick/redistribution.hpp"
#include "tests/engine/clay/stack_samples.hpp"
#include "tests/engine/wheel/flow_samples.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace clay {
namespace {

using samples::contact_on;
using samples::plan_of;

/// Equations (5) to (8) over the whole kernel, in 128 bits. Returns the remainder.
template <class RingOf>
WideQuanta literal_flow(const RayleighKernel& kernel, double offset, WideQuanta inside,
                        WideQuanta outside, std::size_t count, RingOf ring_of,
                        std::vector<Ring>& rings) {
  RayleighKernel::ShareCursor cursor(kernel, offset);
  WideQuanta rest = inside + outside, inside_dealt = 0, outside_dealt = 0;
  for (std::size_t j = 1; j <= std::min(kernel.length() + 1, count); ++j) {
    const WideQuanta part = cursor.next();
    const WideQuanta in = ((inside * part) >> 40) - inside_dealt;
    const WideQuanta out = ((outside * part) >> 40) - outside_dealt;
    inside_dealt += in;
    outside_dealt += out;
    Ring& ring = rings[ring_of(j)];
    const WideQuanta bore = std::min<WideQuanta>(in, ring.inner2);
    const WideQuanta room = quanta_from_radius(kMaxRadiusMm) - ring.outer2;
    const WideQuanta wall = std::min(in + out - bore, room);
    ring.inner2 -= static_cast<Quanta>(bore);
    ring.outer2 += static_cast<Quanta>(wall);
    rest -= bore + wall;
  }
  return rest;
}

/// Small removals, which flow in 64 bits, and some above 2^63 quanta, which flow in 128 bits.
RC_GTEST_PROP(Flow, AgreesIn64And128Bits, ()) {
  auto random = *samples::random_engine();
  std::vector<Ring> rings;
  for (int i = 0; i < 80; ++i) {
    const Quanta outer2 = quanta_from_radius(3500.0 + 1400.0 * samples::uniform(random));
    rings.push_back({outer2, static_cast<Quanta>(static_cast<double>(outer2) * 0.3 *
                                                 samples::uniform(random))});
  }
  const double size = *rc::gen::element(1e-12, 1e-3, 0.5, 0.99);
  const StepPlan plan =
      plan_of(*rc::gen::element(0.0, 0.5, 4.0, 1e9), *rc::gen::element(1.0, 9.0, 60.0, 1e9), 0.27);
  const auto bottom = *rc::gen::inRange<std::size_t>(0, 60);
  Contact contact = contact_on(bottom, bottom + 19);
  contact.up_offset = contact.down_offset = samples::uniform(random) - 0.5;
  ClayStack stack = ClayStack::from_rings(1.0, rings, 0, 80).value();
  ToolRemoval removal{contact, {}};
  WideQuanta rest = 0;
  for (std::size_t i = bottom; i < bottom + 20; ++i) {
    removal.removed.push_back(static_cast<Quanta>(size * samples::uniform(random) *
                                                  static_cast<double>(rings[i].volume())));
    rings[i].outer2 -= removal.removed.back();
    rest += removal.removed.back();
  }
  RC_CLASSIFY(rest >> 63 != 0, "more than 63 bits");
  const auto inside = [&] { return (rest * plan.inside_share) >> 30; };
  const bool up = *rc::gen::arbitrary<bool>();
  if (!up)
    rest = literal_flow(
        *plan.kernel, contact.down_offset, inside(), rest - inside(), bottom,
        [&](std::size_t j) { return bottom - j; }, rings);
  rest = literal_flow(
      *plan.kernel, contact.up_offset, inside(), rest - inside(), 79 - contact.top,
      [&](std::size_t j) { return contact.top + j; }, rings);
  Ledger ledger;
  press_clay<Model::paper>(plan, {&removal, 1}, up, stack, ledger);
  RC_ASSERT(std::equal(rings.begin(), rings.end(), stack.rings().begin(), stack.rings().end()));
  RC_ASSERT(ledger.outside == rest);
  RC_ASSERT(stack.recount() == stack.volume());
}

}  // namespace
}  // namespace clay
