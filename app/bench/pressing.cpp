#include "app/bench/pressing.hpp"

#include "app/bench/timing.hpp"

#include <algorithm>
#include <cmath>

namespace clay::bench {
namespace {

constexpr double kApartMm = 126.0;  // distance between presses, beyond the reach of the flow
constexpr double kFirstDepthMm = 6.0;
constexpr double kBallMm = 12.0;
constexpr double kRibMm = 6.0;

double widest(const ToolSpec& tool) {
  const auto* const rib = std::get_if<RibSpec>(&tool.shape);
  return rib ? rib->radius_mm : kBallMm;
}

double height(const ToolSpec& tool) {
  const auto* const rib = std::get_if<RibSpec>(&tool.shape);
  return rib ? rib->height_mm : 2.0 * kBallMm;
}

/// Number of places on a lump that do not influence each other.
std::size_t places_on(const SceneSpec& scene) {
  const double lump_mm = static_cast<double>(scene.lump.rings) * scene.lump.ring_height_mm;
  return std::max<std::size_t>(1,
                               static_cast<std::size_t>(lump_mm / (kApartMm + height(scene.tool))));
}

double first_distance(const SceneSpec& scene) {
  return scene.lump.outer_radius_mm + widest(scene.tool) - kFirstDepthMm;
}

/// The position of the tool in a tick of a press, in the plane z = 0.
glm::dvec3 place_of(double first_distance_mm, double middle_mm, int tick,
                    double rise_mm = kPressMm) {
  const double part = static_cast<double>(tick) / kPressTicks;
  return {first_distance_mm - kPressMm * part, middle_mm + rise_mm * (part - 0.5), 0.0};
}

}  // namespace

SceneSpec press_scene(std::size_t rings) {
  SceneSpec scene;
  scene.lump.rings = rings;
  scene.lump.max_rings = rings + rings / 4;
  scene.lump.inner_radius_mm = 20.0;
  scene.tool.shape = SphereSpec{kBallMm};
  scene.force->friction = 0.2;
  // The clay of the paper yields as fast as the tool advances, so the tool stays in contact.
  scene.removal.paper_fraction = 2e-4;
  // High enough for the tallest lump, because only the cost of the check matters.
  scene.stability = StabilitySpec{1e6};
  return scene;
}

SceneSpec rib_scene(std::size_t touched) {
  SceneSpec scene = press_scene(800);
  scene.tool.shape = RibSpec{static_cast<double>(touched) * scene.lump.ring_height_mm, kRibMm};
  return scene;
}

LiteralScene literal_of(const SceneSpec& scene, LiteralWriting writing) {
  LiteralScene literal;
  literal.rings = scene.lump.rings;
  literal.ring_height_mm = scene.lump.ring_height_mm;
  literal.outer_radius_mm = scene.lump.outer_radius_mm;
  literal.inner_radius_mm = scene.lump.inner_radius_mm;
  if (const auto* const rib = std::get_if<RibSpec>(&scene.tool.shape))
    literal.tool = LiteralRib{rib->height_mm, rib->radius_mm};
  else if (const auto* const ball = std::get_if<SphereSpec>(&scene.tool.shape))
    literal.tool = LiteralEllipse{ball->radius_mm, ball->radius_mm};
  literal.removal_fraction =
      scene.removal.paper_fraction.value_or(scene.removal.rate_per_s / kPaperRateHz);
  literal.inside_share = scene.flow.inside_share;
  literal.sigma_mm = scene.flow.sigma_mm;
  literal.kernel_rings =
      static_cast<std::size_t>(std::lround(scene.flow.reach_mm / scene.lump.ring_height_mm));
  if (scene.force) {
    literal.stiffness_n_per_mm = scene.force->stiffness_n_per_mm2 * scene.lump.ring_height_mm;
    literal.friction = scene.force->friction;
  }
  literal.density_g_cm3 = scene.lump.density_g_cm3;
  if (scene.stability)  // kPa / g = 1e-3 N/mm^2 / g
    literal.max_stress_kg_per_mm2 = scene.stability->max_stress_kpa * 1e-3 / kStandardGravity;
  literal.writing = writing;
  return literal;
}

Presser::Presser(const SceneSpec& scene, double rise_mm)
    : scene_(scene),
      places_(rise_mm > kPressMm ? 1 : places_on(scene)),
      first_distance_mm_(first_distance(scene)),
      rise_mm_(rise_mm) {
  place_ = places_;
}

void Presser::next_place() {
  if (++place_ < places_) return;
  place_ = 0;
  time_us_ = 0;
  wheel_.emplace(Wheel::build(scene_).value());
}

Pose Presser::pose(double middle_mm, int tick) const {
  Pose pose;
  pose.time_us = time_us_ + 1000 * tick;
  pose.position_mm = place_of(first_distance_mm_, middle_mm, tick, rise_mm_);
  return pose;
}

double Presser::press() {
  next_place();
  const double per_place = static_cast<double>(scene_.lump.rings) / static_cast<double>(places_);
  const double middle_mm =
      scene_.lump.ring_height_mm * per_place * (static_cast<double>(place_) + 0.5);
  time_us_ += 1000;
  wheel_->step(pose(middle_mm, 0));
  std::uint64_t touched = 0;
  const double seconds = work_seconds_of([&] {
    for (int tick = 1; tick <= kPressTicks; ++tick)
      touched += wheel_->step(pose(middle_mm, tick)).rings_touched;
  });
  time_us_ += 1000 * kPressTicks;
  touched_ = static_cast<double>(touched) / kPressTicks;
  return seconds;
}

double Presser::jump() {
  // Deeper each time, to keep contact.
  if (!wheel_ || ++jumps_ == kPressTicks) {
    wheel_.emplace(Wheel::build(scene_).value());
    jumps_ = 0;
  }
  const double margin_mm = scene_.lump.ring_height_mm * 50.0;
  wheel_->step(pose(wheel_->stack().height_mm() - margin_mm, jumps_));
  time_us_ += 1000;
  const Pose foot = pose(margin_mm, jumps_);
  return seconds_of([&] { wheel_->step(foot); });
}

LiteralPresser::LiteralPresser(const SceneSpec& scene, LiteralWriting writing, int ticks)
    : scene_(literal_of(scene, writing)),
      first_distance_mm_(first_distance(scene)),
      ticks_(ticks) {}

double LiteralPresser::press() {
  LiteralPaper paper(scene_);
  // The first ring of the paper is centred at y = 0, that of the engine at h/2.
  const double middle_mm = scene_.ring_height_mm * (0.5 * static_cast<double>(scene_.rings) - 0.5);
  paper.step(place_of(first_distance_mm_, middle_mm, 0));
  std::uint64_t touched = 0;
  const double seconds = work_seconds_of([&] {
    for (int tick = 1; tick <= ticks_; ++tick)
      touched += paper.step(place_of(first_distance_mm_, middle_mm, tick)).rings_touched;
  });
  touched_ = static_cast<double>(touched) / ticks_;
  return seconds;
}

}  // namespace clay::bench
