// replay_pot SCENE SESSION [paper]: writes the pot of a scene and its session to standard output.
// The determinism test builds it with every compiler.

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstdio>
#include <string>

namespace {

using namespace clay;

Result<void> replay(const std::string& scene_path, const std::string& session_path, bool paper) {
  auto scene = read_file(scene_path).and_then([&](const std::string& text) {
    return parse_scene(text, scene_path);
  });
  if (!scene) return tl::make_unexpected(scene.error());
  const auto session = read_file(session_path).and_then([&](const std::string& text) {
    return parse_session(text, session_path);
  });
  if (!session) return tl::make_unexpected(session.error());
  if (paper) scene->model = Model::paper;
  auto wheel = Wheel::build(*scene);
  if (!wheel) return tl::make_unexpected(wheel.error());
  for (const Pose& pose : session->poses) wheel->step(pose);
  return publish("-", write_pot(wheel->pot(), PotEncoding::json));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fputs("usage: replay_pot NAME.scene.json NAME.session [paper]\n", stderr);
    return 2;
  }
  if (const auto done = replay(argv[1], argv[2], argc == 4); !done) {
    std::fprintf(stderr, "replay_pot: %s\n", done.error().message.c_str());
    return 2;
  }
  return 0;
}
