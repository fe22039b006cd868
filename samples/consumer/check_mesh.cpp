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
  if (!mesh) {
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    return mesh.error().kind == clay::ErrorKind::io ? 3 : 2;
  }
  const clay::solid::MeshReport report = clay::solid::check_mesh(*mesh);
  std::printf("%zu triangles, %.1f cm3, %s\n", report.triangles, report.volume_mm3 / 1000.0,
              report.sound() ? "sound" : "not sound");
  for (const auto& problem : report.problems)
    std::printf("%s (%zu): %s\n", problem.what.c_str(), problem.count, problem.where.c_str());
  return report.sound() ? 0 : 1;
}
