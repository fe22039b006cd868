#pragma once
// What the suite puts on the wheel: the engine, or the paper as printed, behind one face, so that
// the same requirement judges both.

#include "app/bench/extreme/exact.hpp"
#include "claystack/core/result.hpp"
#include "claystack/engine/scene.hpp"
#include "claystack/engine/tool.hpp"

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace clay {
class Wheel;
}
namespace clay::bench {
class LiteralPaper;
}

namespace clay::extreme {

enum class Who { conserving, literal };

struct Tick {
  glm::dvec3 force_n{0.0};
  bool contact = false, refused = false, collapsed = false, long_step = false, ring_limit = false;
  bool undefined = false;  ///< the printed formula leaves what C++ defines
  bool endless = false;    ///< the printed loop does not end
};

struct Radii {
  double outer_mm = 0.0, inner_mm = 0.0;
};

class Subject {
 public:
  virtual ~Subject() = default;

  virtual Tick step(const Pose& pose) = 0;
  [[nodiscard]] virtual std::size_t rings() const = 0;
  [[nodiscard]] virtual Radii ring(std::size_t i) const = 0;
  [[nodiscard]] virtual double centre_mm(std::size_t i) const = 0;  ///< height of ring i's middle

  /// All clay that is accounted for, as the sum of R^2 - r^2 [mm^2], counted from all rings and
  /// without rounding. Nothing where a radius is not finite.
  [[nodiscard]] virtual std::optional<Exact> clay() const = 0;
  /// How far `clay` may be from what it was: 0 where clay is counted; for doubles 8 u times the
  /// sum of R^2 + r^2, a tick, u = 2^-53.
  [[nodiscard]] virtual Exact allowance() const = 0;
  /// Empty, or what is wrong: 0 <= r < R and finite in every ring.
  [[nodiscard]] virtual std::string fault() const = 0;
  /// Every bit of the state that the next tick may depend on and that can be seen.
  [[nodiscard]] virtual std::string bytes() const = 0;

  /// The array of rings as it lies in memory, until the next growth.
  [[nodiscard]] virtual std::span<const std::byte> ring_bytes() const = 0;

  [[nodiscard]] virtual const Wheel* wheel() const { return nullptr; }
  [[nodiscard]] virtual const bench::LiteralPaper* literal() const { return nullptr; }
};

/// Both read the same scene; K of the paper is force.paper_stiffness_n_per_mm or 0.05 N/mm, its k
/// removal.paper_fraction or rate / 1000, its L_1 reach / h, rounded. The literal paper refuses
/// nothing.
Result<std::unique_ptr<Subject>> put_on_wheel(Who who, const SceneSpec& scene);

/// Clay in `wheel`'s rings and crown and in its ledger's other columns, each ring added by Boost.
[[nodiscard]] Count count_clay(const Wheel& wheel);

}  // namespace clay::extreme
