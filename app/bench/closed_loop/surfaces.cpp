#include "app/bench/closed_loop/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clay::closed_loop {
namespace {

class Wall final : public Surface {
 public:
  explicit Wall(const WallSpec& spec) : spec_(spec) {}

  glm::dvec3 press(std::int64_t, const glm::dvec3& reading_mm) override {
    const double force = -spec_.stiffness_n_per_mm * depth(reading_mm.x);
    return {std::clamp(force, -spec_.limit_n, spec_.limit_n), 0.0, 0.0};
  }
  [[nodiscard]] double stored_mj(const glm::dvec3& position_mm) const override {
    const double d = std::abs(depth(position_mm.x));
    // Beyond the limit the force is constant, so the energy grows linearly.
    const double full = spec_.limit_n / spec_.stiffness_n_per_mm;
    if (d > full) return spec_.limit_n * (d - 0.5 * full);
    return 0.5 * spec_.stiffness_n_per_mm * d * d;
  }
  [[nodiscard]] double stiffness_n_per_mm() const override { return spec_.stiffness_n_per_mm; }
  [[nodiscard]] double face_mm() const override { return 0.0; }

 private:
  [[nodiscard]] double depth(double x) const { return spec_.one_sided ? std::min(x, 0.0) : x; }
  WallSpec spec_;
};

constexpr double kRadiusMm = 45.0, kRibRadiusMm = 6.0, kRingMm = 0.5;
constexpr std::size_t kRings = 160;

class Clay final : public Surface {
 public:
  Clay(const PressedClay& spec, Wheel wheel) : wheel_(std::move(wheel)), spec_(spec) {}

  glm::dvec3 press(std::int64_t time_us, const glm::dvec3& reading_mm) override {
    return wheel_.step({time_us, hip_mm(reading_mm), false}).force_n();
  }
  /// The overlap energy E = sum K' h depth^2 / 2, from the stack itself.
  [[nodiscard]] double stored_mj(const glm::dvec3& position_mm) const override {
    const double reach = hip_mm(position_mm).x - kRibRadiusMm;
    double sum = 0.0;
    std::size_t rings = 0;
    for_touched([&](const Ring& ring) {
      const double depth = std::max(0.0, ring.outer_mm() - reach);
      sum += depth * depth;
      ++rings;
    });
    return 0.5 * spec_.stiffness_n_per_mm * sum / static_cast<double>(rings);
  }
  [[nodiscard]] double stiffness_n_per_mm() const override { return spec_.stiffness_n_per_mm; }
  [[nodiscard]] double face_mm() const override {
    double highest = 0.0;
    for_touched([&](const Ring& ring) { highest = std::max(highest, ring.outer_mm()); });
    return highest - kRadiusMm;
  }

 private:
  static constexpr double kMiddleMm = 0.5 * kRingMm * static_cast<double>(kRings);

  static glm::dvec3 hip_mm(const glm::dvec3& at_mm) {
    return {kRadiusMm + kRibRadiusMm + at_mm.x, kMiddleMm, 0.0};
  }
  template <class Visit>
  void for_touched(Visit visit) const {
    const double half = 0.5 * spec_.rib_height_mm;
    const auto rings = wheel_.stack().rings();
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const double t = (static_cast<double>(i) + 0.5) * kRingMm - kMiddleMm;
      if (std::abs(t) <= half) visit(rings[i]);
    }
  }

  Wheel wheel_;
  PressedClay spec_;
};

}  // namespace

std::unique_ptr<Surface> make_wall(const WallSpec& wall) { return std::make_unique<Wall>(wall); }

SceneSpec clay_scene(const PressedClay& pressed) {
  SceneSpec scene;
  scene.name = "a cylinder under a rib";
  scene.lump = {.rings = kRings,
                .ring_height_mm = kRingMm,
                .outer_radius_mm = kRadiusMm,
                .inner_radius_mm = pressed.wall_mm > 0.0 ? kRadiusMm - pressed.wall_mm : 0.0,
                .max_rings = 4 * kRings,
                .density_g_cm3 = 1.9};
  scene.tool.shape = RibSpec{pressed.rib_height_mm, kRibRadiusMm};
  scene.removal = {.rate_per_s = pressed.rate_per_s, .min_wall_mm = 1.0, .paper_fraction = {}};
  scene.force->stiffness_n_per_mm2 = pressed.stiffness_n_per_mm / pressed.rib_height_mm;
  if (pressed.rules) scene.clay = ClaySpec{};
  return scene;
}

std::unique_ptr<Surface> make_clay(const PressedClay& clay) {
  return std::make_unique<Clay>(clay, Wheel::build(clay_scene(clay)).value());
}

}  // namespace clay::closed_loop
