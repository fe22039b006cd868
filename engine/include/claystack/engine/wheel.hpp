#pragma once
// The engine: a stack, a tool and a plan, one tick at a time.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/plan.hpp"
#include "claystack/engine/tool.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

namespace clay {

/// Status flags of a tick; each names its remedy.
enum StepFlag : std::uint32_t {
  kContact = 1u << 0,
  kRefused = 1u << 1,    ///< pose not finite or beyond 1e6 mm, time not advancing, or a gap that
                         ///< tool.gap_mm or tool.mode does not allow: the tick did nothing.
                         ///< With a needle or a wire a pose may have any gap
  kLongStep = 1u << 2,   ///< more than 50 ms since the last pose: treated as 50 ms
  kGrew = 1u << 3,       ///< rings were added on top
  kRingLimit = 1u << 4,  ///< clay waits above the top ring: raise lump.max_rings
  kCollapsed = 1u << 5,  ///< the stack has failed; further ticks do nothing
  kCut = 1u << 6,        ///< a needle or a wire has cut the pot
};

/// Whether a tick with these flags is work on the clay: a tool that touches, but a needle or a wire
/// only when it cuts, because it changes nothing before.
[[nodiscard]] constexpr bool works(ToolMode mode, std::uint32_t flags) noexcept {
  return (flags & (cuts_level(mode) ? kCut : kContact)) != 0;
}

struct StepReport {
  /// Force on the hand [N], of both tools for a pinch: the spring of the contact, and the friction
  /// of the turning wheel, which does work on the hand. A passivity check needs the spring alone.
  glm::dvec3 spring_n{0.0}, friction_n{0.0};
  std::uint32_t flags = 0;
  std::uint32_t rings_touched = 0;  ///< by both tools of a pinch together

  /// Their sum, at most force.limit_n.
  [[nodiscard]] glm::dvec3 force_n() const noexcept { return spring_n + friction_n; }
};

class Wheel {
 public:
  /// Puts the scene's lump on the wheel. Refuses a lump that cannot carry itself.
  static Result<Wheel> build(const SceneSpec& scene);
  /// Continues an existing pot. If the first pose repeats the last one, the result is the same to
  /// the bit as without the interruption; but without clay rules, clay flows up until the tool
  /// rises or sinks. A pot that stands upside down (ToolMode::trim_foot) is placed by its height,
  /// which a cut through its rim can change by less than a ring.
  /// Growth stops at lump.max_rings, or at the pot's own limit if that is 0; the lump's other sizes
  /// are not used. Refuses a model or density other than the scene's, and a pot that has collapsed,
  /// is rounded (its clay is not the counted clay), or cannot carry itself.
  static Result<Wheel> build(const SceneSpec& scene, const Pot& start);
  Wheel(Wheel&&) noexcept;
  Wheel& operator=(Wheel&&) noexcept;
  ~Wheel();

  /// One tick: pose -> tool state -> contact -> removal -> redistribution -> stability -> force.
  /// No allocation and no lock; no work that grows with the number of rings, but for three cases
  /// (docs/model.md, Stability without O(N)).
  StepReport step(const Pose& pose) noexcept;

  /// Contact and force at this pose on the clay as it is; changes neither clay nor state. Does not
  /// report growth, a cut or a collapse, and does not divide a long motion into parts as step()
  /// does. For a force rate above the rate of the clay. Uses the wheel's scratch memory: one thread
  /// at a time may call step, probe and pot.
  [[nodiscard]] StepReport probe(const Pose& pose) noexcept;

  [[nodiscard]] const StepPlan& plan() const noexcept;
  [[nodiscard]] const ClayStack& stack() const noexcept;
  [[nodiscard]] const Ledger& ledger() const noexcept;
  [[nodiscard]] bool collapsed() const noexcept;
  /// The current pot; after a failure, collapsed and at rest.
  [[nodiscard]] Pot pot() const;

 private:
  struct State;
  /// `clay`: its name in an error message.
  static Result<Wheel> assemble(StepPlan plan, ClayStack stack, const Ledger& ledger,
                                const Rim& rim, const std::string& clay);
  explicit Wheel(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace clay
