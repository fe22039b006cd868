#include "app/cli/replay.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/next_command.hpp"
#include "app/cli/pot_input.hpp"
#include "app/history/pot_scene.hpp"

#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/files.hpp"
#include "core/text.hpp"
#include "core/time_units.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

namespace clay::cli {
namespace {

double percentile(std::vector<double>& values, double fraction) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// Tracks the ledger from tick to tick without recounting the rings.
class Auditor {
 public:
  explicit Auditor(const Wheel& wheel)
      : wheel_(wheel), initial_(static_cast<double>(wheel.ledger().initial)) {}

  void look(ReplayStats& stats) const {
    const double missing = -error();
    stats.max_volume_error_percent =
        std::max(stats.max_volume_error_percent, percent(std::abs(missing)));
    stats.max_missing_over_top = std::max(stats.max_missing_over_top, missing / top());
  }
  [[nodiscard]] TraceRow row(double time_s, double force_n) const {
    return {time_s, percent(error()), percent(top()), wheel_.stack().height_mm(), force_n};
  }

 private:
  [[nodiscard]] double error() const {
    return static_cast<double>(wheel_.ledger().volume_error(wheel_.stack().volume()));
  }
  [[nodiscard]] double top() const {
    return static_cast<double>(wheel_.stack().rings().back().volume());
  }
  [[nodiscard]] double percent(double quanta) const { return 100.0 * quanta / initial_; }
  const Wheel& wheel_;
  double initial_;
};

}  // namespace

ReplayStats replay(Wheel& wheel, std::span<const Pose> poses, const ReplayOptions& options) {
  using Clock = std::chrono::steady_clock;
  ReplayStats stats;
  std::vector<double> tick_ns, contact_ns;
  tick_ns.reserve(poses.size());
  contact_ns.reserve(poses.size());
  const Auditor auditor(wheel);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto before = Clock::now();
    const StepReport step = wheel.step(poses[k]);
    tick_ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - before).count());
    if ((step.flags & kContact) != 0) contact_ns.push_back(tick_ns.back());
    const double force = glm::length(step.force_n());
    stats.refused += (step.flags & kRefused) != 0;
    stats.ring_limit = stats.ring_limit || (step.flags & kRingLimit) != 0;
    stats.max_force_n = std::max(stats.max_force_n, force);
    auditor.look(stats);
    if (options.trace) options.trace(auditor.row(in_seconds(poses[k].time_us), force));
    if (options.progress) options.progress(k + 1);
  }
  stats.tick_ns_median = percentile(tick_ns, 0.5);
  stats.tick_ns_p999 = percentile(tick_ns, 0.999);
  stats.contact_ticks = contact_ns.size();
  if (contact_ns.empty()) return stats;
  stats.contact_tick_ns_median = percentile(contact_ns, 0.5);
  stats.contact_tick_ns_p999 = percentile(contact_ns, 0.999);
  return stats;
}

Result<SceneSpec> load_scene(const std::string& path) {
  static constexpr std::array kUsers = {
      NextCommand{"a pot", "claystack throw --from POT continues it"},
      NextCommand{"a session", "claystack throw SCENE --session SESSION plays it"},
      NextCommand{"a stroke script", "claystack strokes SCENE SCRIPT makes a session from it"},
      NextCommand{"a work", "claystack throw plays it"}};
  return read_file(path).and_then([&](const std::string& text) {
    return parse_scene(text, path).map_error([&](Error error) {
      return with_command(std::move(error), text, kUsers);
    });
  });
}

Result<Start> load_start(const std::string& scene_path, const std::string& pot_path,
                         const Console& console) {
  Start start{scene_path, pot_path, {}, {}};
  if (!pot_path.empty()) {
    auto pot = read_pot(pot_path, console);
    if (!pot) return tl::make_unexpected(pot.error());
    start.pot = std::move(*pot);
  }
  if (scene_path.empty()) {
    start.scene = history::scene_for(*start.pot, name_of_file(pot_path));
    return start;
  }
  auto scene = load_scene(scene_path);
  if (!scene) return tl::make_unexpected(scene.error());
  start.scene = std::move(*scene);
  const auto& kept = start.pot ? start.pot->thrown_with : std::nullopt;
  if (kept && *kept != settings_of(start.scene))
    console.warn(pot_path + ": was thrown with another tool or clay; the tool and clay of " +
                 scene_path + " are used");
  return start;
}

namespace {

/// An import chooses the height of its rings, and may make fewer than the scene permits.
std::string ring_hint(const Start& start) {
  const std::size_t most = start.scene.lump.max_rings;
  if (!start.pot || most == 0 || start.pot->stack.size() <= most) return {};
  // An import makes up to twice as many rings as the height needs, to meet the level lines.
  const double ring_mm = 2.0 * start.pot->stack.height_mm() / static_cast<double>(most);
  return fmt::format("; if the pot was imported, import --ring-height {:.2f} makes fewer rings",
                     0.01 * std::ceil(100.0 * ring_mm));
}

}  // namespace

Result<Wheel> build_wheel(const Start& start) {
  constexpr std::uint64_t kBytesPerRing = 50;  // measured; space for all rings is reserved
  const std::size_t rings = max_rings_of(start.scene.lump);
  const std::string& name = start.scene_path.empty() ? start.pot_path : start.scene_path;
  if (auto room = expect_room(fmt::format("{}: a wheel for up to {} rings", name, rings),
                              kBytesPerRing * rings);
      !room)
    return tl::make_unexpected(room.error());
  return (start.pot ? Wheel::build(start.scene, *start.pot) : Wheel::build(start.scene))
      .map_error([&](const Error& error) {
        std::string files = start.scene_path;
        if (start.pot) files.append(files.empty() ? "" : " on ").append(start.pot_path);
        return Error{error.kind, files + ": " + error.message + ring_hint(start)};
      });
}

Result<Session> load_session(const std::string& path) {
  constexpr std::size_t kUsualBytesPerPose = 20;
  return read_file(path, kMaxSessionBytes).and_then([&](const std::string& text) {
    return expect_room(path + ": reading the session",
                       text.size() / kUsualBytesPerPose * sizeof(Pose))
        .and_then([&] { return parse_session(text, path); });
  });
}

std::string session_beside(const std::string& scene_path) {
  const std::string_view ending = ".scene.json";
  std::string stem = scene_path;
  if (ends_ignoring_case(stem, ending)) stem.resize(stem.size() - ending.size());
  return stem + ".session";
}

}  // namespace clay::cli
