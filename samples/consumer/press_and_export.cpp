#include <claystack/engine/wheel.hpp>
#include <claystack/export/job.hpp>
#include <cstdio>

int main() {
  clay::Wheel wheel = clay::Wheel::build(clay::SceneSpec{}).value();  // a lump of 90 mm diameter
  // For 1 s, a ball of 10 mm radius presses 3 mm deep and rises.
  for (int ms = 1; ms <= 1000; ++ms) wheel.step({1000 * ms, {52.0, 20.0 + 0.1 * ms, 0.0}});
  clay::solid::MemoryStore stl;
  const auto report =
      clay::solid::run_export(wheel.pot(), {{clay::solid::MeshFormat::stl_binary, &stl}}, {})
          .value();
  std::printf("%zu triangles, %zu bytes\n", report.size.triangles, stl.bytes().size());
}
