#pragma once
// Finds the bodies that may intersect: a filter that leaves few pairs for the exact tests, even for
// long thin bodies at an angle to the axes, where boxes do not separate them.

#include "export/proof/broad_phase.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

/// Visits every pair of bodies that may intersect and shares no hub, once. Never drops an
/// intersecting pair: a pair is dropped only if a plane separates it by more than the rounding
/// error.
///
/// Halves the set repeatedly by position; of two halves only those bodies remain that reach into
/// the box of the other half, or beyond the plane between two bundles of long bodies. This does not
/// separate bodies about one hub, so the caller handles such pairs.
class NearPairs {
 public:
  explicit NearPairs(std::vector<BoundingHull> bodies) : crowd_(std::move(bodies)) {}

  /// visit(a, b): indices of two bodies; false ends the search.
  template <class Visit>
  void for_each(const Visit& visit) {
    search({this, &visit, [](const void* on, std::uint32_t a, std::uint32_t b) {
              return (*static_cast<const Visit*>(on))(a, b);
            }});
  }

  [[nodiscard]] const BoundingHull& operator[](std::uint32_t i) const { return crowd_[i]; }

 private:
  using Positions = std::vector<std::uint32_t>;
  struct Visitor {
    NearPairs* pairs;
    const void* visit;
    bool (*call)(const void*, std::uint32_t, std::uint32_t);
  };

  void search(const Visitor& visitor);
  void within(std::size_t begin, std::size_t end);
  void between(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);
  void halves_between(Positions& cut, const Positions& whole);
  bool without_hub(const Positions& a, const Positions& b);
  void sieve_by_boxes(Positions& a, Positions& b) const;
  void sieve_by_planes(Positions& a, Positions& b) const;
  void sieve_along(const glm::dvec3& direction, Positions& a, Positions& b) const;
  void offer(std::uint32_t a, std::uint32_t b);

  BroadPhase crowd_;
  const Visitor* visitor_ = nullptr;
  bool ended_ = false;
};

}  // namespace clay::solid::inline proof
