#pragma once
// Arbitrary values for property tests of the files, including the limits of each range.

#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::test {

inline rc::Gen<double> number_in(double low, double high) {
  constexpr auto kSteps = std::int64_t{1} << 53;
  return rc::gen::oneOf(
      rc::gen::element(low, high),
      rc::gen::map(rc::gen::inRange<std::int64_t>(0, kSteps), [=](std::int64_t step) {
        return low + static_cast<double>(step) / static_cast<double>(kSteps) * (high - low);
      }));
}

inline double below(double limit) { return std::nextafter(limit, 0.0); }

/// RapidCheck does not shrink strings to valid UTF-8, so these are made of whole characters.
inline rc::Gen<std::string> arbitrary_text() {
  return rc::gen::map(rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
                          "a", " ", "\"", "\\", "\n", "\x01", "/", "\u00fc", "\u6c34")),
                      [](const std::vector<std::string>& characters) {
                        std::string text;
                        for (const auto& character : characters) text += character;
                        return text;
                      });
}

inline ToolShapeSpec arbitrary_shape() {
  const auto size = [] { return *number_in(1e-6, 5000); };
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return SphereSpec{size()};
    case 1:
      return EllipseSpec{size(), size()};
    case 2:
      return RibSpec{size(), size()};
    default:
      break;
  }
  SampledSpec sampled;
  const auto count = *rc::gen::inRange<std::size_t>(2, 30);
  for (std::size_t i = 0; i < count; ++i) {
    sampled.t_mm.push_back(-5000.0 + 300.0 * static_cast<double>(i) + *number_in(0, 299));
    sampled.f_mm.push_back(*number_in(0, 5000));
  }
  return sampled;
}

template <class T, class Make>
std::optional<T> maybe(Make make) {
  return *rc::gen::arbitrary<bool>() ? std::optional<T>(make()) : std::nullopt;
}

inline SceneSpec arbitrary_scene() {
  SceneSpec scene;
  scene.name = *arbitrary_text();
  scene.model = *rc::gen::element(Model::conserving, Model::paper);
  scene.lump.rings = *rc::gen::inRange<std::size_t>(1, (1u << 24) + 1);
  scene.lump.ring_height_mm = *number_in(1e-3, 1e3);
  scene.lump.outer_radius_mm = *number_in(1e-3, 5000);
  scene.lump.inner_radius_mm = *number_in(0, below(scene.lump.outer_radius_mm));
  scene.lump.max_rings =
      *rc::gen::oneOf(rc::gen::just<std::size_t>(0),
                      rc::gen::inRange<std::size_t>(scene.lump.rings, (1u << 24) + 1));
  scene.lump.density_g_cm3 = *number_in(0.1, 25);
  scene.tool = {arbitrary_shape(), *rc::gen::element(ToolMode::press, ToolMode::trim),
                maybe<double>([] { return *number_in(1e-3, 1e3); })};
  if (scene.tool.gap_mm && *rc::gen::arbitrary<bool>()) scene.tool.mode = ToolMode::pinch;
  scene.removal = {*number_in(0, 1e6), *number_in(1e-3, 1e3), *number_in(1e-3, 1e3),
                   maybe<double>([] { return *number_in(0, below(1)); })};
  scene.flow = {*number_in(0, 1e9), *number_in(0, 1e9), *number_in(0, 1)};
  scene.force = maybe<ForceSpec>([] {
    return ForceSpec{*number_in(0, 1e6), *number_in(0, 10), *number_in(0, 2),
                     *rc::gen::arbitrary<bool>(), maybe<double>([] { return *number_in(0, 1e6); })};
  });
  scene.stability = maybe<StabilitySpec>([] { return StabilitySpec{*number_in(1e-300, 1e6)}; });
  scene.clay = maybe<ClaySpec>([] {
    const auto on = [] { return *rc::gen::arbitrary<bool>(); };
    return ClaySpec{on(),
                    on(),
                    on(),
                    on(),
                    on(),
                    on(),
                    *number_in(0, 1e3),
                    *number_in(0, 1e6),
                    maybe<double>([] { return *number_in(0, 200); }),
                    maybe<double>([] { return *number_in(0, 4); }),
                    maybe<double>([] { return *number_in(0.05, 2); }),
                    on(),
                    on(),
                    on(),
                    on(),
                    on(),
                    on(),
                    on(),
                    on()};
  });
  return scene;
}

inline Pot arbitrary_pot() {
  Pot pot;
  std::vector<Ring> rings(*rc::gen::inRange<std::size_t>(1, 40));
  for (Ring& ring : rings) {
    ring.outer2 = *rc::gen::inRange<Quanta>(quanta_from_radius(1e-3), quanta_from_radius(5000) + 1);
    ring.inner2 =
        *rc::gen::oneOf(rc::gen::just<Quanta>(0), rc::gen::inRange<Quanta>(0, ring.outer2));
  }
  const std::size_t count = rings.size();
  const auto wide = [] {
    return WideQuanta{*rc::gen::inRange<Quanta>(0, INT64_MAX)} *
           *rc::gen::element<Quanta>(0, 1, 1'000'000'000);
  };
  pot.stack = ClayStack::from_rings(*number_in(1e-3, 1e3), std::move(rings), wide(),
                                    *rc::gen::inRange<std::size_t>(count, kMaxRings + 1))
                  .value();
  pot.ledger.trimmed = wide();
  pot.ledger.outside = wide();
  pot.ledger.initial = pot.stack.volume() + pot.ledger.trimmed;
  pot.ledger.added = pot.ledger.outside;
  pot.model = *rc::gen::element(Model::conserving, Model::paper);
  pot.rim = {wide() - wide(), wide() - wide()};
  pot.motion = {*number_in(-1e12, 1e12), *number_in(-1e12, 1e12)};
  pot.density_g_cm3 = *number_in(0.1, 25);
  pot.thrown_with = maybe<ThrowSettings>([] { return settings_of(arbitrary_scene()); });
  pot.shaped_with = maybe<ToolSpec>([] { return arbitrary_scene().tool; });
  pot.collapse = maybe<Collapse>([&] {
    const double heading = *number_in(-3, 3);
    const auto position = [] { return *number_in(-1e6, 1e6); };
    return Collapse{*rc::gen::inRange<std::size_t>(0, count),
                    {position(), position(), position()},
                    {std::sin(heading), 0.0, std::cos(heading)},
                    *number_in(-2 * std::numbers::pi, 2 * std::numbers::pi),
                    *number_in(0, 1e4),
                    {position(), position(), position()},
                    *number_in(0, 1e4),
                    *number_in(0, 1e9),
                    *number_in(0, 1e9)};
  });
  return pot;
}

}  // namespace clay::test
