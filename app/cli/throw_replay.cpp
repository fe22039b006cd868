#include "app/cli/throw_replay.hpp"

#include "app/cli/clay_summary.hpp"
#include "app/cli/error_plot.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/session_check.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

Json summary(const ReplayStats& stats, const Session& session, const Pot& pot) {
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
  json.update(clay_json(pot));
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
Result<Outputs> open_outputs(const ReplayJob& job) {
  Outputs outputs;
  for (const auto& [path, file] :
       {std::pair(&job.pot, &outputs.pot), std::pair(&job.trace, &outputs.trace),
        std::pair(&job.error_plot, &outputs.error_plot)}) {
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
Result<void> check_names(const ReplayJob& job, const Console& console) {
  if (job.session.empty())
    return failure(ErrorKind::bad_input,
                   (job.scene.empty() ? "a pot without a scene" : "a scene from standard input") +
                       std::string(": expected --session with the poses to play"));
  if (!job.from.empty() && !job.error_plot.empty())
    return failure(ErrorKind::bad_input,
                   "--error-plot: expected no --from, because the plot needs both models, and a "
                   "pot can be continued only with its own model");
  if (auto named = check_pot_name(job.pot); !named) return named;
  return check_outputs({{job.pot}, {job.trace, {".csv"}}, {job.error_plot, {".svg"}}},
                       {job.scene, job.session, job.from}, console);
}

void warn(const Console& console, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) console.warn(warning);
}

/// The inputs of a replay.
struct Inputs {
  SceneSpec scene;
  Session session;
  Wheel wheel;
};

Result<Inputs> read_inputs(const ReplayJob& job, const Console& console) {
  Progress progress(console, "throwing", 0);
  progress.stage("reading");
  auto start = load_start(job.scene, job.from, console);
  if (!start) return tl::make_unexpected(start.error());
  SceneSpec& scene = start->scene;
  auto session = load_session(job.session);
  if (!session) return tl::make_unexpected(session.error());
  const ReplayFiles files{job.session, job.scene, job.from};
  if (auto gaps = check_gaps(*session, scene, files); !gaps)
    return tl::make_unexpected(gaps.error());
  warn(console, session_warnings(*session, scene, files, !job.model.empty()));
  if (!job.model.empty()) scene.model = job.model == "paper" ? Model::paper : Model::conserving;
  auto wheel = build_wheel(*start);
  if (!wheel) return tl::make_unexpected(wheel.error());
  return Inputs{std::move(scene), std::move(*session), std::move(*wheel)};
}

void print_replay(const ReplayJob& job, const Json& json, const Console& console) {
  if (console.json) print_json(json);
  print_result(console, json);
  for (const auto& [kind, path] :
       {std::pair("pot", &job.pot), {"trace", &job.trace}, {"error plot", &job.error_plot}})
    if (!path->empty()) console.print(fmt::format("{}: {}", kind, *path));
  if (job.pot.empty()) console.print(kPotNotWritten);
}

}  // namespace

Result<void> throw_replay(const ReplayJob& job, Console console) {
  if (auto names = check_names(job, console); !names) return names;
  for (const std::string& output : {job.pot, job.trace, job.error_plot})
    if (output == "-") console.quiet = true;
  auto inputs = read_inputs(job, console);
  if (!inputs) return tl::make_unexpected(inputs.error());
  auto& [scene, session, wheel] = *inputs;
  const PotEncoding encoding = pot_encoding_of(job.pot).value_or(PotEncoding::json);
  if (auto room = expect_room_after_throw(wheel, encoding, job.pot); !room) return room;
  auto outputs = open_outputs(job);
  if (!outputs) return tl::make_unexpected(outputs.error());

  std::optional<TraceWriter> trace;
  if (outputs->trace) trace.emplace(*outputs->trace);
  const ReplayStats stats = play(wheel, session, trace ? &*trace : nullptr, console);
  warn(console, replay_warnings(stats.refused, stats.ring_limit));

  const Pot pot = wheel.pot();
  auto written = write_outputs(*outputs, pot, encoding, trace, scene, session, console);
  if (written) print_replay(job, summary(stats, session, pot), console);
  return written;
}

}  // namespace clay::cli
