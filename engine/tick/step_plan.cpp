#include "claystack/engine/plan.hpp"

#include "claystack/engine/clay.hpp"
#include "core/text.hpp"
#include "engine/clay/scene_ranges.hpp"
#include "engine/clay/stress.hpp"
#include "engine/tick/rayleigh_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

namespace clay {
namespace {

// Of a scene that does not set them.
constexpr double kDefaultFingerBehind = 2.0;  // radii of the tool
constexpr double kDefaultHeaveSlope = 0.5;    // thickness over height

struct Setting {
  const char* name;
  double value;
  Range range;
};

Result<void> check_ranges(std::initializer_list<Setting> settings) {
  for (const Setting& setting : settings)
    if (!setting.range.holds(setting.value))
      return failure(ErrorKind::bad_input, std::string(setting.name) + ": expected a value " +
                                               setting.range.text() + ", found " +
                                               number_text(setting.value));
  return {};
}

Result<void> check(const SceneSpec& s) {
  const ForceSpec force = s.force.value_or(ForceSpec{});
  const StabilitySpec stability = s.stability.value_or(StabilitySpec{});
  const ClaySpec clay = s.clay.value_or(ClaySpec{});
  return check_ranges({
      {"lump.rings", static_cast<double>(s.lump.rings), ranges::kRings},
      {"lump.max_rings", static_cast<double>(s.lump.max_rings), ranges::kRingLimit},
      {"lump.ring_height_mm", s.lump.ring_height_mm, ranges::kRingHeightMm},
      {"lump.density_g_cm3", s.lump.density_g_cm3, ranges::kDensity},
      {"tool.gap_mm", s.tool.gap_mm.value_or(ranges::kGapMm.low), ranges::kGapMm},
      {"removal.rate_per_s", s.removal.rate_per_s, ranges::kRatePerS},
      {"removal.yield_depth_mm", s.removal.yield_depth_mm, ranges::kYieldDepthMm},
      {"removal.min_wall_mm", s.removal.min_wall_mm, ranges::kMinWallMm},
      {"removal.paper_fraction", s.removal.paper_fraction.value_or(0.0), ranges::kPaperFraction},
      {"flow.sigma_mm", s.flow.sigma_mm, ranges::kSigmaMm},
      {"flow.reach_mm", s.flow.reach_mm, ranges::kReachMm},
      {"flow.inside_share", s.flow.inside_share, ranges::kInsideShare},
      {"force.stiffness_n_per_mm2", force.stiffness_n_per_mm2, ranges::kStiffness},
      {"force.paper_stiffness_n_per_mm", force.paper_stiffness_n_per_mm.value_or(0.0),
       ranges::kPaperStiffness},
      {"force.limit_n", force.limit_n, ranges::kForceLimitN},
      {"force.friction", force.friction, ranges::kFriction},
      {"clay.wheel_rpm", clay.wheel_rpm, ranges::kWheelRpm},
      {"clay.floor_mm", clay.floor_mm, ranges::kFloorMm},
      {"clay.finger_mm", clay.finger_mm.value_or(0.0), ranges::kFingerMm},
      {"clay.finger_behind", clay.finger_behind.value_or(kDefaultFingerBehind),
       ranges::kFingerBehind},
      {"clay.heave_slope", clay.heave_slope.value_or(kDefaultHeaveSlope), ranges::kHeaveSlope},
      {"stability.max_stress_kpa", stability.max_stress_kpa, ranges::kMaxStressKpa},
  });
}

unsigned stages_of(const SceneSpec& s) {
  unsigned stages = 0;
  if (s.model == Model::paper) stages |= kPaperModel;
  if (s.force) stages |= kForce;
  if (s.force && s.force->friction > 0.0) stages |= kFriction;
  if (s.stability) stages |= kStability;
  if (s.tool.gap_mm) stages |= kPinch;
  if (s.clay && s.model != Model::paper) stages |= kRules;
  // A cut presses nothing; a pot upside down rests on its rim, not on its rings.
  if (cuts_level(s.tool.mode)) return stages & kPaperModel;
  if (s.tool.mode == ToolMode::trim_foot) stages &= ~(kStability | kPinch);
  if (s.tool.mode == ToolMode::smooth) stages &= ~kPinch;
  return stages;
}

unsigned rules_of(const SceneSpec& s) {
  if (!s.clay || s.model == Model::paper) return 0;
  const ClaySpec& clay = *s.clay;
  return (clay.lift ? kLift : 0u) | (clay.shift ? kShift : 0u) | (clay.rim ? kRim : 0u) |
         (clay.hoop && clay.shift ? kHoop : 0u) | (clay.heave ? kHeave : 0u) |
         (clay.smear && clay.wheel_rpm > 0.0 ? kSmear : 0u);
}

double finger_mm(const SceneSpec& s) {
  return s.clay && s.tool.mode == ToolMode::press ? s.clay->finger_mm.value_or(0.0) : 0.0;
}

bool cutter(ToolMode mode) { return mode == ToolMode::trim || mode == ToolMode::trim_foot; }

bool sinks_rim(const SceneSpec& s) {
  return s.clay && s.clay->rim_sinks && s.clay->heave &&
         (s.tool.mode == ToolMode::press || s.tool.mode == ToolMode::trim);
}

bool closes_rim(const SceneSpec& s) {
  return s.clay && s.clay->narrow_rim_closes && !cutter(s.tool.mode);
}

bool bends_wall(const SceneSpec& s) {
  return s.clay && s.clay->pushed_wall_bends && s.clay->shift && s.tool.mode == ToolMode::press;
}
bool stretches_wall(const SceneSpec& s) {
  return s.clay && s.clay->lifted_wall_stretches && s.clay->lift && s.tool.gap_mm &&
         (s.tool.mode == ToolMode::press || s.tool.mode == ToolMode::pinch);
}

bool sponge_follows(const SceneSpec& s) {
  return s.clay && s.clay->sponge_follows && s.tool.mode == ToolMode::smooth;
}
bool stretches_lump(const SceneSpec& s) {
  return s.clay && s.clay->pressed_lump_stretches && s.clay->heave &&
         s.tool.mode == ToolMode::press;
}
bool thin_rim_rises(const SceneSpec& s) {
  return s.clay && s.clay->thin_rim_rises && s.clay->rim && s.tool.gap_mm &&
         (s.tool.mode == ToolMode::press || s.tool.mode == ToolMode::pinch);
}

RulesPlan rules_plan(const SceneSpec& s) {
  if (!s.clay) return {};
  // Rings whose middle is below the floor's height. A foot may be trimmed until the floor is as
  // thin as a wall may be.
  const double h = s.lump.ring_height_mm;
  const double rings = s.tool.mode == ToolMode::trim_foot ? std::ceil(s.removal.min_wall_mm / h)
                                                          : s.clay->floor_mm / h + 0.5;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return {rules_of(s),
          static_cast<std::size_t>(std::fmin(rings, static_cast<double>(kMaxRings))),
          kTurn * s.clay->wheel_rpm / 60.0,
          finger_mm(s),
          s.clay->finger_behind.value_or(kDefaultFingerBehind),
          s.clay->thin_wall_yields,
          sinks_rim(s),
          closes_rim(s),
          stretches_wall(s),
          bends_wall(s),
          sponge_follows(s),
          stretches_lump(s),
          thin_rim_rises(s),
          s.clay->heave_slope.value_or(kDefaultHeaveSlope)};
}

ForcePlan force_plan(const SceneSpec& s) {
  if (!s.force) return {};
  const double per_ring = s.force->stiffness_n_per_mm2 * s.lump.ring_height_mm;
  const double k =
      s.model == Model::paper ? s.force->paper_stiffness_n_per_mm.value_or(per_ring) : per_ring;
  return {k, s.force->limit_n, s.force->friction, s.force->counterclockwise ? 1.0 : -1.0,
          1.0 / s.lump.ring_height_mm};
}

StabilityPlan stability_plan(const SceneSpec& s) {
  if (!s.stability) return {};
  return {s.stability->max_stress_kpa, kpa_per_ratio(s.lump.density_g_cm3, s.lump.ring_height_mm),
          s.clay.has_value() && s.model != Model::paper};
}

/// The same tool seen in a pot that stands upside down.
ToolShapeSpec turned(const ToolShapeSpec& shape) {
  const auto* const sampled = std::get_if<SampledSpec>(&shape);
  if (sampled == nullptr) return shape;
  SampledSpec turned = *sampled;
  std::ranges::reverse(turned.t_mm);
  std::ranges::reverse(turned.f_mm);
  for (double& t : turned.t_mm) t = -t;
  return turned;
}

/// The options of the clay rules. `any`: the scene has clay rules; otherwise `none` is the reason.
void describe_options(const SceneSpec& s, bool any, const std::string& none,
                      std::vector<PlanLine>& lines) {
  const bool cuts = cutter(s.tool.mode);
  const auto line = [&](const char* stage, bool used, const char* in, const char* out) {
    lines.push_back({stage, used, used ? in : any ? out : none});
  };
  line("finger", any && s.clay->heave && finger_mm(s) > 0.0,
       "in a bore, no clay closes behind the tool",
       "no finger is set, or heave is off, or the tool does not press");
  line("thin wall", any && s.clay->thin_wall_yields && s.tool.mode != ToolMode::trim_foot,
       "a wall at its minimum bends outward; a cut leaves no ledge",
       any && s.clay->thin_wall_yields
           ? "a foot has no rule against a ledge"
           : "clay.thin_wall is not set: a tool from inside goes through a wall at its minimum");
  line("pressed rim", any && sinks_rim(s),
       cuts ? "a cut from above lowers the rim"
            : "a tool that comes down on the rim presses it down",
       any && s.clay->rim_sinks
           ? "heave is off, or the tool neither presses nor trims"
           : "clay.pressed_rim is not set: a tool that comes down on the rim goes aside");
  line("narrow rim", any && closes_rim(s), "a rim that is pushed inward closes",
       any && s.clay->narrow_rim_closes
           ? "a trimming tool moves no clay"
           : "clay.narrow_rim is not set: a rim that is pushed inward becomes a pipe");
  line("lifted wall", any && stretches_wall(s), "a wall that two tools lift stretches at the tools",
       any && s.clay->lifted_wall_stretches
           ? "lift is off, or there is one tool"
           : "clay.lifted_wall is not set: a wall that two tools lift grows at its rim");
  line("pushed wall", any && bends_wall(s), "a thin wall that one tool pushes keeps its thickness",
       any && s.clay->pushed_wall_bends
           ? "shift is off, or the tool does not press"
           : "clay.pushed_wall is not set: a wall behind a moving tool is squeezed thinner");
  line("pressed lump", any && stretches_lump(s), "solid clay that one tool presses grows longer",
       any && s.clay->pressed_lump_stretches
           ? "heave is off, or the tool does not press"
           : "clay.pressed_lump is not set: solid clay that one tool presses rises beside it");
  line("thin rim", any && thin_rim_rises(s), "a thin rim rises as two tools lift the wall",
       any && s.clay->thin_rim_rises ? "the rule rim is off, or there is one tool"
                                     : "clay.thin_rim is not set: a thin rim grows by copies");
}

void describe_rules(const SceneSpec& s, std::vector<PlanLine>& lines) {
  const unsigned rules = rules_of(s);
  const bool any = s.clay && s.model != Model::paper, cuts = cutter(s.tool.mode);
  const std::string none = s.clay ? "the paper's model has no clay rules" : "no clay rules are set";
  const auto line = [&](const char* stage, unsigned rule, const char* in, const char* out) {
    const bool used = (rules & rule) != 0 && !cuts;
    lines.push_back({stage, used,
                     used           ? in
                     : !any         ? none
                     : rules & rule ? "a trimming tool moves no clay"
                                    : out});
  };
  line("lift", kLift, "clay that two tools squeeze out becomes height", "off in the scene");
  line("shift", kShift, "a tool on one side moves the wall", "off in the scene");
  line("rim", kRim, "a new ring copies the rim", "off in the scene");
  line("hoop", kHoop, "half of a hoop strain becomes height", "off in the scene, or shift is");
  const bool heaves = (rules & kHeave) != 0;
  lines.push_back({"heave", heaves,
                   !heaves ? any ? "off in the scene" : none
                   : cuts  ? "a cut leaves no steep ledge"
                           : "displaced clay leaves no steep slope"});
  line("smear", kSmear, "a wet finger evens out the surface",
       "off in the scene, or the wheel stands still");
  describe_options(s, any, none, lines);
}

void describe_force(const SceneSpec& s, unsigned stages, std::vector<PlanLine>& lines) {
  const bool turned = s.tool.mode == ToolMode::trim_foot;
  const bool alone = turned || s.tool.mode == ToolMode::smooth;
  const auto line = [&](const char* stage, unsigned bit, const char* in, const char* out) {
    lines.push_back({stage, (stages & bit) != 0, (stages & bit) ? in : out});
  };
  line("force", kForce, "section 6.1", "no force is set");
  line("friction", kFriction, "section 6.2", "no coefficient of friction is set");
  line("stability", kStability, "section 7",
       turned && s.stability ? "a pot upside down rests on its rim" : "no stress threshold is set");
  line("pinch", kPinch, "a pose with a gap has two tools",
       alone && s.tool.gap_mm ? "this mode has one tool" : "no gap is set");
}

/// The stages of a sponge, which presses nothing.
std::vector<PlanLine> describe_sponge(const SceneSpec& s, unsigned stages) {
  const bool smears = s.clay->wheel_rpm > 0.0;
  std::vector<PlanLine> lines{
      {"tool state", true, "pose, time step, direction of motion"},
      {"contact", true, "equations (1), (2), then the rings touched"},
      {"removal", false, "a sponge removes no clay"},
      {"growth", false, "a sponge moves no clay to the rim"},
      {"smear", smears,
       !smears             ? "the wheel stands still"
       : sponge_follows(s) ? "a sponge evens out the surface and follows its slope"
                           : "a sponge evens out the surface"}};
  describe_force(s, stages, lines);
  return lines;
}

std::vector<PlanLine> describe(const SceneSpec& s, unsigned stages) {
  if (cuts_level(s.tool.mode))
    return {
        {"tool state", true, "pose, time step"},
        {"cut", true,
         s.tool.mode == ToolMode::needle ? "the rim, level, where the tool goes through the wall"
                                         : "the pot off the wheel; the upper part stays"}};
  if (s.tool.mode == ToolMode::smooth) return describe_sponge(s, stages);
  const bool hollow = s.lump.inner_radius_mm > 0.0, press = !cutter(s.tool.mode);
  std::vector<PlanLine> lines{
      {"tool state", true, "pose, time step, direction of motion"},
      {"contact", true, "equations (1), (2), then the rings touched"},
      {"removal", true,
       s.model == Model::paper ? "k (R - r) per tick"
                               : "at rate (R - r), slower at less than the yield depth"},
      {"outer surface", true, press ? "equations (5), (7)" : "cut"},
      {"inner surface", hollow,
       hollow ? "equations (6), (8)" : "the lump is solid: nothing to fill until a tool opens it"},
      {"growth", press,
       press ? "clay above the top becomes height" : "a trimming tool moves no clay"}};
  describe_force(s, stages, lines);
  describe_rules(s, lines);
  return lines;
}

}  // namespace

std::size_t max_rings_of(const LumpSpec& lump) noexcept {
  return lump.max_rings > 0 ? lump.max_rings : std::min(4 * lump.rings, kMaxRings);
}

Result<StepPlan> StepPlan::build(const SceneSpec& scene) {
  if (auto checked = check(scene); !checked) return tl::make_unexpected(checked.error());
  if (scene.tool.mode == ToolMode::pinch && !scene.tool.gap_mm)
    return failure(ErrorKind::bad_input, "tool.gap_mm: expected a gap for mode pinch, found none");
  if (scene.tool.mode == ToolMode::smooth && (!scene.clay || scene.model == Model::paper))
    return failure(ErrorKind::bad_input,
                   "tool.mode: expected a scene with clay rules for smooth, found none");
  auto tool = Tool::build(scene.tool.mode == ToolMode::trim_foot ? turned(scene.tool.shape)
                                                                 : scene.tool.shape);
  if (!tool) return tl::make_unexpected(tool.error());

  StepPlan plan;
  plan.model = scene.model;
  plan.stages = stages_of(scene);
  plan.mode = scene.tool.mode;
  plan.gap_mm = scene.tool.mode == ToolMode::pinch ? *scene.tool.gap_mm : 0.0;
  plan.tool = std::move(*tool);
  plan.kernel =
      std::make_shared<const RayleighKernel>(scene.flow.sigma_mm, scene.flow.reach_mm,
                                             scene.lump.ring_height_mm, max_rings_of(scene.lump));
  plan.inside_share = static_cast<std::int64_t>(scene.flow.inside_share * (1 << 30) + 0.5);
  plan.removal = {scene.removal.rate_per_s, scene.removal.yield_depth_mm, scene.removal.min_wall_mm,
                  scene.removal.paper_fraction.value_or(
                      std::fmin(scene.removal.rate_per_s / kPaperRateHz, 0.5))};
  plan.force = force_plan(scene);
  plan.stability = stability_plan(scene);
  plan.clay = rules_plan(scene);
  plan.density_g_cm3 = scene.lump.density_g_cm3;
  plan.lines = describe(scene, plan.stages);
  return plan;
}

}  // namespace clay
