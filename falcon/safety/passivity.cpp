#include "claystack/falcon/passivity.hpp"

#include "falcon/safety/passivity_law.hpp"

#include <utility>

namespace clay::falcon::inline safety {

tl::expected<PassivityController, OutOfRange> PassivityController::build(
    const PassivitySettings& settings) {
  return check(settings).map(
      [&] { return PassivityController(std::make_unique<PassivityLaw>(settings)); });
}

PassivityController::PassivityController(std::unique_ptr<PassivityLaw> law) noexcept
    : law_(std::move(law)) {}
PassivityController::PassivityController(PassivityController&&) noexcept = default;
PassivityController& PassivityController::operator=(PassivityController&&) noexcept = default;
PassivityController::~PassivityController() = default;

PassiveForce PassivityController::tick(std::int64_t time_us, const glm::dvec3& reading_mm,
                                       const glm::dvec3& force_n) noexcept {
  return law_->tick(time_us, reading_mm, force_n);
}

void PassivityController::displayed(const glm::dvec3& force_n) noexcept {
  law_->displayed(force_n);
}

void PassivityController::reset() noexcept { law_->reset(); }

PassivityState PassivityController::state() const noexcept { return law_->state(); }

std::optional<double> PassivityController::slow_rate_hz() const noexcept {
  return law_->slow_rate_hz();
}

}  // namespace clay::falcon::inline safety
