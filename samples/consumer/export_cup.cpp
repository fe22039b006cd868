// Makes a mesh in memory from rings: a cup of 60 mm with walls of 4 mm.

#include <claystack/engine/clay.hpp>
#include <claystack/export/job.hpp>

#include <cstdio>
#include <vector>

int main() {
  const clay::Ring floor{clay::quanta_from_radius(30.0), 0};
  const clay::Ring wall{clay::quanta_from_radius(30.0), clay::quanta_from_radius(26.0)};
  std::vector<clay::Ring> rings(60, wall);
  rings[0] = rings[1] = rings[2] = rings[3] = rings[4] = floor;

  clay::Pot pot;
  pot.stack = clay::ClayStack::from_rings(1.0, rings, 0).value();
  clay::solid::MemoryStore stl;
  const auto report =
      clay::solid::run_export(pot, {{clay::solid::MeshFormat::stl_binary, &stl}}, {});
  if (!report) {
    std::fprintf(stderr, "%s\n", report.error().message.c_str());
    return 1;
  }
  std::printf("%zu triangles, %.3f cm3, %zu bytes of STL\n", report->triangles,
              report->volume_mm3 / 1000.0, stl.bytes().size());
  return 0;
}
