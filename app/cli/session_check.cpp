#include "app/cli/session_check.hpp"

#include "core/time_units.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clay::cli {
namespace {

/// Compares without the name, which for a pot is that of its file, and with --model also without
/// the model.
bool recorded_on(const Session& session, SceneSpec scene, bool any_model) {
  scene.name = session.scene_name;
  if (session.scene_hash == 0 || session.scene_hash == hash_of(scene)) return true;
  scene.model = scene.model == Model::paper ? Model::conserving : Model::paper;
  return any_model && session.scene_hash == hash_of(scene);
}

}  // namespace

std::vector<std::string> session_warnings(const Session& session, const SceneSpec& scene,
                                          const ReplayFiles& files, bool any_model) {
  std::vector<std::string> warnings;
  if (session.torn)
    warnings.push_back(
        fmt::format("{}: the last line is cut off; its poses are not played", files.session));
  if (!recorded_on(session, scene, any_model))
    warnings.push_back(
        fmt::format("{}: recorded on another scene ({}); the pot may differ from the recorded one",
                    files.session, session.scene_name));
  return warnings;
}

Result<void> check_gaps(const Session& session, const SceneSpec& scene, const ReplayFiles& files) {
  if (scene.tool.gap_mm) return {};
  const auto pose =
      std::ranges::find_if(session.poses, [](const Pose& p) { return p.gap_mm > 0.0; });
  if (pose == session.poses.end()) return {};
  const bool of_pot = files.scene.empty();
  return failure(
      ErrorKind::bad_input,
      fmt::format(
          "{}: expected one tool throughout, because {} no tool.gap_mm, found a gap of {:.6g} "
          "mm at {:.3f} s{}",
          files.session, of_pot ? "the pot " + files.from + " holds" : "the scene sets",
          pose->gap_mm, in_seconds(pose->time_us),
          of_pot ? "; name the scene of the session before --from" : ""));
}

std::vector<std::string> replay_warnings(std::size_t refused, bool ring_limit) {
  std::vector<std::string> warnings;
  if (refused > 0) warnings.push_back(fmt::format("{} invalid poses were not played", refused));
  if (ring_limit)
    warnings.emplace_back(
        "there is clay above the top ring, and the pot grows no higher: increase lump.max_rings in "
        "the scene, or max_rings in the pot file");
  return warnings;
}

}  // namespace clay::cli
