#include "app/cli/clay_summary.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/error_plot.hpp"
#ifdef CLAYSTACK_FALCON
#include "app/cli/live_throw.hpp"
#endif
#include "app/cli/output_files.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/pot_input.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/throw_work.hpp"
#include "app/cli/usage.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/text.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace clay::cli {
namespace {

struct ThrowOptions {
  std::string scene;
  std::string session;
  std::string pot;
  std::string trace;
  std::string error_plot;
  std::string model;  ///< empty: the model of the scene
  std::string from;   ///< pot to continue; empty: the scene's lump
  std::optional<std::size_t> at;
  bool list = false;
#ifdef CLAYSTACK_FALCON
  LiveOptions live;
  std::vector<const CLI::Option*> live_only;  ///< without effect if no device is given
#endif
};

Json summary(const Wheel& wheel, const ReplayStats& stats, const Session& session, const Pot& pot) {
  Json json = {
      {"model", name_of(pot.model)},
      {"ticks", session.poses.size()},
      {"max_volume_error_percent", stats.max_volume_error_percent},
      {"max_missing_over_top_ring", stats.max_missing_over_top},
      {"max_force_n", stats.max_force_n},
      {"refused_ticks", stats.refused},
      {"tick_ns_median", stats.tick_ns_median},
      {"tick_ns_p999", stats.tick_ns_p999},
      {"contact_ticks", stats.contact_ticks},
      {"contact_tick_ns_median", stats.contact_tick_ns_median},
      {"contact_tick_ns_p999", stats.contact_tick_ns_p999},
  };
  json.update(clay_json(wheel, pot));
  return json;
}

void print_result(const Console& console, const Json& s) {
  console.detail(fmt::format("{} ticks, model {}: {} rings", s["ticks"].get<std::size_t>(),
                             s["model"].get<std::string>(), s["rings"].get<std::size_t>()));
  console.detail(fmt::format("maximum volume error during the session: {:.4g} %",
                             s["max_volume_error_percent"].get<double>()));
  console.detail(
      fmt::format("tick: median {:.0f} ns, 99.9 % within {:.0f} ns; maximum force {:.2f} N",
                  s["tick_ns_median"].get<double>(), s["tick_ns_p999"].get<double>(),
                  s["max_force_n"].get<double>()));
  console.detail(fmt::format("ticks in contact: {}, median {:.0f} ns, 99.9 % within {:.0f} ns",
                             s["contact_ticks"].get<std::size_t>(),
                             s["contact_tick_ns_median"].get<double>(),
                             s["contact_tick_ns_p999"].get<double>()));
  print_clay(console, s);
}

/// Writes a CSV file row by row.
class TraceWriter {
 public:
  explicit TraceWriter(AtomicFile& file) : file_(file) {}
  void add(const TraceRow& r) {
    fmt::format_to(std::back_inserter(text_), "{:.6f},{:.6g},{:.6g},{:.6g},{:.6g}\n", r.time_s,
                   r.volume_error_percent, r.top_ring_percent, r.height_mm, r.force_n);
    if (text_.size() >= kBuffered) hand_on();
  }
  /// The first error of all writes.
  Result<void> finish() {
    hand_on();
    return written_;
  }

 private:
  static constexpr std::size_t kBuffered = std::size_t{1} << 16;
  void hand_on() {
    if (written_) written_ = file_.write(text_);
    text_.clear();
  }

