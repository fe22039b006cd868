#include "claystack/engine/clay.hpp"
#include "claystack/export/fallen.hpp"
#include "core/text.hpp"
#include "export/section/stack_section.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline fallen {
namespace {

/// A part of the pot as a separate stack, and the height of its bottom.
struct Part {
  ClayStack stack;
  std::size_t first_ring = 0;
  double bottom_mm = 0.0;
};

/// Upper bound of the coordinates of both parts, for any motion of the collapse.
double reach_of(const Pot& pot) {
  return std::hypot(largest_radius_mm(pot.stack), pot.stack.height_mm()) +
         2.0 * glm::length(pot.collapse->pivot_mm) + glm::length(pot.collapse->shift_mm);
}

Result<void> check_collapse(const Pot& pot) {
  const auto wrong = [](const std::string& what) {
    return failure(ErrorKind::bad_input, "collapse: " + what);
  };
  if (!pot.collapse) return wrong("expected a collapsed pot, found a standing one");
  const Collapse& collapse = *pot.collapse;
  if (collapse.failed_ring >= pot.stack.size())
    return wrong("expected a failed ring below " + std::to_string(pot.stack.size()) + ", found " +
                 std::to_string(collapse.failed_ring));
  const auto near = [](const glm::dvec3& place) {  // false for NaN
    return glm::all(glm::lessThanEqual(glm::abs(place), glm::dvec3(Collapse::kMostMm)));
  };
  if (!collapse.has_valid_axis() || !near(collapse.pivot_mm) || !near(collapse.shift_mm) ||
      !(std::abs(collapse.angle_rad) <= 2.0 * std::numbers::pi))
    return wrong(
        "expected a horizontal axis of length 1, a pivot and a shift within 1e6 mm, and at most a "
        "full turn");
  return {};
}

Result<Part> part_of(const ClayStack& stack, RingRange rings, WideQuanta crown) {
  std::vector<Ring> own(stack.rings().begin() + static_cast<std::ptrdiff_t>(rings.first),
                        stack.rings().begin() + static_cast<std::ptrdiff_t>(rings.last) + 1);
  return ClayStack::from_rings(stack.ring_height_mm(), std::move(own), crown)
      .map([&](ClayStack part) {
        return Part{std::move(part), rings.first, level_mm(stack, rings.first)};
      });
}

/// Converts to the ring numbers and heights of the whole pot.
StackProfile in_place(StackProfile found, const Part& part) {
  for (Polygon& polygon : found.profile.pieces)
    for (ProfilePoint& p : polygon) p.y += part.bottom_mm;
  for (PieceShape& shape : found.shapes) {
    shape.first_ring += part.first_ring;
    shape.last_ring += part.first_ring;
    for (Cavity& cavity : shape.cavities) {
      cavity.bottom_mm += part.bottom_mm;
      cavity.top_mm += part.bottom_mm;
    }
  }
  return found;
}

StackProfile crown_profile(const ClayStack& stack) {
  const Topology topology = stack.rings().back().inner2 > 0 ? Topology::tube : Topology::solid;
  return {{{crown_section_of(stack)}}, {{topology, stack.size(), stack.size(), {}}}};
}

class Parting {
 public:
  Parting(const Pot& pot, double tolerance_mm)
      : stack_(pot.stack),
        failed_(pot.collapse->failed_ring),
        tolerance_mm_(tolerance_mm),
        min_step_mm_(std::ldexp(reach_of(pot), -20)) {}

  Result<CollapsedParts> run(Smoothing smoothing) const {
    if (smoothing == Smoothing::none) return parts(Smoothing::none);
    auto smooth = parts(smoothing);
    if (smooth) return smooth;
    return parts(Smoothing::none).map([&](CollapsedParts steps) {
      steps.no_smoothing = smooth.error().message;
      return steps;
    });
  }

 private:
  Result<CollapsedParts> parts(Smoothing smoothing) const {
    CollapsedParts result;
    result.smoothing = smoothing;
    const auto prove = [](const StackProfile& part, PlanarCertificate& certificate) {
      return certify(part.profile).map([&](const PlanarCertificate& found) {
        certificate = found;
      });
    };
    return profile({0, failed_}, 0, smoothing)
        .and_then([&](StackProfile lower) {
          result.lower = std::move(lower);
          return prove(result.lower, result.lower_certificate);
        })
        .and_then([&] { return upper(smoothing); })
        .and_then([&](StackProfile found) -> Result<void> {
          result.upper = std::move(found);
          if (result.upper.profile.pieces.empty()) return {};
          return prove(result.upper, result.upper_certificate);
        })
        .map([&] { return std::move(result); });
  }

  Result<StackProfile> upper(Smoothing smoothing) const {
    if (failed_ + 1 < stack_.size())
      return profile({failed_ + 1, stack_.size() - 1}, stack_.crown(), smoothing);
    return stack_.crown_height_mm() > min_step_mm_ ? crown_profile(stack_) : StackProfile{};
  }

  Result<StackProfile> profile(RingRange rings, WideQuanta crown, Smoothing smoothing) const {
    return part_of(stack_, rings, crown).and_then([&](const Part& part) {
      return profile(part.stack, smoothing).map([&](StackProfile own) {
        return in_place(std::move(own), part);
      });
    });
  }

  Result<StackProfile> profile(const ClayStack& stack, Smoothing smoothing) const {
    if (smoothing == Smoothing::none) return profile_of(stack, min_step_mm_);
    SmoothingOptions how;
    how.mode = smoothing;
    how.tolerance_mm = tolerance_mm_;
    return smooth_profile_of(stack, how).map([](SmoothedProfile smoothed) {
      return std::move(smoothed.section);
    });
  }

  const ClayStack& stack_;
  std::size_t failed_;
  double tolerance_mm_;
  double min_step_mm_;
};

}  // namespace

Profile CollapsedParts::together() const {
  Profile all = lower.profile;
  all.pieces.insert(all.pieces.end(), upper.profile.pieces.begin(), upper.profile.pieces.end());
  return all;
}

Result<CollapsedParts> collapsed_parts(const Pot& pot, Smoothing smoothing, double tolerance_mm) {
  return check_collapse(pot).and_then([&] { return Parting(pot, tolerance_mm).run(smoothing); });
}

}  // namespace clay::solid::inline fallen
