// Checks whether a mesh is a printable solid.
#include <claystack/core/atomic_file.hpp>
#include <claystack/export/formats.hpp>
#include <claystack/export/proof.hpp>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : "pot.stl";
  const auto report = clay::solid::mesh_format_of(path)
                          .and_then([&](clay::solid::MeshFormat format) {
                            return clay::read_file(path).and_then([&](const std::string& bytes) {
                              return clay::solid::decode_mesh(bytes, format, path);
                            });
                          })
                          .map([](const auto& mesh) { return clay::solid::check_mesh(mesh); });
  if (!report) std::fprintf(stderr, "%s\n", report.error().message.c_str());
  if (!report) return 2;
  std::printf("%zu triangles, %s\n", report->triangles, report->sound() ? "sound" : "not sound");
  return report->sound() ? 0 : 1;
}
