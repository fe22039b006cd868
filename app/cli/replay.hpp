#pragma once
#include "app/cli/console.hpp"

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"
#include "claystack/engine/wheel.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clay::cli {

/// One tick of a replay, for traces and plots.
struct TraceRow {
  double time_s = 0.0;
  double volume_error_percent = 0.0;  ///< of the initial volume; negative: clay is missing
  double top_ring_percent = 0.0;      ///< Delta v_N, the paper's bound, in the same unit
  double height_mm = 0.0;
  double force_n = 0.0;
};

struct ReplayStats {
  std::size_t refused = 0;  ///< invalid poses
  bool ring_limit = false;
  double max_volume_error_percent = 0.0;
  double max_missing_over_top =
      0.0;  ///< largest ratio of missing clay to Delta v_N; the paper's bound is 1
  double max_force_n = 0.0;
  double tick_ns_median = 0.0;
  double tick_ns_p999 = 0.0;
  std::size_t contact_ticks = 0;  ///< in which the tool touched the clay
  double contact_tick_ns_median = 0.0;
  double contact_tick_ns_p999 = 0.0;
};

struct ReplayOptions {
  std::function<void(const TraceRow&)> trace;  ///< called with one row a tick
  std::function<void(std::size_t)> progress;   ///< called with the ticks done
};

/// Plays every pose on the wheel, and checks the ledger after each.
ReplayStats replay(Wheel& wheel, std::span<const Pose> poses, const ReplayOptions& options);

/// Reads a scene; "-" is standard input.
Result<SceneSpec> load_scene(const std::string& path);
/// Start of a throw: a scene with its lump, or a pot on the scene's wheel.
struct Start {
  std::string scene_path;  ///< empty: the pot remembers the tool and the clay
  std::string pot_path;    ///< empty: the lump
  SceneSpec scene;
  std::optional<Pot> pot;
};
/// Reads both, of which one may be empty. A scene takes precedence over the settings that the pot
/// remembers, with a warning.
Result<Start> load_start(const std::string& scene_path, const std::string& pot_path,
                         const Console& console);
/// Errors name the files.
Result<Wheel> build_wheel(const Start& start);
/// Reads a session, by default the one beside the scene: NAME.scene.json -> NAME.session.
Result<Session> load_session(const std::string& path);
[[nodiscard]] std::string session_beside(const std::string& scene_path);

}  // namespace clay::cli
