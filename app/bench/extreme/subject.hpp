#pragma once
// The subject of the suite: the engine, or the paper as printed, behind one interface, so that the
// same requirement judges both.

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

enum class Model { conserving, literal };

struct Tick {
  glm::dvec3 force_n{0.0};
  bool contact = false, refused = false, collapsed = false, long_step = false, ring_limit = false;
  bool undefined = false;  ///< the printed formula is undefined in C++
  bool endless = false;    ///< the printed loop does not terminate
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

  /// Total clay as the sum of R^2 - r^2 [mm^2], counted exactly from all rings. Empty if a radius
  /// is not finite.
  [[nodiscard]] virtual std::optional<Exact> clay() const = 0;
  /// Permitted change of `clay`: 0 if clay is counted; for doubles 8 u times the sum of R^2 + r^2
  /// per tick, u = 2^-53.
  [[nodiscard]] virtual Exact allowance() const = 0;
  /// The violated invariant, if any: 0 <= r < R and finite in every ring.
  [[nodiscard]] virtual std::string fault() const = 0;
  /// Every visible bit of the state on which the next tick may depend.
  [[nodiscard]] virtual std::string bytes() const = 0;

  /// The array of rings in memory, valid until the next growth.
  [[nodiscard]] virtual std::span<const std::byte> ring_bytes() const = 0;

  [[nodiscard]] virtual const Wheel* wheel() const { return nullptr; }
  [[nodiscard]] virtual const bench::LiteralPaper* literal() const { return nullptr; }
};

/// Both read the same scene; K of the paper is force.paper_stiffness_n_per_mm or 0.05 N/mm, its k
/// is removal.paper_fraction or rate / 1000 (in the engine at most 0.5), its L_1 is reach / h,
/// rounded. The literal paper refuses nothing.
Result<std::unique_ptr<Subject>> make_subject(Model model, const SceneSpec& scene);

/// Clay in the rings, the crown and the other columns of the ledger, summed with Boost.
[[nodiscard]] Count count_clay(const Wheel& wheel);

}  // namespace clay::extreme
