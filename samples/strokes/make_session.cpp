// make_session SCENE STROKES OUT: plays a stroke script on a scene and writes the session.

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "samples/strokes/strokes.hpp"

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace clay;

constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 24;

Result<void> make_session(const std::string& scene_path, const std::string& strokes_path,
                          const std::string& out_path) {
  const auto scene = read_file(scene_path).and_then([&](const std::string& text) {
    return parse_scene(text, scene_path);
  });
  if (!scene) return tl::make_unexpected(scene.error());
  const auto script =
      read_file(strokes_path, kMaxScriptBytes).and_then([&](const std::string& text) {
        return samples::parse_strokes(text, strokes_path);
      });
  if (!script) return tl::make_unexpected(script.error());
  return samples::play(*script, *scene).and_then([&](std::vector<Pose>&& poses) {
    return publish(out_path,
                   write_session({scene->name, hash_of(*scene), std::move(poses), false}));
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: make_session SCENE.scene.json STROKES.strokes.json OUT.session\n", stderr);
    return 2;
  }
  if (const auto done = make_session(argv[1], argv[2], argv[3]); !done) {
    std::fprintf(stderr, "make_session: %s\n", done.error().message.c_str());
    return done.error().kind == ErrorKind::io ? 3 : 2;
  }
  return 0;
}
