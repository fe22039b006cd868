#include "app/cli/commands.hpp"
#ifdef CLAYSTACK_FALCON
#include "app/cli/live_throw.hpp"
#endif
#include "app/cli/output_files.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/throw_replay.hpp"
#include "app/cli/throw_work.hpp"
#include "app/cli/usage.hpp"

#include "core/text.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace clay::cli {
namespace {

struct ThrowOptions {
  ReplayJob replay;             ///< a throw by hand, and of a work, use some of its files
  bool session_beside = false;  ///< the session was not named
  std::optional<std::size_t> at;
  bool list = false;
#ifdef CLAYSTACK_FALCON
  LiveOptions live;
  std::vector<const CLI::Option*> live_only;  ///< without effect if no device is given
#endif
};

bool exists(const std::string& path) {
  std::error_code none;
  return std::filesystem::exists(path, none);
}

bool is_work(const std::string& path) { return ends_ignoring_case(path, ".work"); }

Result<void> throw_work_file(const ThrowOptions& options, const Console& console) {
  const ReplayJob& replay = options.replay;
  bool other = !replay.session.empty() || !replay.from.empty() || !replay.model.empty() ||
               !replay.trace.empty() || !replay.error_plot.empty();
#ifdef CLAYSTACK_FALCON
  other = other || !options.live.device.empty();
#endif
  if (other)
    return failure(ErrorKind::bad_input,
                   replay.scene +
                       ": expected only --at, --list and -o with a work, which holds "
                       "scenes, poses and its first pot");
  if (auto named = check_pot_name(replay.pot); !named) return named;
  if (auto free = check_outputs({{replay.pot}}, {replay.scene}, console); !free) return free;
  return throw_work({replay.scene, replay.pot, options.at, options.list}, console);
}

#ifdef CLAYSTACK_FALCON
Result<void> throw_by_hand(const ThrowOptions& options, const Console& console) {
  const ReplayJob& replay = options.replay;
  const LiveOptions& live = options.live;
  if (!replay.trace.empty() || !replay.error_plot.empty())
    return failure(ErrorKind::bad_input,
                   "--trace and --error-plot describe a replay: record with --record, then replay");
  if (live.device != "simulated" && !options.session_beside && !replay.session.empty())
    return tl::make_unexpected(no_effect_without("--session", "--device simulated"));
  if (auto named = check_pot_name(replay.pot); !named) return named;
  // The session beside the scene is read by the simulated arm only; a recording may get its name.
  const bool reads_beside = live.device == "simulated" && exists(replay.session);
  const std::string session =
      options.session_beside && !reads_beside ? std::string() : replay.session;
  if (auto free =
          check_outputs({{replay.pot}, {live.record, {".session"}}},
                        {replay.scene, session, replay.from, live.falcon.firmware_path}, console);
      !free)
    return free;
  return throw_live({replay.scene, replay.session, replay.pot, replay.model, replay.from}, live,
                    console);
}
#endif

/// Refuses options without effect.
Result<void> check_effects(const ThrowOptions& options) {
  const ReplayJob& replay = options.replay;
#ifdef CLAYSTACK_FALCON
  if (options.live.device.empty())
    for (const CLI::Option* option : options.live_only)
      if (option->count() > 0)
        return tl::make_unexpected(no_effect_without(option->get_name(), "--device"));
#endif
  if (replay.scene.empty() && replay.from.empty())
    return failure(ErrorKind::bad_input,
                   "expected a scene, a work, or a pot to start from (--from), found none");
  if ((options.at || options.list) && !is_work(replay.scene))
    return failure(ErrorKind::bad_input,
                   "--at and --list: expected NAME.work, found " +
                       (replay.scene.empty() ? "no file, only --from" : replay.scene));
  return {};
}

Result<void> throw_pot(const ThrowOptions& options, const Console& console) {
  if (auto effects = check_effects(options); !effects) return effects;
  if (is_work(options.replay.scene)) return throw_work_file(options, console);
#ifdef CLAYSTACK_FALCON
  if (!options.live.device.empty()) return throw_by_hand(options, console);
#endif
  if (options.session_beside && ends_ignoring_case(options.replay.scene, ".scene.json") &&
      exists(options.replay.scene) && !exists(options.replay.session))
    return failure(ErrorKind::io, options.replay.session + ": expected the session of " +
                                      options.replay.scene +
                                      " beside it, found none; -s NAME.session plays another one");
  return throw_replay(options.replay, console);
}

void add_replay_options(CLI::App& command, ThrowOptions& options) {
  add_file(command, "scene", options.replay.scene,
           "NAME.scene.json, or - for standard input; or NAME.work. Not needed with --from: "
           "the pot remembers its tool and clay");
  begin_group(command, "Replay");
  add_file(command, "-s,--session", options.replay.session,
           "Poses to play (default: NAME.session beside the scene)");
  add_file(
      command, "-o,--output", options.replay.pot,
      "Pot to write: .pot.json, or .pot.cbor (compact); or - for .pot.json on standard output");
  add_file(command, "--from", options.replay.from,
           "Pot to start from, instead of the scene's lump: " + std::string(kPotInputs) +
               ", or - for standard input");
  command.add_option("--at", options.at, "Node of the work (default: the current one)")
      ->check(in_whole_range(0, UINT32_MAX));
  command.add_flag("--list", options.list, "List the strokes of a work, including undone ones");
  command
      .add_option("--model", options.replay.model,
                  "Model to use instead of the scene's: conserving or paper")
      ->check(one_of({"conserving", "paper"}));
  add_file(
      command, "--trace", options.replay.trace,
      "CSV file with one row per tick: time [s], volume error [% of all clay], the clay of the top "
      "ring [% of all clay] (the bound of the paper), height [mm], force [N]");
  add_file(command, "--error-plot", options.replay.error_plot,
           "SVG plot of the volume error over time, for both models");
}

#ifdef CLAYSTACK_FALCON
/// Notes which options have no effect without --device.
void add_device_options(CLI::App& command, ThrowOptions& options) {
  const auto others = static_cast<std::ptrdiff_t>(command.get_options().size());
  add_live_options(command, options.live);
  const auto all = command.get_options();
  options.live_only.assign(all.begin() + others, all.end());
  std::erase(options.live_only, command.get_option("--device"));
}
#endif

}  // namespace

void add_throw_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<ThrowOptions>();
  CLI::App* command = app.add_subcommand(
      "throw", "Replay a session on a scene, or throw by hand, and write the pot");
  add_replay_options(*command, *options);
#ifdef CLAYSTACK_FALCON
  add_device_options(*command, *options);
#endif
  command->footer(
      "\nExamples:\n"
      "  claystack throw samples/vase.scene.json -o vase.pot.json\n"
      "  claystack throw samples/vase.scene.json --device auto --record mine.session -o "
      "mine.pot.json\n"
      "  claystack throw samples/vase.scene.json -s mine.session -o again.pot.json\n"
      "  claystack throw --from vase.pot.json -s mine.session -o higher.pot.json\n"
      "  claystack throw samples/vase.scene.json --model paper --json\n"
      "  claystack throw samples/vase.scene.json --error-plot vase-error.svg\n"
      "  claystack throw samples/mouse.work --list\n"
      "  claystack throw samples/mouse.work --at 3 -o early.pot.json");
  command->callback([options, &console, &exit] {
    if (options->replay.session.empty() && !options->replay.scene.empty() &&
        options->replay.scene != "-" && !is_work(options->replay.scene)) {
      options->replay.session = session_beside(options->replay.scene);
      options->session_beside = true;
    }
    const auto done = throw_pot(*options, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::cli
