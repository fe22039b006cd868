#include "app/bench/bare_tick.hpp"
#ifdef CLAYSTACK_EXPORT
#include "app/bench/left_out_export.hpp"
#endif
#include "app/bench/stage_cost.hpp"
#include "app/bench/timing.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clay::bench {
namespace {

// Limit for stages that must cost nothing. Counted in instructions, the ratio is 1.006: a step also
// checks whether the pot has fallen, and looks up its tick in a table.
constexpr double kNoiseRatio = 1.03;
constexpr double kInTheAirMm = -5.0;
// Standard error of a median over the interquartile range and 1/sqrt(n), of normal samples.
constexpr double kErrorOfMedian = 0.93;

/// A solid lump without any optional stage.
SceneSpec bare_scene() {
  SceneSpec scene;
  scene.force.reset();
  return scene;
}

/// The reference for a stage: without it, but with the stage on which it depends.
SceneSpec scene_without(const std::string& stage) {
  SceneSpec scene = bare_scene();
  if (stage == "friction") scene.force = ForceSpec{};
  return scene;
}

Work stroke(const SceneSpec& scene, double depth_mm) {
  return {"stroke", [scene, depth_mm] { return 1e-9 * kStrokeTicks * stroke_ns(scene, depth_mm); }};
}

Work by_hand(double depth_mm) {
  return {"by hand", [depth_mm] { return bare_stroke_s(bare_scene(), depth_mm); }};
}

/// One tool on a wall, and two tools.
Duel pinch_at_work(const Rounds& rounds) {
  SceneSpec wall = bare_scene();
  wall.lump.inner_radius_mm = wall.lump.outer_radius_mm - 12.0;
  SceneSpec pinched = wall;
  pinched.tool.mode = ToolMode::pinch;
  pinched.tool.gap_mm = 10.0;
  return duel(stroke(wall, kFirmMm), stroke(pinched, kFirmMm), rounds);
}

/// A ratio less twice the standard error of its median, so that the noise of a busy machine does
/// not count as a cost.
double least_ratio(const Spread& ratio, const Rounds& rounds) {
  return ratio.median - 2.0 * kErrorOfMedian * ratio.range() / std::sqrt(rounds.count);
}

std::vector<Cell> row_of(const std::string& stage, const std::string& where, const Duel& duel) {
  const double ns = 1e9 / kStrokeTicks;
  return {stage,
          where,
          ns * duel.a.median,
          ns * duel.b.median,
          ns * (duel.b.median - duel.a.median),
          duel.ratio.median,
          duel.ratio.range()};
}

Table empty_table() {
  return {"left_out",
          "Cost of the stages of a tick",
          {{"stage", ""},
           {"where", ""},
           {"out_ns", "ns"},
           {"in_ns", "ns"},
           {"cost_ns", "ns"},
           {"in_over_out", ""},
           {"iqr", ""}},
          {},
          "A stroke up the outside of 200 rings, 1 mm deep, or 5 mm away from it in the air. The "
          "first rows compare the scene with all stages out: with itself, which is the noise, and "
          "with a tick written by hand without them."};
}

void measure_tick_stages(Section& section, const Effort& effort) {
  Rounds rounds = rounds_of(effort);
  rounds.count = 2 * rounds.count + 1;
  const Work out = stroke(bare_scene(), kFirmMm);
  Table table = empty_table();
  effort.progress("noise");
  const Duel noise = duel(out, out, rounds), bare = duel(by_hand(kFirmMm), out, rounds);
  table.rows = {row_of("none: the same scene twice", "in contact", noise),
                row_of("none: by hand, then the engine", "in contact", bare),
                row_of("none: by hand, then the engine", "in the air",
                       duel(by_hand(kInTheAirMm), stroke(bare_scene(), kInTheAirMm), rounds))};
  for (const std::string stage : {"inner surface", "force", "friction", "stability", "pinch"}) {
    effort.progress(stage);
    const SceneSpec without = scene_without(stage);
    const SceneSpec with = with_stage(without, stage).value();
    for (const double depth : {kFirmMm, kInTheAirMm})
      table.rows.push_back(row_of(stage == "pinch" ? "pinch allowed, one hand" : stage,
                                  depth > 0.0 ? "in contact" : "in the air",
                                  duel(stroke(without, depth), stroke(with, depth), rounds)));
  }
  table.rows.push_back(row_of("pinch, both hands", "in contact", pinch_at_work(rounds)));
  section.tables.push_back(std::move(table));
  add_at_most(section, "out_over_by_hand", counted(least_ratio(bare.ratio, rounds)), kNoiseRatio,
              "ratio, less twice its standard error: the engine with all stages skipped, a tick "
              "without them");
  section.values.push_back(
      {"same_scene_twice", noise.ratio.median, noise.ratio.range(), "ratio: the noise"});
  section.summary += fmt::format(
      "With all stages skipped the engine takes {:.3f} times as long as a tick written by hand "
      "without them; the same scene measured twice gives {:.3f}. ",
      bare.ratio.median, noise.ratio.median);
}

}  // namespace

Section left_out_section(const Effort& effort) {
  Section section;
  section.id = "left_out";
  section.title = "Skipped stages";
  section.summary =
      "Cost of a stage when included and when skipped. The same work alternately with and without "
      "it. ";
  measure_tick_stages(section, effort);
#ifdef CLAYSTACK_EXPORT
  measure_export_stages(section, effort);
#endif
  return section;
}

}  // namespace clay::bench
