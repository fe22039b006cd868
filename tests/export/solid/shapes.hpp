#pragma once
// Stacks and meshes shared by several tests, made from geometry alone.

#include "claystack/engine/clay.hpp"
#include "claystack/export/proof.hpp"
#include "claystack/export/section.hpp"
#include "claystack/export/smoothing.hpp"
#include "claystack/export/solid.hpp"

#include <rapidcheck.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace clay::solid::shapes {

struct Radii {
  double outer_mm = 0.0;
  double inner_mm = 0.0;
};

inline ClayStack stack_of(double ring_height_mm, const std::vector<Radii>& radii,
                          WideQuanta crown = 0) {
  std::vector<Ring> rings;
  for (const Radii& r : radii)
    rings.push_back({quanta_from_radius(r.outer_mm), quanta_from_radius(r.inner_mm)});
  return ClayStack::from_rings(ring_height_mm, std::move(rings), crown).value();
}

inline Pot pot_of(ClayStack stack) {
  Pot pot;
  pot.stack = std::move(stack);
  return pot;
}

/// Permitted rounding error of a volume [mm^3]: one or two ulp of the full cylinders, also for thin
/// walls. Relative to the clay, 1e-9 for walls above a millionth of the radius. Levelling steps
/// below `min_step_mm` may change two walls by pi H step^2 each.
inline double volume_rounding(const ClayStack& stack, double min_step_mm = 0.0) {
  double hull = 0.0;
  for (const Ring& ring : stack.rings()) hull += mm2_from_quanta(ring.outer2);
  hull *= std::numbers::pi * 2.0 * stack.ring_height_mm();
  const double levelled = 2.0 * std::numbers::pi * stack.height_mm() * min_step_mm * min_step_mm;
  return 1e-12 * stack.volume_mm3() + 1e-15 * hull + levelled;
}

/// A bellied vase, 200 mm high, with a floor and a 3 mm wall.
inline ClayStack vase(std::size_t rings) {
  std::vector<Radii> radii;
  for (std::size_t i = 0; i < rings; ++i) {
    const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(rings);
    const double outer = 50.0 + 18.0 * std::sin(6.9 * t - 0.6) - 8.0 * t;
    radii.push_back({outer, t < 0.03 ? 0.0 : outer - 3.0});
  }
  return stack_of(200.0 / static_cast<double>(rings), radii);
}

/// The section with fair walls, simplified to a tolerance.
inline Result<StackProfile> fair_section(const ClayStack& stack, double tolerance_mm) {
  SmoothingOptions options;
  options.tolerance_mm = tolerance_mm;
  return smooth_profile_of(stack, options).map([](SmoothedProfile smoothed) {
    return std::move(smoothed.section);
  });
}

/// A ball of latitude steps about (0, 0, centre_mm), outward.
inline TriangleMesh ball(double radius_mm, double centre_mm = 0.0) {
  constexpr std::size_t kSteps = 8;
  Polygon half;
  for (std::size_t i = 0; i <= kSteps; ++i) {
    const double angle = std::numbers::pi * static_cast<double>(i) / kSteps;
    const bool pole = i == 0 || i == kSteps;
    half.push_back(
        {pole ? 0.0 : radius_mm * std::sin(angle), centre_mm - radius_mm * std::cos(angle)});
  }
  return revolve({{half}}, 12);
}

inline TriangleMesh cube(double side_mm) {
  return {{{0, 0, 0},
           {side_mm, 0, 0},
           {side_mm, side_mm, 0},
           {0, side_mm, 0},
           {0, 0, side_mm},
           {side_mm, 0, side_mm},
           {side_mm, side_mm, side_mm},
           {0, side_mm, side_mm}},
          {{0, 2, 1},
           {0, 3, 2},
           {4, 5, 6},
           {4, 6, 7},
           {0, 1, 5},
           {0, 5, 4},
           {1, 2, 6},
           {1, 6, 5},
           {2, 3, 7},
           {2, 7, 6},
           {3, 0, 4},
           {3, 4, 7}}};
}

inline TriangleMesh moved(TriangleMesh mesh, const glm::dvec3& by) {
  for (glm::dvec3& p : mesh.points) p += by;
  return mesh;
}

inline TriangleMesh inverted(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

/// Random stacks of up to 12 rings on a coarse grid of radii, so that equal radii, circles of
/// contact, floors, cavities and separate pieces all occur; some with walls down to 1e-7 mm and
/// some with steps of a few quanta, as at the edge of a tool's reach.
inline rc::Gen<ClayStack> any_stack() {
  return rc::gen::exec([] {
    const auto count = *rc::gen::inRange<std::size_t>(1, 13);
    std::vector<Radii> radii;
    for (std::size_t i = 0; i < count; ++i) {
      const int inner = *rc::gen::inRange(0, 6);
      const int wall = *rc::gen::inRange(1, 5);
      const bool thin = inner > 0 && *rc::gen::inRange(0, 4) == 0;
      const double thickness = thin ? std::pow(10.0, -*rc::gen::inRange(1, 8)) : 2.0 * wall;
      radii.push_back({2.0 * inner + thickness, 2.0 * inner});
    }
    const int crown = *rc::gen::inRange(0, 3);
    ClayStack stack = stack_of(1.5, radii);
    std::vector<Ring> rings(stack.rings().begin(), stack.rings().end());
    if (*rc::gen::inRange(0, 2) == 1)
      for (Ring& ring : rings) ring.outer2 += *rc::gen::inRange(0, 1 << *rc::gen::inRange(1, 30));
    return ClayStack::from_rings(1.5, rings, rings.back().volume() * crown / WideQuanta{3}).value();
  });
}

}  // namespace clay::solid::shapes

namespace rc {
template <>
struct Arbitrary<clay::ClayStack> {
  static Gen<clay::ClayStack> arbitrary() { return clay::solid::shapes::any_stack(); }
};
}  // namespace rc

namespace clay {
/// For RapidCheck's counterexamples.
inline void showValue(const ClayStack& stack, std::ostream& out) {
  out << "h " << stack.ring_height_mm() << " crown " << to_string(stack.crown()) << " rings";
  for (const Ring& ring : stack.rings()) out << " [" << ring.outer2 << ' ' << ring.inner2 << ']';
}
}  // namespace clay
