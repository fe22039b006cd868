#include "app/cli/live_stage.hpp"

#include "app/cli/device_choice.hpp"
#include "app/cli/pot_copy.hpp"
#include "app/cli/replay.hpp"
#include "app/servo/scene_hand.hpp"
#include "app/servo/servo_check.hpp"
#include "claystack/engine/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace clay::cli {
namespace {

/// Softens a scene that is too stiff for the arm, or refuses it.
Result<void> fit_stiffness(SceneSpec& scene, const LiveOptions& options, const Console& console) {
  if (!options.soften) {
    const auto checked = servo::check_stiffness(scene, options.settings);
    if (checked) return {};
    return failure(checked.error().kind,
                   checked.error().message + "; without --no-soften it is lowered for the throw");
  }
  const auto part = servo::soften(scene, options.settings);
  if (!part) return tl::make_unexpected(part.error());
  if (*part < 1.0)
    console.warn(fmt::format(
        "force.stiffness_n_per_mm2 is lowered to {:.3g} for this throw, {:.0f}% of the scene's: "
        "the arm cannot render more at {:g} Hz (--no-soften refuses such a scene)",
        scene.force->stiffness_n_per_mm2, 100.0 * *part, servo::loop_of(options.settings).rate_hz));
  return {};
}

/// The simulated hand's stroke: sets duration and workspace unless given.
Result<void> take_up_stroke(const LiveJob& job, LiveOptions& options, LiveStage& stage) {
  std::error_code ignored;
  if (options.device != "simulated") return {};
  if (job.stroke_path.empty() || !std::filesystem::exists(job.stroke_path, ignored)) {
    if (options.settings.seconds > 0.0) return {};
    // The simulated hand would never move.
    return failure(ErrorKind::bad_input,
                   "--device simulated: expected a session for its hand (-s NAME.session, or one "
                   "beside the scene) or --seconds, found neither");
  }
  auto session = load_session(job.stroke_path);
  if (!session) return tl::make_unexpected(session.error());
  stage.stroke = std::move(session->poses);
  servo::LiveSettings& settings = options.settings;
  if (settings.seconds == 0.0) settings.seconds = servo::seconds_of(stage.stroke);
  if (settings.mapping == servo::MappingSettings{})
    settings.mapping = servo::fitted(settings.mapping, stage.stroke, servo::kSimulatedReachMm);
  return {};
}

PotEncoding encoding_of(const LiveJob& job) {
  return pot_encoding_of(job.pot_path).value_or(PotEncoding::json);
}

/// Only writing detects a full disk: tries to write the current pot, if that changes no existing
/// file.
Result<AtomicFile> open_pot_file(const LiveJob& job, const Pot& pot) {
  {
    auto trial = AtomicFile::create(job.pot_path);
    if (!trial || !trial->rereadable()) return trial;
    if (auto fits = trial->write(written_pot(job, pot)); !fits)
      return tl::make_unexpected(fits.error());
  }
  return AtomicFile::create(job.pot_path);
}

/// Before throwing: an unwritable output found later would lose the pot.
Result<void> open_pot(const LiveJob& job, LiveStage& stage) {
  if (job.pot_path.empty()) return {};
  const std::size_t rings = stage.wheel->stack().size();
  if (auto room = expect_room_to_write(rings, encoding_of(job), job.pot_path); !room) return room;
  auto file = open_pot_file(job, stage.wheel->pot());
  if (!file) return tl::make_unexpected(file.error());
  stage.pot_file.emplace(std::move(*file));
  return {};
}

Result<void> open_device(LiveOptions& options, const servo::Mapping& mapping, LiveStage& stage) {
  auto device =
      open_chosen(options.device, options.falcon, servo::simulated_potter(stage.stroke, mapping));
  if (!device) return tl::make_unexpected(device.error());
  stage.device = std::move(*device);
  options.settings.buttons =
      stage.device->info().can_push ? servo::kFalconButtons : servo::kTwoButtons;
  return {};
}

/// Scene and wheel; the scene's stiffness fits the arm.
Result<void> put_on_wheel(const LiveJob& job, const LiveOptions& options, const Console& console,
                          LiveStage& stage) {
  auto start = load_start(job.scene_path, job.from_path, console);
  if (!start) return tl::make_unexpected(start.error());
  stage.scene = start->scene;
  if (!job.model.empty())
    stage.scene.model = job.model == "paper" ? Model::paper : Model::conserving;
  stage.scene_hash = hash_of(stage.scene);
  const auto named = [&](const Error& error) {
    const std::string& file = job.scene_path.empty() ? job.from_path : job.scene_path;
    return failure(error.kind, file + ": " + error.message);
  };
  stage.force = stage.scene.force;
  if (auto fits = fit_stiffness(stage.scene, options, console); !fits) return named(fits.error());
  start->scene = stage.scene;
  auto wheel = build_wheel(*start);
  if (!wheel) return tl::make_unexpected(wheel.error());
  stage.wheel.emplace(std::move(*wheel));
  return {};
}

}  // namespace

std::string written_pot(const LiveJob& job, const Pot& pot) {
  return write_pot(pot, encoding_of(job));
}

Result<void> build(const LiveJob& job, LiveOptions& options, const Console& console,
                   LiveStage& stage) {
  falcon::GuardSettings& guard = options.settings.guard;
  guard.hot_force_n = std::min(guard.hot_force_n, 0.8 * guard.force_limit_n);
  if (auto taken = take_up_stroke(job, options, stage); !taken) return taken;
  if (const auto checked = check(options.settings); !checked)
    return tl::make_unexpected(by_option(checked.error()));
  const auto mapping = servo::Mapping::build(options.settings.mapping);
  if (!mapping) return tl::make_unexpected(by_option(mapping.error()));
  if (auto put = put_on_wheel(job, options, console, stage); !put) return put;
  if (auto opened = open_pot(job, stage); !opened) return opened;
  if (auto opened = open_device(options, *mapping, stage); !opened) return opened;
  auto live = servo::LiveThrow::build({.wheel = *stage.wheel,
                                       .device = *stage.device,
                                       .scene = stage.scene,
                                       .session_path = options.record,
                                       .scene_hash = stage.scene_hash},
                                      options.settings);
  if (!live) return tl::make_unexpected(live.error());
  stage.live.emplace(std::move(*live));
  return {};
}

}  // namespace clay::cli
