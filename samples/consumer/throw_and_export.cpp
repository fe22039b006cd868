// Throw a pot and export it: a rib goes up the wall of a lump, and the pot becomes a proved STL.
#include <claystack/core/atomic_file.hpp>
#include <claystack/engine/wheel.hpp>
#include <claystack/export/job.hpp>

#include <cstdio>

int main(int argc, char** argv) {
  clay::SceneSpec scene;
  scene.lump = {.rings = 120, .ring_height_mm = 0.5, .outer_radius_mm = 40.0};
  auto wheel = clay::Wheel::build(scene);
  for (int tick = 1; wheel && tick <= 2000; ++tick)
    wheel->step({.time_us = 1000 * tick, .position_mm = {42.0, 10.0 + 0.02 * tick, 0.0}});
  const auto published = wheel.and_then([&](const clay::Wheel& done) -> clay::Result<void> {
    clay::solid::MemoryStore stl;
    const auto report = clay::solid::run_export(
        done.pot(), {{clay::solid::MeshFormat::stl_binary, &stl}}, {.tolerance_mm = 0.1});
    if (!report) return tl::make_unexpected(report.error());
    std::printf("%zu triangles, %.1f cm3\n", report->size.triangles,
                report->volume.solid_mm3 / 1000.0);
    return clay::publish(argc > 1 ? argv[1] : "pot.stl", stl.bytes());
  });
  if (!published) std::fprintf(stderr, "%s\n", published.error().message.c_str());
  return published ? 0 : 1;
}
