#pragma once
// Which bodies of a crowd may meet: a sieve that leaves few pairs for exact tests, also where long
// thin bodies lie aslant, side by side, and boxes along the axes say nothing.

#include "export/proof/broad_phase.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace clay::solid::inline proof {

/// Every pair of bodies that may meet and share no hub, each once. Never leaves out a pair that
/// meets: a pair is dropped only where a plane lies between them beyond the rounding error.
///
/// Halves the crowd again and again by where its bodies are; of two halves only those stay that
/// reach into the box of the other half, or past the plane between two bundles of long bodies.
/// Bodies about one hub cannot be told apart like that, so such pairs are the caller's.
class NearPairs {
 public:
  explicit NearPairs(std::vector<BoundingHull> bodies) : crowd_(std::move(bodies)) {}

  /// visit(a, b): positions of two bodies; false ends the search.
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