  AtomicFile& file_;
  Result<void> written_;
  std::string text_ = "time_s,volume_error_percent,top_ring_percent,height_mm,force_n\n";
};

void warn_of_oddities(const Console& console, const Session& session, const SceneSpec& scene,
                      const ThrowOptions& options) {
  if (session.torn)
    console.warn(
        fmt::format("{}: the last line is cut off; its poses are not played", options.session));
  if (session.scene_hash != 0 && session.scene_hash != hash_of(scene))
    console.warn(
        fmt::format("{}: recorded on another scene ({}); the pot may differ from the recorded one",
                    options.session, session.scene_name));
}

/// In advance, because the wheel would refuse such poses one by one.
Result<void> check_gaps(const Session& session, const SceneSpec& scene,
                        const ThrowOptions& options) {
  if (scene.tool.gap_mm) return {};
  const auto pose = std::find_if(session.poses.begin(), session.poses.end(),
                                 [](const Pose& p) { return p.gap_mm > 0.0; });
  if (pose == session.poses.end()) return {};
  const bool of_pot = options.scene.empty();
  return failure(
      ErrorKind::bad_input,
      fmt::format(
          "{}: expected one tool throughout, because {} no tool.gap_mm, found a gap of {:.6g} "
          "mm at {:.3f} s{}",
          options.session, of_pot ? "the pot " + options.from + " holds" : "the scene sets",
          pose->gap_mm, 1e-6 * static_cast<double>(pose->time_us),
          of_pot ? "; name the scene of the session before --from" : ""));
}

ReplayStats play(Wheel& wheel, const Session& session, TraceWriter* trace, const Console& console) {
  Progress progress(console, "throwing", session.poses.size());
  ReplayOptions options;
  if (trace != nullptr) options.trace = [trace](const TraceRow& row) { trace->add(row); };
  options.progress = [&progress](std::size_t done) {
    if (done % 256 == 0) progress.update(done);
  };
  return replay(wheel, session.poses, options);
}

/// Plays the session with both models, for the plot that compares them.
Result<std::string> error_plot(const SceneSpec& scene, const Session& session,
                               const Console& console) {
  std::vector<ErrorCurve> curves;
  Progress progress(console, "throwing for the plot", 2 * session.poses.size());
  std::size_t ticks = 0;
  for (const Model model : {Model::paper, Model::conserving}) {
    SceneSpec variant = scene;
    variant.model = model;
    auto wheel = Wheel::build(variant);
    if (!wheel) return tl::make_unexpected(wheel.error());
    ErrorRows rows(session.poses.size());
    replay(*wheel, session.poses,
           {.trace = [&](const TraceRow& row) { rows.add(row); },
            .progress =
                [&](std::size_t) {
                  if (++ticks % 256 == 0) progress.update(ticks);
                }});
    curves.push_back({name_of(model), rows.take()});
  }
  return error_plot_svg(scene.name, curves);
}

/// The output files of a replay; only requested ones are opened.
struct Outputs {
  std::optional<AtomicFile> pot, trace, error_plot;
};

/// Before playing, so that unwritable outputs are reported at once.
Result<Outputs> open_outputs(const ThrowOptions& options) {
  Outputs outputs;
  for (const auto& [path, file] :
       {std::pair(&options.pot, &outputs.pot), std::pair(&options.trace, &outputs.trace),
        std::pair(&options.error_plot, &outputs.error_plot)}) {
    if (path->empty()) continue;
    auto opened = AtomicFile::create(*path);
    if (!opened) return tl::make_unexpected(opened.error());
    file->emplace(std::move(*opened));
  }
  return outputs;
}

/// Before playing; the pot may grow by some rings.
Result<void> expect_room_after_throw(const Wheel& wheel, PotEncoding encoding,
                                     const std::string& path) {
  return path.empty() ? Result<void>() : expect_room_to_write(wheel.stack().size(), encoding, path);
}

/// Writes all requested files, or none.
Result<void> write_outputs(Outputs& outputs, const Pot& pot, PotEncoding encoding,
                           std::optional<TraceWriter>& trace, const SceneSpec& scene,
                           const Session& session, const Console& console) {
  Progress progress(console, "throwing", 0);
  progress.stage("writing");
  if (outputs.pot)
    if (auto written = outputs.pot->write(write_pot(pot, encoding)); !written) return written;
  if (trace)
    if (auto written = trace->finish(); !written) return written;
  if (outputs.error_plot) {
    auto plot = error_plot(scene, session, console);
    if (!plot) return tl::make_unexpected(plot.error());
    if (auto written = outputs.error_plot->write(*plot); !written) return written;
  }
  std::vector<AtomicFile*> files;
  for (auto* file : {&outputs.pot, &outputs.trace, &outputs.error_plot})
    if (*file) files.push_back(&**file);
  return commit_all(files);
}

/// Refuses invalid names before anything is read or played.
Result<void> check_names(const ThrowOptions& options, const Console& console) {
  if (options.session.empty())
    return failure(
        ErrorKind::bad_input,
        (options.scene.empty() ? "a pot without a scene" : "a scene from standard input") +
            std::string(": expected --session with the poses to play"));
  if (auto named = check_pot_name(options.pot); !named) return named;
  return check_outputs({{options.pot}, {options.trace, {".csv"}}, {options.error_plot, {".svg"}}},
                       {options.scene, options.session, options.from}, console);
}

void warn_of(const ReplayStats& stats, const Console& console) {
  if (stats.refused > 0)
    console.warn(fmt::format("{} invalid poses were not played", stats.refused));
  if (stats.ring_limit) console.warn("there is clay above the top ring: increase lump.max_rings");
}

/// The inputs of a replay.
struct Inputs {
  SceneSpec scene;
  Session session;
  Wheel wheel;
};

Result<Inputs> read_inputs(const ThrowOptions& options, const Console& console) {
  Progress progress(console, "throwing", 0);
  progress.stage("reading");
  auto start = load_start(options.scene, options.from, console);
  if (!start) return tl::make_unexpected(start.error());
  SceneSpec& scene = start->scene;
  auto session = load_session(options.session);
  if (!session) return tl::make_unexpected(session.error());
  if (auto gaps = check_gaps(*session, scene, options); !gaps)
    return tl::make_unexpected(gaps.error());
  warn_of_oddities(console, *session, scene, options);
  if (!options.model.empty())
    scene.model = options.model == "paper" ? Model::paper : Model::conserving;
  auto wheel = build_wheel(*start);
  if (!wheel) return tl::make_unexpected(wheel.error());
  return Inputs{std::move(scene), std::move(*session), std::move(*wheel)};
}

void print_replay(const ThrowOptions& options, const Json& json, const Console& console) {
  if (console.json) print_json(json);
  print_result(console, json);
  for (const auto& [kind, path] : {std::pair("pot", &options.pot),
                                   {"trace", &options.trace},
                                   {"error plot", &options.error_plot}})
    if (!path->empty()) console.print(fmt::format("{}: {}", kind, *path));
  if (options.pot.empty()) console.print(kPotNotWritten);
}

Result<void> replay_pot(const ThrowOptions& options, Console console) {
  if (auto names = check_names(options, console); !names) return names;
  for (const std::string& output : {options.pot, options.trace, options.error_plot})
    if (output == "-") console.quiet = true;
  auto inputs = read_inputs(options, console);
  if (!inputs) return tl::make_unexpected(inputs.error());
  auto& [scene, session, wheel] = *inputs;
  const PotEncoding encoding = pot_encoding_of(options.pot).value_or(PotEncoding::json);
  if (auto room = expect_room_after_throw(wheel, encoding, options.pot); !room) return room;
  auto outputs = open_outputs(options);
  if (!outputs) return tl::make_unexpected(outputs.error());

  std::optional<TraceWriter> trace;
  if (outputs->trace) trace.emplace(*outputs->trace);
  const ReplayStats stats = play(wheel, session, trace ? &*trace : nullptr, console);
  warn_of(stats, console);

  const Pot pot = wheel.pot();
  auto written = write_outputs(*outputs, pot, encoding, trace, scene, session, console);
  if (written) print_replay(options, summary(wheel, stats, session, pot), console);
  return written;
}

Result<void> throw_work_file(const ThrowOptions& options, const Console& console) {
  bool other = !options.session.empty() || !options.from.empty() || !options.model.empty() ||
               !options.trace.empty() || !options.error_plot.empty();
#ifdef CLAYSTACK_FALCON
  other = other || !options.live.device.empty();
#endif
  if (other)
    return failure(ErrorKind::bad_input,
                   options.scene +
                       ": expected only --at, --list and -o with a work, which "
                       "holds scenes, poses and its first pot");
  if (auto named = check_pot_name(options.pot); !named) return named;
  if (auto free = check_outputs({{options.pot}}, {options.scene}, console); !free) return free;
  return throw_work({options.scene, options.pot, options.at, options.list}, console);
}

/// Refuses options of a device when none is given.
Result<void> check_effects(const ThrowOptions& options) {
#ifdef CLAYSTACK_FALCON
  if (!options.live.device.empty()) return {};
  for (const CLI::Option* option : options.live_only)
    if (option->count() > 0)
      return tl::make_unexpected(no_effect_without(option->get_name(), "--device"));
#else
  static_cast<void>(options);
#endif
  return {};
}

Result<void> throw_pot(const ThrowOptions& options, const Console& console) {
  if (auto effects = check_effects(options); !effects) return effects;
  if (options.scene.empty() && options.from.empty())
    return failure(ErrorKind::bad_input,
                   "expected a scene, a work, or a pot to start from (--from), found none");
  if (ends_ignoring_case(options.scene, ".work")) return throw_work_file(options, console);
  if (options.at || options.list)
    return failure(ErrorKind::bad_input,
                   "--at and --list: expected NAME.work, found " +
                       (options.scene.empty() ? "no file, only --from" : options.scene));
  if (!options.from.empty() && !options.error_plot.empty())
    return failure(ErrorKind::bad_input,
                   "--error-plot: expected no --from, because the plot needs both models, and a "
                   "pot can be continued only with its own model");
#ifdef CLAYSTACK_FALCON
  if (!options.live.device.empty()) {
    if (!options.trace.empty() || !options.error_plot.empty())
      return failure(
          ErrorKind::bad_input,
          "--trace and --error-plot describe a replay: record with --record, then replay");
    if (auto named = check_pot_name(options.pot); !named) return named;
    if (auto free = check_outputs(
            {{options.pot}, {options.live.record, {".session"}}},
            {options.scene, options.session, options.from, options.live.falcon.firmware_path},
            console);
        !free)
      return free;
    return throw_live({options.scene, options.session, options.pot, options.model, options.from},
                      options.live, console);
  }
#endif
  return replay_pot(options, console);
}

void add_replay_options(CLI::App& command, ThrowOptions& options) {
  command.add_option(
      "scene", options.scene,
      "NAME.scene.json, or - for standard input; or NAME.work. Not needed with --from: "
      "the pot remembers its tool and clay");
  begin_group(command, "Replay");
  command.add_option("-s,--session", options.session,
                     "Poses to play (default: NAME.session beside the scene)");
  command.add_option("-o,--output", options.pot, "Pot to write: .pot.json, or .pot.cbor (compact)");
  command.add_option("--from", options.from,
                     "Pot to start from, instead of the scene's lump: " + std::string(kPotInputs));
  command.add_option("--at", options.at, "Node of the work (default: the current one)")
      ->check(in_whole_range(0, UINT32_MAX));
  command.add_flag("--list", options.list, "List the strokes of a work, including undone ones");
  command
      .add_option("--model", options.model,
                  "Model to use instead of the scene's: conserving or paper")
      ->check(one_of({"conserving", "paper"}));
  command.add_option(
      "--trace", options.trace,
      "CSV file with one row per tick: time [s], volume error [% of all clay], the clay of the top "
      "ring [% of all clay] (the bound of the paper), height [mm], force [N]");
  command.add_option("--error-plot", options.error_plot,
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
    if (options->session.empty() && !options->scene.empty() && options->scene != "-" &&
        !ends_ignoring_case(options->scene, ".work"))
      options->session = session_beside(options->scene);
    const auto done = throw_pot(*options, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::cli
