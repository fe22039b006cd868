#include "app/servo/servo_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace clay::servo {
namespace {

/// The maximum number of rings whose middles lie within the tool's reach: one more than the number
/// of steps between them.
double most_rings_touched(const SceneSpec& scene, const Tool& tool) {
  const double rings = std::floor((tool.high() - tool.low()) / scene.lump.ring_height_mm) + 1.0;
  return std::min(rings, static_cast<double>(max_rings_of(scene.lump)));
}

std::string rounded_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  return fmt::format("{:.6g}", std::floor(value / unit) * unit);
}

Error refusal(const SceneSpec& scene, const ServoContact& contact, const falcon::SampledLoop& loop,
              const falcon::StiffnessTooHigh& why, double highest_rate_hz) {
  const bool per_ring = scene.model == Model::paper && scene.force->paper_stiffness_n_per_mm;
  const double found =
      per_ring ? *scene.force->paper_stiffness_n_per_mm : scene.force->stiffness_n_per_mm2;
  const char* setting = per_ring ? "force.paper_stiffness_n_per_mm" : "force.stiffness_n_per_mm2";
  const double highest = found * (why.highest_n_per_mm / why.found_n_per_mm);
  if (highest <= 0.0)
    return {
        ErrorKind::bad_input,
        fmt::format("{}: an arm without damping renders no contact, found {:.6g}", setting, found)};
  std::string message = fmt::format(
      "{}: expected at most {} for a contact of {:.4g} mm and an arm of {:.4g} N s/mm at {:.6g} "
      "Hz, "
      "found {:.6g}",
      setting, rounded_down(highest), contact.height_mm, loop.damping_ns_per_mm, loop.rate_hz,
      found);
  const double lowest_rate_hz = std::ceil(why.lowest_rate_hz * (1.0 - 1e-12));
  if (lowest_rate_hz <= highest_rate_hz)
    message += fmt::format("; or a rate of at least {:.0f} Hz", lowest_rate_hz);
  return {ErrorKind::bad_input, std::move(message)};
}

}  // namespace

falcon::SampledLoop loop_of(const LiveSettings& settings) noexcept {
  falcon::SampledLoop loop = settings.arm;
  loop.rate_hz = std::min(loop.rate_hz, settings.rate_hz);
  return loop;
}

falcon::SampledLoop with_delay_of(const falcon::DeviceInfo& device,
                                  falcon::SampledLoop loop) noexcept {
  // A servo waits one and a half periods for an answer. A later answer counts for a following tick.
  const double ticks = 1e-6 * static_cast<double>(device.answer_us) * loop.rate_hz;
  const double late = std::clamp(std::ceil(ticks - 0.5), 0.0, 1.0 * falcon::kMostDelayTicks);
  loop.delay_ticks = std::max(loop.delay_ticks, static_cast<int>(late));
  return loop;
}

Result<ServoContact> servo_contact(const SceneSpec& scene, const StepPlan& plan,
                                   const falcon::SampledLoop& loop, double stiffness_gain) {
  if (const auto checked = check(loop); !checked)
    return tl::make_unexpected(error_of(checked.error()));
  const double rings = most_rings_touched(scene, plan.tool);
  ServoContact contact;
  contact.height_mm = rings * scene.lump.ring_height_mm;
  contact.accepted_n_per_mm = accepted_stiffness(loop);
  const double tools = (plan.stages & kPinch) ? 2.0 : 1.0;
  if (scene.force)
    contact.stiffness_n_per_mm = stiffness_gain * tools * plan.force.stiffness_n_per_mm * rings;
  return contact;
}

Result<ServoContact> check_servo(const SceneSpec& scene, const StepPlan& plan,
                                 const falcon::SampledLoop& loop, double stiffness_gain,
                                 double highest_rate_hz) {
  const auto contact = servo_contact(scene, plan, loop, stiffness_gain);
  if (!contact || !scene.force) return contact;
  if (const auto soft = check_stiffness(loop, contact->stiffness_n_per_mm); !soft)
    return tl::make_unexpected(refusal(scene, *contact, loop, soft.error(), highest_rate_hz));
  return contact;
}

double soften(SceneSpec& scene, const ServoContact& contact) {
  if (!scene.force || contact.stiffness_n_per_mm <= contact.accepted_n_per_mm) return 1.0;
  // Slightly less, so that rounding does not put it above the limit.
  const double part = (1.0 - 1e-12) * contact.accepted_n_per_mm / contact.stiffness_n_per_mm;
  scene.force->stiffness_n_per_mm2 *= part;
  if (scene.force->paper_stiffness_n_per_mm) *scene.force->paper_stiffness_n_per_mm *= part;
  return part;
}

Pot with_force_of_scene(Pot pot, const ThrowSettings& softened,
                        const std::optional<ForceSpec>& force) {
  if (pot.thrown_with == softened) pot.thrown_with->force = force;
  return pot;
}

}  // namespace clay::servo
