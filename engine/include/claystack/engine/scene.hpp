#pragma once
// The contents of a scene, in the units of the outer face. StepPlan::build turns it into the data
// of the tick.

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace clay {

/// The model of the clay. `paper`, as in the paper: removal k(R-r) per tick, stiffness per ring,
/// growth by whole rings with the rest kept outside the body. `conserving`: exponential removal,
/// stiffness per mm of contact height, the rest of growth shown as the crown.
enum class Model { conserving, paper };

/// The starting lump: equal rings.
struct LumpSpec {
  std::size_t rings = 200;
  double ring_height_mm = 0.75;
  double outer_radius_mm = 45.0;
  double inner_radius_mm = 0.0;
  std::size_t max_rings = 0;  ///< growth stops here; 0 means 4 times `rings`
  double density_g_cm3 = 1.9;
  friend bool operator==(const LumpSpec&, const LumpSpec&) = default;
};

/// The limit of growth: `max_rings`, or 4 times `rings` if that is 0.
[[nodiscard]] std::size_t max_rings_of(const LumpSpec& lump) noexcept;

/// Half-profiles f(t) of the tool, t in mm from its centre (paper, section 3).
struct SphereSpec {
  double radius_mm = 10.0;
  friend bool operator==(const SphereSpec&, const SphereSpec&) = default;
};
/// f(t) = b sqrt(1 - t^2/a^2)
struct EllipseSpec {
  double half_height_mm = 15.0;  ///< a
  double half_width_mm = 8.0;    ///< b
  friend bool operator==(const EllipseSpec&, const EllipseSpec&) = default;
};
/// An upright cylinder: a potter's rib held flat.
struct RibSpec {
  double height_mm = 40.0;
  double radius_mm = 6.0;
  friend bool operator==(const RibSpec&, const RibSpec&) = default;
};
/// Monotone cubic through (t, f): t strictly increasing, f >= 0, at least two points.
struct SampledSpec {
  std::vector<double> t_mm;
  std::vector<double> f_mm;
  friend bool operator==(const SampledSpec&, const SampledSpec&) = default;
};
using ToolShapeSpec = std::variant<SphereSpec, EllipseSpec, RibSpec, SampledSpec>;

enum class ToolMode {
  press,  ///< displaces clay
  trim,   ///< cuts clay off
  pinch,  ///< two equal tools press the wall from both sides, as a potter's two hands do
  /// A sponge, or a wet rib: evens out the surface and cuts nothing. Needs the section `clay`.
  smooth,
  /// Cuts the rim level at the height of the HIP as soon as the HIP has gone through the wall.
  needle,
  /// Cuts the pot off the wheel at the height of the HIP; the upper part stays and is set down.
  wire,
  /// The pot stands upside down on the wheel, and the tool trims: for the foot. Poses and forces
  /// are those of the hand; the pot in memory and in files stays upright.
  trim_foot,
};

struct ToolSpec {
  ToolShapeSpec shape = SphereSpec{};
  /// The trim button of a pose switches `press` and `pinch` to `trim`; the others ignore it.
  ToolMode mode = ToolMode::press;
  /// If set, poses may pinch in the modes `press`, `trim` and `pinch`: the gap of the pose decides.
  /// Mode `pinch` requires it, and uses it for poses without a gap.
  std::optional<double> gap_mm = std::nullopt;
  friend bool operator==(const ToolSpec&, const ToolSpec&) = default;
};

/// Equations (3), (4): clay yields at the speed `rate_per_s` (R - r), and slower where the tool is
/// less than `yield_depth_mm` deep; in `paper` by k (R - r) per tick.
struct RemovalSpec {
  double rate_per_s = 20.0;
  double yield_depth_mm = 0.25;  ///< conserving: depth of the tool in the clay for the full rate
  double min_wall_mm = 1.0;      ///< conserving: no tool thins a wall below this
  std::optional<double> paper_fraction;  ///< k; rate / 1000, at most 0.5, when absent
  friend bool operator==(const RemovalSpec&, const RemovalSpec&) = default;
};

/// Section 5.1: Rayleigh kernel of mode sigma, cut at reach; the fraction alpha goes inside.
struct FlowSpec {
  double sigma_mm = 8.0;
  double reach_mm = 30.0;
  double inside_share = 0.27;  ///< alpha, 0..1
  friend bool operator==(const FlowSpec&, const FlowSpec&) = default;
};

/// Section 6. Friction 0 leaves friction out; an absent ForceSpec leaves out the whole stage.
struct ForceSpec {
  double stiffness_n_per_mm2 = 0.05;  ///< per mm of depth and mm of contact height
  double limit_n = 5.0;
  double friction = 0.0;                           ///< mu
  bool counterclockwise = true;                    ///< rotation of the wheel seen from above
  std::optional<double> paper_stiffness_n_per_mm;  ///< K per ring; stiffness x h when absent
  friend bool operator==(const ForceSpec&, const ForceSpec&) = default;
};

/// Section 7: the stack collapses where stress exceeds the threshold.
struct StabilitySpec {
  double max_stress_kpa = 10.0;
  friend bool operator==(const StabilitySpec&, const StabilitySpec&) = default;
};

/// Rules of real clay on top of `conserving` (docs/clay-rules.md), each a separate stage. The
/// paper's model has none of them.
struct ClaySpec {
  bool lift = true;          ///< clay that two tools squeeze out becomes height
  bool shift = true;         ///< a tool on one side moves the wall as a plastic shell
  bool rim = true;           ///< a new ring copies the rim
  bool hoop = true;          ///< half of a hoop strain becomes height
  bool heave = true;         ///< displaced clay leaves no slope steeper than a tool leaves
  bool smear = true;         ///< a wet finger evens out the surface below it
  double wheel_rpm = 120.0;  ///< for smear
  double floor_mm = 0.0;     ///< no tool opens the solid bottom below this height; 0: no stop
  /// Length of the finger in a bore; no thick wall closes behind it. Absent: the tool alone.
  std::optional<double> finger_mm = std::nullopt;
  /// Distance of the finger from the tool's middle, toward the axis, in radii of the tool. Absent:
  /// 2. A finger close behind the tool leaves a mouth as wide as the bottom.
  std::optional<double> finger_behind = std::nullopt;
  /// Steepest slope that heave leaves: change of thickness over height. Absent: 0.5.
  std::optional<double> heave_slope = std::nullopt;
  /// At the minimum wall. False: a tool from inside goes through the wall, and two tools that go
  /// out leave it behind. True: they bend it (needs `shift`), and the rim sinks to supply the clay;
  /// a cut removes a tip of the rim that would project as a ledge. A press from outside always
  /// bends the wall.
  bool thin_wall_yields = false;
  /// A tool that comes down on the rim. False: it goes aside. True: it presses the rim down (needs
  /// `heave`), and the wall below becomes thicker; a cutter lowers the rim.
  bool rim_sinks = false;
  /// A rim that is narrower than the wall that a tool presses. False: the clay of that wall raises
  /// the rim, which can become a long pipe. True: the rim rises by no more height than the wall
  /// gains, and where a tool outside leaves no room, it leans inward: it closes.
  bool narrow_rim_closes = false;
  /// Clay that two tools squeeze out (needs `lift`). False: the wall grows at its rim. True: it
  /// stretches at the tools where it is wider than the rim, and all above them rises as it is.
  bool lifted_wall_stretches = false;
  /// Where one tool presses a thin wall (needs `shift`). False: the wall moves near the deepest
  /// place of the contact, and is squeezed thinner behind it and in the undercut beyond a contact
  /// from outside. True: it moves there too, and keeps its thickness.
  bool pushed_wall_bends = false;
  /// The surface that a sponge leaves (tool mode `smooth`). False: one radius in its window, so
  /// that the window ends in ledges on a wall that slopes. True: the smoothest surface that goes on
  /// at the ends of the window.
  bool sponge_follows = false;
  /// Solid clay that one tool presses from the side (needs `heave`). False: all of the clay rises
  /// beside the contact, as a brim. True: a part of it stretches the column at the contact.
  bool pressed_lump_stretches = false;
  /// A rim that is thinner than the wall below it (needs `rim`). False: it grows by copies of the
  /// thin rim, unless it is a rounded lip. True: it rises as it is, and the wall below it grows.
  bool thin_rim_rises = false;
  friend bool operator==(const ClaySpec&, const ClaySpec&) = default;
};

struct SceneSpec {
  std::string name;
  Model model = Model::conserving;
  LumpSpec lump;
  ToolSpec tool;
  RemovalSpec removal;
  FlowSpec flow;
  std::optional<ForceSpec> force = ForceSpec{};
  std::optional<StabilitySpec> stability;
  std::optional<ClaySpec> clay;
  friend bool operator==(const SceneSpec&, const SceneSpec&) = default;
};

/// The part of its last scene that a pot stores, so that the next stroke has the same tool and
/// clay: all fields except the name, the model and the lump.
struct ThrowSettings {
  ToolSpec tool;
  RemovalSpec removal;
  FlowSpec flow;
  std::optional<ForceSpec> force;
  std::optional<StabilitySpec> stability;
  std::optional<ClaySpec> clay;
  friend bool operator==(const ThrowSettings&, const ThrowSettings&) = default;
};
[[nodiscard]] inline ThrowSettings settings_of(const SceneSpec& scene) {
  return {scene.tool, scene.removal, scene.flow, scene.force, scene.stability, scene.clay};
}
inline void apply(const ThrowSettings& settings, SceneSpec& scene) {
  std::tie(scene.tool, scene.removal, scene.flow, scene.force, scene.stability, scene.clay) =
      std::tie(settings.tool, settings.removal, settings.flow, settings.force, settings.stability,
               settings.clay);
}

}  // namespace clay
