#include "app/bench/stage_cost.hpp"
#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/replay.hpp"
#include "app/cli/usage.hpp"
#ifdef CLAYSTACK_FALCON
#include "app/servo/servo_check.hpp"
#endif

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

namespace clay::cli {
namespace {

// Below 3 %, the clock's noise exceeds the cost of the stage.
constexpr double kMeasurable = 1.03;

Json line_json(const PlanLine& line, const bench::StageCost* saved) {
  Json json = {{"stage", line.stage}, {"in", line.in}, {"why", line.why}};
  if (saved) json["saved_ns"] = saved->with_ns - saved->without_ns;
  return json;
}

std::string line_text(const PlanLine& line, const bench::StageCost* saved) {
  std::string text =
      fmt::format("{:<9}{:<15}{}", line.in ? "used" : "skipped", line.stage, line.why);
  if (saved && saved->with_ns > kMeasurable * saved->without_ns)
    text += fmt::format(" ({:.0f} ns per tick with it, {:.0f} ns without)", saved->with_ns,
                        saved->without_ns);
  else if (saved)
    text += " (saves no measurable time)";
  return text;
}

struct PlanOptions {
  std::string scene;
  std::optional<double> rate_hz;  ///< of a servo; empty: no arm is checked
  double damping_ns_per_mm = 0.002;
  int delay_ticks = 1;
};

#ifdef CLAYSTACK_FALCON
/// The contact of the scene with an arm; an error if the arm cannot render it.
Result<servo::ServoContact> contact_of(const SceneSpec& scene, const StepPlan& plan,
                                       const PlanOptions& options) {
  falcon::SampledLoop loop;
  loop.rate_hz = *options.rate_hz;
  loop.damping_ns_per_mm = options.damping_ns_per_mm;
  loop.delay_ticks = options.delay_ticks;
  return servo::check_servo(scene, plan, loop).map_error([&](Error error) {
    error.message.insert(0, options.scene + ": ");
    return error;
  });
}

void print_contact(const Console& console, const servo::ServoContact& contact, double rate_hz,
                   Json& json) {
  json["servo"] = {{"contact_height_mm", contact.height_mm},
                   {"stiffness_n_per_mm", contact.stiffness_n_per_mm},
                   {"accepted_n_per_mm", contact.accepted_n_per_mm}};
  console.print(fmt::format("contact: {:.4g} N/mm, at most {:.4g} N/mm accepted at {:.6g} Hz",
                            contact.stiffness_n_per_mm, contact.accepted_n_per_mm, rate_hz));
}

void add_servo_options(CLI::App& command, PlanOptions& options) {
  CLI::Option* rate =
      command
          .add_option(
              "--rate", options.rate_hz,
              "Servo rate at which to check whether an arm can render the scene's contact [Hz]")
          ->check(in_range(10.0, 1e5));
  command.add_option("--damping", options.damping_ns_per_mm, "Damping of the arm [N s/mm]")
      ->check(in_range(0.0, 1.0))
      ->needs(rate)
      ->capture_default_str();
  command.add_option("--delay", options.delay_ticks, "Delay from a reading to its force [ticks]")
      ->check(in_whole_range(0, 8))
      ->needs(rate)
      ->capture_default_str();
}
#endif

Result<void> plan_scene(const PlanOptions& options, const Console& console) {
  const auto start = load_start(options.scene, {}, console);
  if (!start) return tl::make_unexpected(start.error());
  const auto wheel = build_wheel(*start);
  if (!wheel) return tl::make_unexpected(wheel.error());
  const SceneSpec& scene = start->scene;
#ifdef CLAYSTACK_FALCON
  std::optional<servo::ServoContact> contact;
  if (options.rate_hz) {
    const auto checked = contact_of(scene, wheel->plan(), options);
    if (!checked) return tl::make_unexpected(checked.error());
    contact = *checked;
  }
#endif

  Progress progress(console, "measuring", 0);
  Json json = {{"scene", scene.name}, {"in", Json::array()}, {"left_out", Json::array()}};
  for (const PlanLine& line : wheel->plan().lines) {
    progress.stage(line.stage);
    const auto cost = line.in ? std::nullopt : bench::cost_of(scene, line.stage);
    const bench::StageCost* saved = cost ? &*cost : nullptr;
    json[line.in ? "in" : "left_out"].push_back(line_json(line, saved));
    console.print(line_text(line, saved));
  }
  if (!bench::timed_stroke(scene, bench::kFirmMm))
    console.print(
        fmt::format("times not measured: a tick may reach {:.0f} rings, expected at most {}",
                    bench::rings_in_reach(scene), bench::kMostRingsInReach));
#ifdef CLAYSTACK_FALCON
  if (contact) print_contact(console, *contact, *options.rate_hz, json);
#endif
  if (console.json) print_json(json);
  return {};
}

}  // namespace

void add_plan_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* command = app.add_subcommand(
      "plan", "Show the stages that a scene needs, the stages it skips, and the time this saves");
  add_file(*command, "scene", options->scene, "NAME.scene.json, or - for standard input")
      ->required();
#ifdef CLAYSTACK_FALCON
  add_servo_options(*command, *options);
#endif
  command->footer(
      "\nExamples:\n  claystack plan samples/bowl.scene.json\n"
      "  claystack plan samples/bowl.scene.json --rate 1000 --damping 0.002");
  command->callback([options, &console, &exit] {
    const auto done = plan_scene(*options, console);
    exit = done ? kDone : report(done.error());
  });
}

}  // namespace clay::cli
