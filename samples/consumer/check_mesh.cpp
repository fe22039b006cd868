// check_mesh MESH: checks whether a mesh is a printable solid.
#include <claystack/core/atomic_file.hpp>
#include <claystack/export/formats.hpp>
#include <claystack/export/proof.hpp>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: check_mesh MESH\n", stderr);
    return 2;
  }
  const std::string path = argv[1];
  const auto mesh = clay::solid::mesh_format_of(path).and_then([&](auto format) {
    return clay::read_file(path).and_then(
        [&](const std::string& bytes) { return clay::solid::decode_mesh(bytes, format, path); });
  });
  const auto report = mesh.and_then(clay::solid::check_mesh);
  if (!report) {
    std::fprintf(stderr, "%s\n", report.error().message.c_str());
    return report.error().kind == clay::ErrorKind::io ? 3 : 2;
  }
  std::printf("%zu triangles, %s", report->triangles, report->sound() ? "sound" : "not sound");
  if (report->has_volume) std::printf(", %.1f cm3", report->volume_mm3 / 1000.0);
  std::printf("\n");
  for (const auto& problem : report->problems)
    std::printf("%s (%zu): %s\n", problem.what.c_str(), problem.count, problem.where.c_str());
  return report->sound() ? 0 : 1;
}
