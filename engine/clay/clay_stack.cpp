#include "claystack/engine/clay.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

namespace clay {
namespace {

Result<void> check_shape(std::size_t count, double ring_height_mm, std::size_t max_rings) {
  if (count < 1 || count > kMaxRings)
    return failure(ErrorKind::bad_input, "expected 1 to " + std::to_string(kMaxRings) +
                                             " rings, found " + std::to_string(count));
  if (max_rings < count || max_rings > kMaxRings)
    return failure(ErrorKind::bad_input,
                   "expected a largest number of rings from " + std::to_string(count) + " to " +
                       std::to_string(kMaxRings) + ", found " + std::to_string(max_rings));
  if (!(ring_height_mm >= kMinRingHeightMm && ring_height_mm <= kMaxRingHeightMm))
    return failure(ErrorKind::bad_input, "expected a ring height from 0.001 to 1000 mm, found " +
                                             number_text(ring_height_mm));
  return {};
}

Result<void> check_ring(const Ring& ring, std::size_t index) {
  const auto wrong = [&](const std::string& expected) {
    return failure(ErrorKind::bad_input, "ring " + std::to_string(index) + ": expected " +
                                             expected + ", found outer " +
                                             std::to_string(ring.outer2) + " and inner " +
                                             std::to_string(ring.inner2) + " quanta of 2^-36 mm^2");
  };
  if (ring.outer2 < kSmallestOuter2 || ring.outer2 > kLargestOuter2)
    return wrong("an outer radius from 0.001 to 5000 mm");
  if (ring.inner2 < 0) return wrong("an inner radius of 0 or more");
  if (ring.inner2 >= ring.outer2) return wrong("an inner radius below the outer one");
  return {};
}

}  // namespace

Result<ClayStack> ClayStack::cylinder(std::size_t count, double ring_height_mm, double outer_mm,
                                      double inner_mm, std::size_t max_rings) {
  // Compare before converting to integers: the numbers are untrusted.
  if (!(outer_mm >= kMinRadiusMm && outer_mm <= kMaxRadiusMm))
    return failure(ErrorKind::bad_input, "expected an outer radius from 0.001 to 5000 mm, found " +
                                             number_text(outer_mm));
  if (!(inner_mm >= 0.0 && inner_mm < outer_mm))
    return failure(
        ErrorKind::bad_input,
        "expected an inner radius from 0 to below the outer one, found " + number_text(inner_mm));
  if (auto shape = check_shape(count, ring_height_mm, std::max(count, max_rings)); !shape)
    return tl::make_unexpected(shape.error());
  const Ring ring{quanta_from_radius(outer_mm), quanta_from_radius(inner_mm)};
  return from_rings(ring_height_mm, std::vector<Ring>(count, ring), 0, max_rings);
}

Result<ClayStack> ClayStack::from_rings(double ring_height_mm, std::vector<Ring> rings,
                                        WideQuanta crown, std::size_t max_rings) {
  if (auto shape = check_shape(rings.size(), ring_height_mm, max_rings); !shape)
    return tl::make_unexpected(shape.error());
  if (crown < 0)
    return failure(ErrorKind::bad_input,
                   "expected a crown of 0 quanta or more, found " + to_string(crown));
  ClayStack stack;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (auto ring = check_ring(rings[i], i); !ring) return tl::make_unexpected(ring.error());
    stack.rings_volume_ += rings[i].volume();
    stack.bores_ += rings[i].inner2 > 0 ? 1 : 0;
  }
  stack.rings_ = std::move(rings);
  stack.ring_height_mm_ = ring_height_mm;
  stack.max_rings_ = max_rings;
  stack.crown_ = crown;
  return stack;
}

double ClayStack::crown_height_mm() const noexcept {
  if (crown_ == 0 || rings_.empty()) return 0.0;
  return ring_height_mm_ * static_cast<double>(crown_) /
         static_cast<double>(rings_.back().volume());
}

double ClayStack::height_mm() const noexcept {
  return ring_height_mm_ * static_cast<double>(rings_.size()) + crown_height_mm();
}

WideQuanta ClayStack::recount() const noexcept {
  WideQuanta sum = crown_;
  for (const Ring& ring : rings_) sum += ring.volume();
  return sum;
}

double ClayStack::mm3_per_quantum() const noexcept {
  return std::numbers::pi * ring_height_mm_ * kMm2PerQuantum;
}

double ClayStack::volume_mm3() const noexcept {
  return static_cast<double>(volume()) * mm3_per_quantum();
}

}  // namespace clay
