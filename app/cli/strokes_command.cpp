#include "app/cli/commands.hpp"

#include "app/cli/json_output.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/usage.hpp"
#include "app/strokes/strokes.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/time_units.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 24;

struct StrokesOptions {
  std::string scene, script, from, session;
};

Result<std::vector<Pose>> poses_of(const std::string& path, const SceneSpec& scene, Wheel wheel) {
  return read_file(path, kMaxScriptBytes)
      .and_then([&](const std::string& text) { return strokes::parse_strokes(text, path); })
      .and_then([&](const strokes::StrokeScript& script) {
        return strokes::play(script, scene, std::move(wheel)).map_error([&](const Error& error) {
          return Error{error.kind, path + ": " + error.message};
        });
      });
}

/// With --from the scene may be absent, and the first argument is then the script.
void complete_arguments(StrokesOptions& options) {
  if (options.script.empty() && !options.from.empty()) std::swap(options.script, options.scene);
  if (options.scene.empty() && options.from.empty()) throw CLI::RequiredError("scene");
  if (options.script.empty()) throw CLI::RequiredError("script");
}

Result<void> make_session(const StrokesOptions& options, Console console) {
  if (options.session == "-") console.quiet = true;
  if (auto free = check_outputs({{options.session, {".session"}}},
                                {options.scene, options.script, options.from}, console);
      !free)
    return free;
  Progress progress(console, "strokes", 0);
  progress.stage("playing");
  const auto start = load_start(options.scene, options.from, console);
  if (!start) return tl::make_unexpected(start.error());
  auto wheel = build_wheel(*start);
  if (!wheel) return tl::make_unexpected(wheel.error());
  const SceneSpec& scene = start->scene;
  auto poses = poses_of(options.script, scene, std::move(*wheel));
  if (!poses) return tl::make_unexpected(poses.error());
  const std::size_t count = poses->size();
  const double seconds = count > 0 ? in_seconds(poses->back().time_us) : 0.0;
  const Session session{scene.name, hash_of(scene), std::move(*poses), false};
  if (auto done = publish(options.session, write_session(session)); !done) return done;
  console.print(fmt::format("session: {}, {:.1f} s, {} poses", options.session, seconds, count));
  if (console.json)
    print_json({{"session", options.session}, {"seconds", seconds}, {"poses", count}});
  return {};
}

}  // namespace

void add_strokes_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<StrokesOptions>();
  CLI::App* command = app.add_subcommand(
      "strokes", "Make a session from a stroke script, with a simulated hand on the scene's wheel");
  add_file(
      *command, "scene", options->scene,
      "NAME.scene.json, or - for standard input; not needed with --from: the pot remembers its "
      "tool and clay");
  add_file(*command, "script", options->script, "NAME.strokes.json; docs/files.md");
  add_file(*command, "-o,--output", options->session,
           "Session file to write, NAME.session, or - for standard output")
      ->required();
  add_file(*command, "--from", options->from,
           "Pot to start from, instead of the scene's lump: " + std::string(kPotInputs) +
               ", or - for standard input");
  command->footer(
      "\nExamples:\n"
      "  claystack strokes samples/vase.scene.json samples/strokes/vase.strokes.json -o "
      "my.session\n"
      "  claystack throw samples/vase.scene.json -s my.session -o my.pot.json\n"
      "  claystack strokes samples/strokes/lip.strokes.json --from my.pot.json -o lip.session\n"
      "  claystack throw --from my.pot.json -s lip.session -o round.pot.json");
  command->callback([options, &console, &exit] {
    complete_arguments(*options);
    const auto done = make_session(*options, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::cli
