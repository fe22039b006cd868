// throw_and_export SCENE SESSION OUT.stl: play a session, export the pot, publish the file.
#include <claystack/core/atomic_file.hpp>
#include <claystack/engine/files.hpp>
#include <claystack/engine/wheel.hpp>
#include <claystack/export/job.hpp>

#include <cstdio>
#include <string>

namespace {

clay::Result<void> run(const std::string& scene_path, const std::string& session_path,
                       const std::string& out) {
  const auto scene = clay::read_file(scene_path).and_then([&](const std::string& text) {
    return clay::parse_scene(text, scene_path);
  });
  if (!scene) return tl::make_unexpected(scene.error());
  const auto session = clay::read_file(session_path).and_then([&](const std::string& text) {
    return clay::parse_session(text, session_path);
  });
  if (!session) return tl::make_unexpected(session.error());

  auto wheel = clay::Wheel::build(*scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  for (const clay::Pose& pose : session->poses) wheel->step(pose);

  clay::solid::MemoryStore stl;
  clay::solid::ExportOptions options;
  options.tolerance_mm = 0.05;
  const auto report =
      clay::solid::run_export(wheel->pot(), {{clay::solid::MeshFormat::stl_binary, &stl}}, options);
  if (!report) return tl::make_unexpected(report.error());
  std::printf("%.1f cm3, minimum wall %.2f mm, %zu triangles\n", report->volume.solid_mm3 / 1000.0,
              report->walls.min_wall_mm, report->size.triangles);
  return clay::publish(out, stl.bytes());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: throw_and_export SCENE SESSION OUT.stl\n", stderr);
    return 2;
  }
  const auto done = run(argv[1], argv[2], argv[3]);
  if (done) return 0;
  std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return done.error().kind == clay::ErrorKind::io ? 3 : 2;
}
