#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace clay {

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

// ---- rayleigh kernel -----------------------------------------------------------------

/// The discrete Rayleigh distribution P_d(j), j = 1..L1 (paper, section 5.1), tabled as integers
/// so that shares of an integer amount add up to it exactly.
class RayleighKernel {
 public:
  /// Q_p(x) = x / sigma^2 exp(-x^2 / 2 sigma^2) at x = h j, for L1 = round(reach / h) rings, at
  /// most `max_rings`. sigma = 0 puts all into j = 1; sigma = inf makes the weights linear in j;
  /// reach = 0 gives no ring a share, so that everything goes into height.
  RayleighKernel(double sigma_mm, double reach_mm, double ring_height_mm, std::size_t max_rings);

  [[nodiscard]] std::size_t length() const noexcept { return cumulative_.size() - 1; }  ///< L1
  /// The rings that get clay. If sigma is much less than the reach, the other rings of L1 have
  /// weights that round to the integer 0.
  [[nodiscard]] std::size_t effective_length() const noexcept { return effective_length_; }

  /// The cumulative distribution up to ring 1, 2, ... `offset` (in ring heights, at least -1) moves
  /// all rings away from the tool: ring j then reaches from j - 1 + offset to j + offset in a
  /// distribution that is even within each ring of the table. Ring 1 also gets the part before it.
  /// A negative offset leaves a part for ring L1 + 1.
  class ShareCursor {
   public:
    explicit ShareCursor(const RayleighKernel& kernel, double offset = 0.0) noexcept
        : kernel_(&kernel),
          at_(static_cast<std::int64_t>(std::floor(offset)) + 1),
          between_(static_cast<std::int64_t>((offset - std::floor(offset)) * kBetweenOne)),
          below_(kernel.cumulative(at_)) {}
    /// The part of the whole that the rings get, up to and including the next one, in 2^-40.
    std::int64_t next() noexcept {
      const std::int64_t below = below_;
      below_ = kernel_->cumulative(++at_);
      return below + (((below_ - below) * between_) >> kBetweenBits);
    }

   private:
    static constexpr int kBetweenBits = 20;
    static constexpr double kBetweenOne = 1 << kBetweenBits;

    const RayleighKernel* kernel_;
    std::int64_t at_;       ///< whole rings of the table ..
    std::int64_t between_;  ///< .. and a fraction, in 2^-20
    std::int64_t below_;    ///< C at at_
  };

  /// Divides an amount by the parts that a ShareCursor returns; the shares of rings 1..L1 add up to
  /// the amount, to the quantum. Quanta and WideQuanta give the same shares: the amounts of an
  /// ordinary tick fit into 64 bits, which takes one multiplication instead of three.
  template <class Amount>
  class Shares {
   public:
    explicit Shares(Amount amount) noexcept : amount_(amount) {}
    /// The share of the next ring.
    Amount next(std::int64_t part) noexcept {
      const Amount before = dealt_;
      dealt_ = static_cast<Amount>((WideQuanta{amount_} * part) >> kFractionBits);
      return dealt_ - before;
    }

   private:
    Amount amount_, dealt_ = 0;
  };

  /// P_d(j), for reports and tests.
  [[nodiscard]] double weight(std::size_t j) const noexcept;

 private:
  // 40 bits of fraction: 2^24 rings of 2^61 quanta times 2^40 still fit 127 bits.
  static constexpr int kFractionBits = 40;
  [[nodiscard]] std::int64_t cumulative(std::int64_t j) const noexcept {
    const auto last = static_cast<std::int64_t>(length());
    return cumulative_[static_cast<std::size_t>(std::min(j, last))];
  }
  std::vector<std::int64_t> cumulative_;  ///< C_0 = 0 .. C_L1 = 2^40
  std::size_t effective_length_ = 0;
};

// ---- step plan -----------------------------------------------------------------------
// What one tick of a scene needs, and nothing more: settings checked once and turned into
// the numbers the stages use.

inline constexpr double kStandardGravity = 9.80665;  ///< m/s^2 (ISO 80000-3)
inline constexpr double kPaperRateHz = 1000.0;  ///< the paper's tick, for what it states per tick

/// Stages that a scene can omit. An omitted stage is not compiled into the tick that runs.
enum Stage : unsigned {
  kPaperModel = 1u,
  kForce = 2u,
  kFriction = 4u,
  kStability = 8u,
  kPinch = 16u,
  kRules = 32u,  ///< some clay rule
};
inline constexpr unsigned kStageSets = 64;

/// Clay rules that a scene can omit, like the stages above.
enum Rule : unsigned {
  kLift = 1u,
  kShift = 2u,
  kRim = 4u,
  kHoop = 8u,
  kHeave = 16u,
  kSmear = 32u,
};
inline constexpr unsigned kRuleSets = 64;

struct RemovalPlan {
  double rate_per_s = 0.0;  ///< conserving: kappa
  double yield_depth_mm = 0.0;
  double min_wall_mm = 0.0;
  double paper_fraction = 0.0;  ///< paper: k
};

struct ForcePlan {
  double stiffness_n_per_mm = 0.0;  ///< of one ring: K' h, or the paper's K
  double limit_n = 5.0;
  double friction = 0.0;
  double turn = 1.0;         ///< +1 counterclockwise seen from above, -1 clockwise
  double per_ring_mm = 1.0;  ///< 1 / h
};

struct StabilityPlan {
  double max_stress_kpa = 0.0;
  double kpa_per_ratio = 0.0;  ///< beta_i = this * (quanta above ring i) / (quanta of ring i)
};

struct RulesPlan {
  unsigned rules = 0;  ///< Rule bits
  /// The solid rings that no tool opens: the lowest, or below the bore if the tool trims the foot.
  std::size_t floor_rings = 0;
  double surface_per_s = 0.0;     ///< speed of a surface of radius 1 under a tool
  double finger_mm = 0.0;         ///< above a tool in a bore; 0: none
  bool thin_wall_yields = false;  ///< as ClaySpec's
};

/// One line of `claystack plan`.
struct PlanLine {
  std::string stage;
  bool in = true;
  std::string why;
};

/// Whether a tool of this mode cuts the pot at one height and does nothing else.
[[nodiscard]] constexpr bool cuts_level(ToolMode mode) noexcept {
  return mode == ToolMode::needle || mode == ToolMode::wire;
}

struct StepPlan {
  Model model = Model::conserving;
  unsigned stages = 0;  ///< Stage bits
  ToolMode mode = ToolMode::press;
  double gap_mm = 0.0;  ///< of poses that have none; 0: these have one tool
  Tool tool;
  RayleighKernel kernel{1.0, 0.0, 1.0, 1};
  std::int64_t inside_share = 0;  ///< alpha in 2^-30
  RemovalPlan removal;
  ForcePlan force;
  StabilityPlan stability;
  RulesPlan clay;
  double density_g_cm3 = 0.0;
  std::vector<PlanLine> lines;  ///< every stage, in or out, and why

  /// Errors name the setting and its range.
  static Result<StepPlan> build(const SceneSpec& scene);
};

}  // namespace clay
