#include "app/bench/pressing.hpp"
#include "app/bench/timing.hpp"
#include "app/history/pot_scene.hpp"
#include "engine/clay/lanes.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <utility>

namespace clay::bench {
namespace {

constexpr double kMinSpeedUp = 5.0;   // over the paper as printed
constexpr double kMaxGrowth = 1.5;    // from 200 rings to a million
constexpr double kMaxRules = 2.6;     // of a tick with all clay rules, over one without
constexpr double kMaxTwoLanes = 2.0;  // of such a tick without AVX2, over one with
constexpr int kFewTicks = 20;         // enough for ticks of 100 us

/// A presser with its functions for time and contact.
struct Contender {
  std::string name, about;
  std::function<double()> press;    ///< seconds
  std::function<double()> touched;  ///< rings, of the mean tick
  double ticks = kPressTicks;
};

Contender engine_at(std::string name, std::string about, const SceneSpec& scene,
                    double rise_mm = kPressMm) {
  const auto presser = std::make_shared<Presser>(scene, rise_mm);
  return {std::move(name), std::move(about), [presser] { return presser->press(); },
          [presser] { return presser->rings_touched(); }};
}

/// With rings processed two at a time, as on a machine without AVX2.
Contender in_two_lanes(Contender contender) {
  contender.press = [press = std::move(contender.press)] {
    const TwoLanesScope lanes;
    return press();
  };
  return contender;
}

Contender literal_at(std::string name, std::string about, const SceneSpec& scene,
                     LiteralWriting writing, int ticks = kPressTicks) {
  const auto presser = std::make_shared<LiteralPresser>(scene, writing, ticks);
  return {std::move(name), std::move(about), [presser] { return presser->press(); },
          [presser] { return presser->rings_touched(); }, static_cast<double>(ticks)};
}

/// [ns] per tick, one sample per round.
std::vector<Samples> tick_ns(const std::vector<Contender>& contenders, const Rounds& rounds) {
  std::vector<Work> works;
  for (const Contender& c : contenders) works.push_back({c.name, c.press});
  auto samples = time_rounds(works, rounds);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (double& sample : samples[i]) sample *= 1e9 / contenders[i].ticks;
  return samples;
}

SceneSpec rules_scene(std::size_t rings) {
  SceneSpec scene = press_scene(rings);
  scene.clay = ClaySpec{};
  return scene;
}

std::vector<Contender> sizes() {
  using enum LiteralWriting;
  return {
      engine_at("n200_ns", "a tick of 200 rings, all stages", press_scene(200)),
      engine_at("n10000_ns", "of 10 000 rings", press_scene(10'000)),
      engine_at("n1000000_ns", "of a million rings", press_scene(1'000'000)),
      literal_at("literal_n200_ns", "the paper as printed: stress summed again for each ring",
                 press_scene(200), as_printed),
      literal_at("literal_eased_n200_ns", "the paper with a running sum for the stress",
                 press_scene(200), eased),
      literal_at("literal_eased_n10000_ns", "the same of 10 000 rings", press_scene(10'000), eased,
                 kFewTicks),
      in_two_lanes(engine_at("two_lanes_n200_ns", "of 200 rings, two at a time instead of four",
                             press_scene(200))),
      engine_at("rules_n200_ns", "of 200 rings, with all clay rules", rules_scene(200)),
      engine_at("rules_n1000000_ns", "of a million rings, with all clay rules",
                rules_scene(1'000'000)),
      in_two_lanes(engine_at("two_lanes_rules_n200_ns",
                             "of 200 rings, with all clay rules, as on a machine without AVX2",
                             rules_scene(200))),
  };
}

Value value_of(const std::string& name, const Spread& spread, const std::string& about) {
  return {name, spread.median, spread.range(), about};
}

void measure_sizes(Section& section, const Effort& effort) {
  effort.progress("number of rings");
  const auto contenders = sizes();
  const auto ns = tick_ns(contenders, rounds_of(effort));
  for (std::size_t i = 0; i < contenders.size(); ++i)
    section.values.push_back(
        value_of(contenders[i].name, spread_of(ns[i]),
                 fmt::format("{}; {:.0f} touched", contenders[i].about, contenders[i].touched())));
  const Spread smallest = spread_of(ns[0]), rules_growth = ratio_of(ns[8], ns[7]),
               rules_cost = ratio_of(ns[7], ns[0]), speed_up = ratio_of(ns[3], ns[0]),
               growth = ratio_of(ns[2], ns[0]);
  add_at_most(section, "rules_over_none_n200", rules_cost, kMaxRules, "ratio");
  add_at_most(section, "rules_n1000000_over_n200", rules_growth, kMaxGrowth, "ratio");
  add_at_least(section, "literal_over_engine_n200", speed_up, kMinSpeedUp, "ratio");
  section.values.push_back(value_of("literal_eased_over_engine_n200", ratio_of(ns[4], ns[0]),
                                    "ratio; the paper's equations, implemented efficiently"));
  add_at_most(section, "n1000000_over_n200", growth, kMaxGrowth, "ratio");
  section.values.push_back(value_of("two_lanes_over_four", ratio_of(ns[6], ns[0]),
                                    "ratio; 1 on a machine without AVX2"));
  add_at_most(section, "two_lanes_rules_over_four", ratio_of(ns[9], ns[7]), kMaxTwoLanes, "ratio");
  section.summary += fmt::format(
      "With 200 rings a tick takes {:.0f} ns, {:.1f} times less than the paper as printed; with a "
      "million rings, {:.2f} times as long; with all clay rules, {:.2f} times as long.",
      smallest.median, speed_up.median, growth.median, rules_cost.median);
}

/// The press on 200 rings with the given rules.
Contender with_rules(std::string name, const ClaySpec& rules) {
  SceneSpec scene = press_scene(200);
  scene.clay = rules;
  return engine_at(std::move(name), "", scene);
}

/// All six rules but one.
Contender all_but(const std::string& name, bool ClaySpec::*rule) {
  ClaySpec rules;
  rules.*rule = false;
  if (rule == &ClaySpec::shift) rules.hoop = false;
  return with_rules("all but " + name, rules);
}

/// One rule of the six.
Contender alone(const std::string& name, bool ClaySpec::*rule) {
  ClaySpec rules;
  rules.lift = rules.shift = rules.rim = rules.hoop = rules.heave = rules.smear = false;
  rules.*rule = true;
  rules.hoop = rules.shift;
  return with_rules(name + " alone", rules);
}

/// The cost of each clay rule. The stroke is the same, but not the clay: a wall that does not move
/// leaves more to heave.
void measure_rules(Section& section, const Effort& effort) {
  effort.progress("clay rules");
  Table table{"tick_rules",
              "Duration of a tick with clay rules",
              {{"rules", ""}, {"engine_ns", "ns"}, {"iqr_ns", "ns"}, {"over_none", ""}},
              {},
              "200 rings, one tool, so lift does not act. Shift includes hoop, which is a part of "
              "it. The last row has the settings of a new work: all six rules, a minimum floor, "
              "a finger, a thin wall that yields, and a rim that sinks."};
  const std::vector<Contender> contenders{
      engine_at("none", "", press_scene(200)), alone("rim", &ClaySpec::rim),
      alone("shift", &ClaySpec::shift),        alone("heave", &ClaySpec::heave),
      alone("smear", &ClaySpec::smear),        all_but("shift", &ClaySpec::shift),
      all_but("heave", &ClaySpec::heave),      all_but("smear", &ClaySpec::smear),
      with_rules("all six", ClaySpec{}),       with_rules("a new work", history::usual_clay())};
  const auto ns = tick_ns(contenders, rounds_of(effort));
  for (std::size_t i = 0; i < ns.size(); ++i) {
    const Spread s = spread_of(ns[i]);
    table.rows.push_back({contenders[i].name, s.median, s.range(), ratio_of(ns[i], ns[0]).median});
  }
  section.tables.push_back(std::move(table));
}

Table ribs_table() {
  return {"tick_rings",
          "Duration of a tick over the number of rings touched",
          {{"rings", ""},
           {"engine_ns", "ns"},
           {"engine_iqr_ns", "ns"},
           {"per_ring_ns", "ns"},
           {"literal_ns", "ns"},
           {"literal_iqr_ns", "ns"},
           {"literal_over_engine", ""}},
          {},
          "A vertical rib on 800 rings; the paper with a running sum for the stress."};
}

void add_point(Curve& curve, double x, const Spread& y) {
  curve.x.push_back(x);
  curve.y.push_back(y.median);
  curve.low.push_back(y.low);
  curve.high.push_back(y.high);
}

/// Ribs of all heights, compared with the paper.
void measure_ribs(Section& section, const Effort& effort) {
  effort.progress("rings touched");
  std::vector<Contender> contenders;
  for (const std::size_t rings : {1u, 3u, 10u, 30u, 100u, 300u}) {
    contenders.push_back(engine_at("engine", "", rib_scene(rings)));
    contenders.push_back(literal_at("literal", "", rib_scene(rings), LiteralWriting::eased, 200));
  }
  const auto ns = tick_ns(contenders, rounds_of(effort));
  Table table = ribs_table();
  Curve engine{"engine, conserving", {}, {}, {}, {}},
      literal{"the paper, running sum", {}, {}, {}, {}};
  for (std::size_t i = 0; i < ns.size(); i += 2) {
    const double touched = contenders[i].touched();
    const Spread engine_ns = spread_of(ns[i]), literal_ns = spread_of(ns[i + 1]);
    table.rows.push_back({touched, engine_ns.median, engine_ns.range(), engine_ns.median / touched,
                          literal_ns.median, literal_ns.range(),
                          ratio_of(ns[i + 1], ns[i]).median});
    add_point(engine, touched, engine_ns);
    add_point(literal, touched, literal_ns);
  }
  section.plots.push_back({"tick_rings_plot",
                           table.title,
                           {"rings touched", true},
                           {"time of a tick [ns]", true},
                           {engine, literal},
                           ""});
  section.tables.push_back(std::move(table));
}

/// The cost of a tick over the speed of the hand; a fast motion is played in parts.
void measure_speeds(Section& section, const Effort& effort) {
  effort.progress("speeds");
  Table table{"tick_speed",
              "Duration of a tick over the speed of the hand",
              {{"speed_mm_s", "mm/s"}, {"rings", ""}, {"engine_ns", "ns"}, {"iqr_ns", "ns"}},
              {},
              "The ball rises along 800 rings while it is pressed, at 1 kHz."};
  constexpr std::array kSpeeds{6.0, 25.0, 50.0, 100.0, 200.0, 400.0};  // mm/s, in a press of 1 s
  std::vector<Contender> contenders;
  for (const double speed : kSpeeds)
    contenders.push_back(engine_at("engine", "", press_scene(800), speed));
  const auto ns = tick_ns(contenders, rounds_of(effort));
  for (std::size_t i = 0; i < ns.size(); ++i) {
    const Spread s = spread_of(ns[i]);
    table.rows.push_back({kSpeeds[i], contenders[i].touched(), s.median, s.range()});
  }
  section.tables.push_back(std::move(table));
}

/// A jump from the top to the bottom between two poses, the most expensive tick.
void measure_jump(Section& section, const Effort& effort) {
  effort.progress("jumps");
  std::vector<Work> works;
  for (const std::size_t rings : {std::size_t{200}, std::size_t{1'000'000}}) {
    const auto presser = std::make_shared<Presser>(press_scene(rings));
    works.push_back({fmt::format("jump_n{}_ns", rings), [presser] { return presser->jump(); }});
  }
  Rounds rounds = rounds_of(effort);
  rounds.least_s = 1e-5;
  const auto seconds = time_rounds(works, rounds);
  for (std::size_t i = 0; i < works.size(); ++i) {
    const Spread s = spread_of(seconds[i]);
    section.values.push_back(
        {works[i].name, 1e9 * s.median, 1e9 * s.range(),
         "wall-clock time of one tick, from the top of the stack to its foot"});
  }
}

}  // namespace

Section tick_section(const Effort& effort) {
  Section section;
  section.id = "tick";
  section.title = "Cost of a tick";
  section.summary =
      "Duration of a tick, and its dependence on the size of the pot. A ball is pressed into the "
      "middle of a hollow lump for a thousand ticks: contact, removal, flow on both surfaces, "
      "stress, "
      "force and friction. ";
  measure_sizes(section, effort);
  measure_rules(section, effort);
  measure_ribs(section, effort);
  measure_speeds(section, effort);
  measure_jump(section, effort);
  return section;
}

}  // namespace clay::bench
