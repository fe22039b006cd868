#pragma once
// The engine: a stack, a tool and a plan, one tick at a time.

#include "claystack/core/result.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/engine/tick.hpp"
#include "claystack/engine/tool.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

namespace clay {

/// What a tick has to say beside its force. Each names its remedy.
enum StepFlag : std::uint32_t {
  kContact = 1u << 0,
  kRefused = 1u << 1,    ///< pose not finite or beyond 1e6 mm, time not advancing, or a gap where
                         ///< the scene sets no tool.gap_mm: nothing was done
  kLongStep = 1u << 2,   ///< more than 50 ms since the last pose: taken as 50 ms
  kGrew = 1u << 3,       ///< rings were added on top
  kRingLimit = 1u << 4,  ///< clay waits above the top: raise lump.max_rings
  kCollapsed = 1u << 5,  ///< the stack has failed; ticks do nothing any more
};

struct StepReport {
  /// The force on the hand, of a pinch from both tools, in its two parts: the contact's spring, and
  /// the friction of the turning wheel, which does work on the hand. A check of passivity needs the
  /// spring alone.
  glm::dvec3 spring_n{0.0}, friction_n{0.0};
  std::uint32_t flags = 0;
  std::uint32_t rings_touched = 0;  ///< by both tools of a pinch together

  /// Their sum, at most force.limit_n.
  [[nodiscard]] glm::dvec3 force_n() const noexcept { return spring_n + friction_n; }
};

class Wheel {
 public:
  /// The scene's lump on the wheel. Refuses a lump that cannot carry itself.
  static Result<Wheel> build(const SceneSpec& scene);
  /// That pot on the wheel instead of the scene's lump, to throw on: what the tool does in free air
  /// apart, the same bits as if it had never been taken off. Height and number of the rings are the
  /// pot's; growth stops at lump.max_rings, or where the pot's own does when that is 0. Refuses a
  /// model or a density other than the scene's, a pot that has collapsed, that is rounded (its clay
  /// is not the clay that was counted), or that cannot carry itself.
  static Result<Wheel> build(const SceneSpec& scene, const Pot& start);
  Wheel(Wheel&&) noexcept;
  Wheel& operator=(Wheel&&) noexcept;
  ~Wheel();

  /// One tick: pose -> tool state -> contact -> removal -> redistribution -> stability -> force.
  /// No allocation, no lock, no work that grows with the number of rings.
  StepReport step(const Pose& pose) noexcept;

  /// What step() would answer at this pose, with the clay as it is: nothing is displaced and
  /// nothing remembered. For a force that is wanted more often than the clay needs to move.
  [[nodiscard]] StepReport feel(const Pose& pose) noexcept;

  [[nodiscard]] const StepPlan& plan() const noexcept;
  [[nodiscard]] const ClayStack& stack() const noexcept;
  [[nodiscard]] const Ledger& ledger() const noexcept;
  [[nodiscard]] bool collapsed() const noexcept;
  /// The pot as it is now; after a failure, fallen and at rest.
  [[nodiscard]] Pot pot() const;

 private:
  struct State;
  /// `clay`: what it is called in an error.
  static Result<Wheel> assemble(StepPlan plan, ClayStack stack, const Ledger& ledger,
                                const Rim& rim, const std::string& clay);
  explicit Wheel(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace clay
