#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clay {

// ---- quanta --------------------------------------------------------------------------
// Clay is counted, not measured: squared radii are integers, so that volume is
// moved without rounding and a replay gives the same bits everywhere.

/// A count of 2^-36 mm^2, the unit of squared radii. A ring of height h that
/// spans q quanta holds pi * h * q * 2^-36 mm^3.
using Quanta = std::int64_t;

/// Sums of quanta over a whole stack (up to 2^24 rings of 2^61 quanta).
__extension__ typedef __int128 WideQuanta;

inline constexpr double kQuantaPerMm2 = 68719476736.0;  // 2^36
inline constexpr double kMm2PerQuantum = 1.0 / kQuantaPerMm2;

inline constexpr double kMinRadiusMm = 1e-3;
inline constexpr double kMaxRadiusMm = 5000.0;
inline constexpr double kMinRingHeightMm = 1e-3, kMaxRingHeightMm = 1e3;
inline constexpr double kMinDensityGCm3 = 0.1, kMaxDensityGCm3 = 25.0;
inline constexpr std::size_t kMaxRings = std::size_t{1} << 24;

/// The squared radius nearest to `mm2` [mm^2], halves up. Needs 0 <= mm2 < 1.3e8.
[[nodiscard]] constexpr Quanta quanta_from_mm2(double mm2) noexcept {
  return static_cast<Quanta>(mm2 * kQuantaPerMm2 + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}
[[nodiscard]] constexpr Quanta quanta_from_radius(double mm) noexcept {
  return quanta_from_mm2(mm * mm);
}
/// R^2 of the thinnest and of the thickest ring.
inline constexpr Quanta kSmallestOuter2 = quanta_from_radius(kMinRadiusMm);
inline constexpr Quanta kLargestOuter2 = quanta_from_radius(kMaxRadiusMm);

[[nodiscard]] inline double mm2_from_quanta(Quanta q) noexcept {
  return static_cast<double>(q) * kMm2PerQuantum;
}
[[nodiscard]] inline double mm2_from_quanta(WideQuanta q) noexcept {
  return static_cast<double>(q) * kMm2PerQuantum;
}
/// Radius [mm] of a squared radius. IEEE sqrt is exact to half an ulp on every platform.
[[nodiscard]] inline double radius_from_quanta(Quanta q) noexcept {
  return std::sqrt(mm2_from_quanta(q));
}

/// Decimal digits of a wide count, for files and messages.
[[nodiscard]] std::string to_string(WideQuanta q);

// ---- clay stack ----------------------------------------------------------------------
// The clay: a stack of coaxial rings of one height, and a crown on top.

/// One cylindrical element (paper, section 2). 0 <= inner2 < outer2, in quanta of 2^-36 mm^2.
struct Ring {
  Quanta outer2 = 0;  ///< squared outer radius R^2
  Quanta inner2 = 0;  ///< squared inner radius r^2; 0 where there is no bore

  [[nodiscard]] Quanta volume() const noexcept {
    return outer2 - inner2;
  }  ///< normalised: V / (pi h)
  [[nodiscard]] double outer_mm() const noexcept { return radius_from_quanta(outer2); }
  [[nodiscard]] double inner_mm() const noexcept { return radius_from_quanta(inner2); }
  /// Whether it shares more than a circle with a ring on or below it.
  [[nodiscard]] bool touches(const Ring& neighbour) const noexcept {
    return inner2 < neighbour.outer2 && neighbour.inner2 < outer2;
  }
  friend bool operator==(const Ring&, const Ring&) = default;
};

/// Rings 0..N-1 from the wheel up (the paper's 1..N). Ring i spans the heights
/// [i h, (i+1) h] in mm above the wheel head; the axis is y. The crown is clay on
/// ring N-1 with its radii, counted in normalised quanta like a ring's volume:
/// usually less than a ring, but more where a ring cannot grow (max_rings, a tool
/// in its place).
///
/// Reading is public; only StackWriter, private to the engine, writes.
class ClayStack {
 public:
  ClayStack() = default;

  /// `count` equal rings. Refuses N outside [1, 2^24], heights outside [1e-3, 1e3] mm and
  /// radii outside 0 <= r < R, 1e-3 <= R <= 5000 mm.
  static Result<ClayStack> cylinder(std::size_t count, double ring_height_mm, double outer_mm,
                                    double inner_mm, std::size_t max_rings);

  /// Any valid rings, as read from a file. Same limits; the message names the ring.
  static Result<ClayStack> from_rings(double ring_height_mm, std::vector<Ring> rings,
                                      WideQuanta crown, std::size_t max_rings = kMaxRings);

  [[nodiscard]] std::span<const Ring> rings() const noexcept { return rings_; }
  [[nodiscard]] std::size_t size() const noexcept { return rings_.size(); }
  [[nodiscard]] std::size_t max_rings() const noexcept { return max_rings_; }
  [[nodiscard]] double ring_height_mm() const noexcept { return ring_height_mm_; }
  [[nodiscard]] WideQuanta crown() const noexcept { return crown_; }
  [[nodiscard]] double crown_height_mm() const noexcept;
  [[nodiscard]] double height_mm() const noexcept;  ///< with the crown

  /// Rings and crown, kept up to date by every transfer: O(1). Normalised quanta.
  [[nodiscard]] WideQuanta volume() const noexcept { return rings_volume_ + crown_; }
  /// The same, counted again from all rings: O(N). The two are always equal.
  [[nodiscard]] WideQuanta recount() const noexcept;
  [[nodiscard]] double mm3_per_quantum() const noexcept;  ///< pi h 2^-36
  [[nodiscard]] double volume_mm3() const noexcept;

  /// Some ring has a bore (r > 0). While false, no clay can flow inward.
  [[nodiscard]] bool hollow() const noexcept { return bores_ > 0; }

  friend bool operator==(const ClayStack&, const ClayStack&) = default;

 private:
  friend class StackWriter;

  std::vector<Ring> rings_;
  double ring_height_mm_ = 1.0;
  std::size_t max_rings_ = kMaxRings;
  WideQuanta crown_ = 0;
  WideQuanta rings_volume_ = 0;
  std::size_t bores_ = 0;  ///< rings with r > 0
};

// ---- stack measures ------------------------------------------------------------------

/// [mm]; 0 without rings.
[[nodiscard]] double largest_radius_mm(const ClayStack& stack) noexcept;

/// The stress in every ring [kPa], bottom to top: beta_i = g M_i / (pi (R_i^2 - r_i^2)), M_i the
/// mass of all above it, crown included (paper, section 7). Equal, to the last bit, to the stress
/// that a scene compares with its StabilitySpec::max_stress_kpa.
[[nodiscard]] std::vector<double> stresses_kpa(const ClayStack& stack, double density_g_cm3);

/// Capacity of the bore that opens at the top, filled to the brim [mm^3]; exact for the steps of a
/// pot in one piece. 0 without such a bore, or if it goes through the whole pot.
[[nodiscard]] double capacity_mm3(const ClayStack& stack) noexcept;

inline constexpr double kStandardGravity = 9.80665;  ///< m/s^2 (ISO 80000-3)

// ---- ledger --------------------------------------------------------------------------

/// The account of every quantum of clay: initial + added = in the stack + trimmed + outside.
/// Normalised quanta (V / (pi h) in units of 2^-36 mm^2).
struct Ledger {
  WideQuanta initial = 0;  ///< in the stack when the scene began
  WideQuanta added = 0;    ///< put on since; 0 at present: no tool adds clay
  WideQuanta trimmed = 0;  ///< cut off by a trimming tool (the paper's chiselling)
  WideQuanta outside = 0;  ///< model `paper` only: excess not yet enough for a ring (section 5.1)

  /// Clay unaccounted for, given the clay in the stack; 0 in a sound engine.
  [[nodiscard]] WideQuanta imbalance(WideQuanta in_stack) const noexcept {
    return in_stack + trimmed + outside - initial - added;
  }
  /// The excess of clay in the body (negative: a lack): the paper's volume error.
  [[nodiscard]] WideQuanta volume_error(WideQuanta in_stack) const noexcept {
    return in_stack + trimmed - initial - added;
  }
  friend bool operator==(const Ledger&, const Ledger&) = default;
};

// ---- pot -----------------------------------------------------------------------------
// A finished (or half finished) pot as a value: the result of a session.

/// A collapse (paper, section 7): the rings above `failed_ring` moved as one rigid body in the
/// upright plane through the pot's axis and `pivot_mm`, the HIP when it happened: first
/// turned about a horizontal axis through the pivot, then shifted (FallenPlace).
struct Collapse {
  std::size_t failed_ring = 0;  ///< index of the ring that yielded or parted; it stays below
  glm::dvec3 pivot_mm{0.0};
  glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit, horizontal; right-handed turn
  double angle_rad = 0.0;          ///< within a full turn either way
  double stress_kpa = 0.0;         ///< at the failed ring
  glm::dvec3 shift_mm{0.0};
  double threshold_kpa = 0.0;    ///< the stress that the clay bears; 0: not known
  double energy_lost_mj = 0.0;   ///< potential energy, by the upper part
  double plastic_work_mj = 0.0;  ///< of that, spent on the lower clay; the rest was damped

  static constexpr double kMostMm = 1e6;  ///< of each component of pivot and shift
  /// Whether the axis is horizontal and of length 1.
  [[nodiscard]] bool has_valid_axis() const noexcept {
    return axis.y == 0.0 && std::abs(axis.x * axis.x + axis.z * axis.z - 1.0) < 1e-9;
  }
  /// The failed ring bore its load, but a press or a cut parted it from the ring above.
  [[nodiscard]] bool parted() const noexcept {
    return threshold_kpa > 0.0 && stress_kpa <= threshold_kpa;
  }
  friend bool operator==(const Collapse&, const Collapse&) = default;
};

/// Of a pot whose radii are whole multiples of a precision: rounded_pot.
struct Rounding {
  double to_mm = 0.0;           ///< the precision
  WideQuanta exact_volume = 0;  ///< clay in the stack before it was rounded, normalised quanta
  friend bool operator==(const Rounding&, const Rounding&) = default;
};

/// Clay received at the crown's height in excess of the top ring's since the last growth, outside
/// and inside [quanta]. The next ring that grows is a copy of the top ring with this excess.
struct Rim {
  WideQuanta outside = 0, inside = 0;
  friend bool operator==(const Rim&, const Rim&) = default;
};

/// Last motion of the tool, for the clay rules: a mean over the last few hundredths of a second.
/// The rules use it to divide displaced clay.
struct Motion {
  double upward_mm_s = 0.0;
  double outward_mm_s = 0.0;  ///< away from the axis
  friend bool operator==(const Motion&, const Motion&) = default;
};

/// When collapsed, `stack` still holds all rings in their order: 0..failed_ring stand,
/// the others (and the crown) are turned by `collapse`.
struct Pot {
  ClayStack stack;
  Ledger ledger;
  Model model = Model::conserving;
  double density_g_cm3 = 1.9;
  std::optional<Collapse> collapse;
  std::optional<Rounding> rounding;
  Rim rim{};        ///< for the next stroke; zero in the model `paper`
  Motion motion{};  ///< for the next stroke; zero in scenes without clay rules
  /// The settings of the last stroke, for the next one. Empty: the pot was made in another way,
  /// such as from a drawing.
  std::optional<ThrowSettings> thrown_with{};
  /// The tool that left the marks on the walls, if the last stroke was a needle or a wire, which
  /// leave none. Empty otherwise: `thrown_with` has that tool.
  std::optional<ToolSpec> shaped_with{};
  friend bool operator==(const Pot&, const Pot&) = default;
};

// ---- rounded pot ---------------------------------------------------------------------
// A pot with fewer digits, because a printer cannot show more. See files.hpp.

/// `pot` with every radius at the nearest multiple of `precision_mm`: whole nanometres, 1e-5 to
/// 1 mm. A bore less than half a step wide becomes one step: a bore stays a bore.
///
/// The result is an independent pot: its ledger begins with the clay that it holds, nothing added,
/// trimmed or outside, and `Pot::rounding` has the volume before. Crown, collapse, model and the
/// tools, from which the export takes the smoothing, stay as they are; `Pot::rim`, which a next
/// stroke would need, is zero. Rounded pots round again to the same precision or a coarser one.
///
/// Refuses changes of the topology, and names the ring: a wall that would vanish, rings that would
/// no longer touch each other, an outer radius beyond the limits of ClayStack.
Result<Pot> rounded_pot(const Pot& pot, double precision_mm);

/// The clay that rounding added (negative: took away) [mm^3]; 0 of a pot that is not rounded.
[[nodiscard]] double volume_change_mm3(const Pot& pot) noexcept;

}  // namespace clay
