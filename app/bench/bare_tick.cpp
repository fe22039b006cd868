#include "app/bench/bare_tick.hpp"

#include "app/bench/stage_cost.hpp"
#include "app/bench/timing.hpp"
#include "engine/clay/stack_writer.hpp"
#include "engine/tick/contact.hpp"
#include "engine/tick/redistribution.hpp"

#include <algorithm>
#include <cstdint>

namespace clay::bench {
BareWheel::BareWheel(const SceneSpec& scene) : plan_(StepPlan::build(scene).value()), removals_(1) {
  const LumpSpec& lump = scene.lump;
  stack_ = ClayStack::cylinder(lump.rings, lump.ring_height_mm, lump.outer_radius_mm,
                               lump.inner_radius_mm, max_rings_of(lump))
               .value();
  StackWriter(stack_).reserve();
  ledger_.initial = stack_.volume();
  const auto touches = most_contacts(plan_.tool, lump.ring_height_mm, max_rings_of(lump));
  removals_[0].contact.rings.reserve(touches);
  removals_[0].removed.reserve(touches);
}

StepReport BareWheel::step(const Pose& pose) noexcept {
  StepReport report;
  ToolState tool = tracker_.advance(pose);
  report.flags = (tool.valid ? 0u : kRefused) | (tool.dt_clamped ? kLongStep : 0u);
  if (!tool.valid) return report;
  ToolRemoval& removal = removals_[0];
  find_contact<Model::conserving>(plan_.tool, stack_, tool.hip_mm, removal.contact, tool.moved_mm);
  const bool touches = !removal.contact.rings.empty();
  const int parts = touches || touching_ ? parts_of(tool) : 1;
  touching_ = touches;
  tool.dt_s /= parts;
  tool.moved_mm /= parts;
  for (int part = 1; part <= parts; ++part) {
    const glm::dvec3 hip = tool.hip_mm - static_cast<double>(parts - part) * tool.moved_mm;
    if (parts > 1)
      find_contact<Model::conserving>(plan_.tool, stack_, hip, removal.contact, tool.moved_mm);
    if (!removal.contact.rings.empty()) press(tool, report);
  }
  return report;
}

void BareWheel::press(const ToolState& tool, StepReport& report) noexcept {
  ToolRemoval& removal = removals_[0];
  report.flags |= kContact;
  report.rings_touched = static_cast<std::uint32_t>(removal.contact.rings.touched());
  const double half_rise = 0.5 * tool.moved_mm.y / stack_.ring_height_mm();
  removal.contact.up_offset += std::max(half_rise, 0.0);
  removal.contact.down_offset += std::max(-half_rise, 0.0);
  compute_removal<Model::conserving>(plan_.removal, stack_, tool.dt_s, removal.contact,
                                     removal.removed);
  const Flow flow =
      press_clay<Model::conserving>(plan_, removals_, tool.upward, stack_, ledger_, &rim_);
  report.flags |= (flow.grown > 0 ? kGrew : 0u) | (flow.ring_limit ? kRingLimit : 0u);
}

double bare_stroke_s(const SceneSpec& scene, double depth_mm) {
  const auto poses = stroke_poses(scene, depth_mm);
  BareWheel wheel(scene);
  return work_seconds_of([&] {
    for (const Pose& pose : poses) wheel.step(pose);
  });
}

}  // namespace clay::bench
