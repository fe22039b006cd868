#include "app/cli/commands.hpp"

#include "app/cli/json_output.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/usage.hpp"
#include "app/strokes/strokes.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/text.hpp"
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

/// "strokes[2]", with its name if it has one.
std::string title_of(const strokes::StrokeScript& script, std::size_t stroke) {
  const std::string& name = script.strokes[stroke].name;
  return fmt::format("strokes[{}]{}", stroke, name.empty() ? "" : " (" + shown(name) + ")");
}

/// One line, object and warnings for each stroke.
Json report_strokes(const strokes::StrokeScript& script, const strokes::Played& played,
                    const std::string& path, const Console& console) {
  Json list = Json::array();
  for (std::size_t k = 0; k < played.strokes.size(); ++k) {
    const strokes::PlayedStroke& stroke = played.strokes[k];
    const std::string title = title_of(script, k);
    console.print(fmt::format(
        "  {}: {:.1f} s; the pot is {:.1f} mm high{}", title, stroke.seconds, stroke.height_mm,
        stroke.thinnest_mm ? fmt::format(", thinnest wall {:.2f} mm", *stroke.thinnest_mm) : ""));
    for (const std::string& warning : stroke.warnings)
      console.warn(fmt::format("{}: {}: {}", path, title, warning));
    list.push_back({{"name", script.strokes[k].name},
                    {"seconds", stroke.seconds},
                    {"height_mm", stroke.height_mm},
                    {"thinnest_mm", stroke.thinnest_mm ? Json(*stroke.thinnest_mm) : Json()},
                    {"warnings", stroke.warnings}});
  }
  return list;
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
  const auto script =
      read_file(options.script, kMaxScriptBytes).and_then([&](const std::string& text) {
        return strokes::parse_strokes(text, options.script);
      });
  if (!script) return tl::make_unexpected(script.error());
  auto played = strokes::play(*script, scene, std::move(*wheel));
  if (!played) return failure(played.error().kind, options.script + ": " + played.error().message);
  const std::size_t count = played->poses.size();
  const double seconds = count > 0 ? in_seconds(played->poses.back().time_us) : 0.0;
  const Session session{scene.name, hash_of(scene), std::move(played->poses), false};
  if (auto done = publish(options.session, write_session(session)); !done) return done;
  progress.clear();
  console.print(fmt::format("session: {}, {:.1f} s, {} poses", options.session, seconds, count));
  const Json strokes = report_strokes(*script, *played, options.script, console);
  if (console.json)
    print_json({{"session", options.session},
                {"seconds", seconds},
                {"poses", count},
                {"strokes", strokes}});
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
