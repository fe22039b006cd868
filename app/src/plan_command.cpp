#include "commands.hpp"
#include "replay.hpp"
#include "stage_cost.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

namespace clay::app {
namespace {

// Below 3 % the clock's noise is louder than the stage.
constexpr double kMeasurable = 1.03;

Json line_json(const PlanLine& line, const StageCost* saved) {
  Json json = {{"stage", line.stage}, {"in", line.in}, {"why", line.why}};
  if (saved) json["saved_ns"] = saved->with_ns - saved->without_ns;
  return json;
}

std::string line_text(const PlanLine& line, const StageCost* saved) {
  std::string text = fmt::format("{:<4}{:<15}{}", line.in ? "in" : "out", line.stage, line.why);
  if (saved && saved->with_ns > kMeasurable * saved->without_ns)
    text += fmt::format(" (with it {:.0f} ns a tick, without {:.0f})", saved->with_ns,
                        saved->without_ns);
  else if (saved)
    text += " (nothing measurable saved)";
  return text;
}

Result<void> plan_scene(const std::string& path, const Console& console) {
  const auto scene = load_scene(path);
  if (!scene) return tl::make_unexpected(scene.error());
  const auto wheel = Wheel::build(*scene);
  if (!wheel) return failure(wheel.error().kind, path + ": " + wheel.error().message);

  Json json = {{"scene", scene->name}, {"in", Json::array()}, {"left_out", Json::array()}};
  for (const PlanLine& line : wheel->plan().lines) {
    const auto cost = line.in ? std::nullopt : cost_of(*scene, line.stage);
    const StageCost* saved = cost ? &*cost : nullptr;
    json[line.in ? "in" : "left_out"].push_back(line_json(line, saved));
    console.say(line_text(line, saved));
  }
  if (console.json) console.print(json);
  return {};
}

}  // namespace

void add_plan_command(CLI::App& app, Console& console, int& exit) {
  auto scene = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("plan", "Say what a scene needs, what is left out, and what that saves");
  command->add_option("scene", *scene, "NAME.scene.json, or - for standard input")->required();
  command->footer("\nExample:\n  claystack plan samples/bowl.scene.json");
  command->callback([scene, &console, &exit] {
    const auto done = plan_scene(*scene, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::app
