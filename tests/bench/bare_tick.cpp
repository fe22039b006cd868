#include "bare_tick.hpp"

#include "contact.hpp"
#include "redistribution.hpp"
#include "stack_writer.hpp"
#include "stage_cost.hpp"
#include "timing.hpp"

namespace clay::bench {

BareWheel::BareWheel(const SceneSpec& scene) : plan_(StepPlan::build(scene).value()), bites_(1) {
  const LumpSpec& lump = scene.lump;
  stack_ = ClayStack::cylinder(lump.rings, lump.ring_height_mm, lump.outer_radius_mm,
                               lump.inner_radius_mm, max_rings_of(lump))
               .value();
  StackWriter(stack_).reserve();
  ledger_.initial = stack_.volume();
  const auto touches = most_contacts(plan_.tool, lump.ring_height_mm, max_rings_of(lump));
  bites_[0].contact.rings.reserve(touches);
  bites_[0].removed.reserve(touches);
}

void BareWheel::step(const Pose& pose) noexcept {
  const ToolState tool = tracker_.advance(pose);
  if (!tool.valid) return;
  Bite& bite = bites_[0];
  find_contact(plan_.tool, stack_, tool.hip_mm, bite.contact);
  if (bite.contact.rings.empty()) return;
  compute_removal<Model::conserving>(plan_.removal, stack_, bite.contact, tool.dt_s, bite.removed);
  press_clay<Model::conserving>(plan_, bites_, tool.upward, stack_, ledger_);
}

double bare_stroke_s(const SceneSpec& scene, double depth_mm) {
  const auto poses = app::stroke_poses(scene, depth_mm);
  BareWheel wheel(scene);
  return work_seconds_of([&] {
    for (const Pose& pose : poses) wheel.step(pose);
  });
}

}  // namespace clay::bench
